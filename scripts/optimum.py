"""Table 5: the reference car, the published optimum, and the best struts of the same suspension travel."""

from suspension_ctrl.commands import main

if __name__ == "__main__":
    main("optimum")
