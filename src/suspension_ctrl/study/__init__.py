"""Comparisons of any searches on any problems: timed runs, quality over seeds, statistics."""
