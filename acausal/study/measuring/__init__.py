"""Measuring: cases are run in parallel, in processes or on a cluster, and kept in a journal.

limit, shipping <- run_function <- case <- own_run <- measure <- pool (workers, arguments) <- session (journal); deviation
stands by itself.
"""
