"""Measuring: points are run side by side, in processes or on a cluster, and kept in a journal.

point <- limit, shipping <- measure <- workers, pool <- journal, session; deviation and arguments stand beside them.
"""
