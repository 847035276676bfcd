"""Integration of one stretch of a run after the other."""
