"""Measuring: points are run in parallel, in processes or on a cluster, and kept in a journal.

point, limit, shipping <- measure <- pool (workers, arguments) <- session (journal); deviation stands by itself.
"""
