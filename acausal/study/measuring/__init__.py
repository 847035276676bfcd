"""Measuring: cases are run in parallel, in processes or on a cluster, and kept in a journal.

case, limit, shipping <- measure <- pool (workers, arguments) <- session (journal); deviation stands by itself.
"""
