"""Exact derivatives of mean squares and of scores by the variables of a design.

A module for each class of cases: one pass over a design gives its mean squares and the derivatives of combinations
of them that are wanted. Scores are differentiated from these.
"""
