"""Animations of a result, as pages that any browser plays."""
