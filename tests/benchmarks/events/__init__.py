"""Scenes with events, and what each event costs."""
