"""Multi-objective searches as DEAP toolboxes over arrays; they know no cars."""
