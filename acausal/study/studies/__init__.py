"""Studies of accuracy against time: every point of a grid against a reference.

formulation <- grid, reference <- rows <- table, picture <- study.
"""
