"""Feedback: difference of a command and a feedback, u1 - u2."""

from __future__ import annotations

from components.blocks.si2so import SI2SO


class Feedback(SI2SO):
    """Difference of a command and a feedback, u1 - u2."""

    def equations(self):
        yield self.y == self.u1 - self.u2
