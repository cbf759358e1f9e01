"""Table 5: the reference car, the published optimum, and the best struts of the same suspension travel."""

from suspension_ctrl.commands.optimum import main
from suspension_ctrl.commands.terminal import run_script

if __name__ == "__main__":
    run_script(main)
