"""Integration of one leg of a run after the other."""
