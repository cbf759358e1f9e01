"""Figure 2: the ISO 2631 weightings Wk and Wb, as filters and as the standard's table."""

from suspension_ctrl.commands.terminal import run_script
from suspension_ctrl.commands.weighting import main

if __name__ == "__main__":
    run_script(main)
