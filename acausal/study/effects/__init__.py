"""Studies of effects: each is set otherwise, and what that changes and costs is told.

listing <- rows <- variants, cheapest <- tables <- result <- file, effects.
"""
