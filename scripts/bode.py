"""Figures 6 and 7: Bode plots and spectra of responses to the road, of the paper's car or any other vehicle."""

from suspension_ctrl.commands import main

if __name__ == "__main__":
    main("bode")
