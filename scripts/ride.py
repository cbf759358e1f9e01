"""Ride of one vehicle: discomfort, travel, tyre load, every response, and modes."""

from suspension_ctrl.commands import main

if __name__ == "__main__":
    main("ride")
