"""Human exposure to measured histories of acceleration, printed and written as CSV."""

from suspension_ctrl.commands import main

if __name__ == "__main__":
    main("exposure")
