"""Studies of accuracy against time: every case of a grid against a reference.

formulation <- grid, reference <- rows <- table, picture <- study.
"""
