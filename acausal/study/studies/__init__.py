"""Studies of accuracy against time: every case of a grid is compared with a reference.

Modules in the order of imports: formulation, grid and reference, study_rows, study_table and picture, study.
"""
