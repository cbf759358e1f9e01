"""Figure 2: the ISO 2631 weightings Wk and Wb, as filters and as the standard's table."""

from suspension_ctrl.commands import main

if __name__ == "__main__":
    main("weighting")
