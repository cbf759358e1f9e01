"""The paper's experiment: NSGA-II against MOEA/D-DRA on Table 1's vehicle, Tables 2 to 4 and Figure 5."""

from suspension_ctrl.commands import main

if __name__ == "__main__":
    main("compare")
