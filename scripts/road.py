"""Roughness, spectrum and class of a measured road."""

from suspension_ctrl.commands import main

if __name__ == "__main__":
    main("road")
