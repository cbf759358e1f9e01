"""Figures 6 and 7: Bode plots and spectra of responses to the road, of the paper's car or any other vehicle."""

from suspension_ctrl.commands.bode import main
from suspension_ctrl.commands.terminal import run_script

if __name__ == "__main__":
    run_script(main)
