"""Studies of effects: each is switched, and what that changes and costs is told.

listing <- rows <- trials, cheapest <- tables <- result <- file, effects.
"""
