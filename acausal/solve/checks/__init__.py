"""Checks of a run: validity of components, smoothness of laws, drift of redundant constraints."""
