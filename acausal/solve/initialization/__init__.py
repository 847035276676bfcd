"""Consistent initial values: closed loops, independent states, all equations satisfied."""
