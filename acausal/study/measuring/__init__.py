"""Measurement of cases: run in parallel, in processes or on a cluster, and recorded in a journal.

Modules in the order of imports: limit and model_pickling, run_function, case, own_run, measure, pool (with workers and
study_arguments), session (with journal); deviation is independent.
"""
