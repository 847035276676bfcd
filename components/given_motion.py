"""GivenMotion: base of drives by signals of position, speed and acceleration."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal import Component, variable


class GivenMotion(Component):
    """Base of drives by signals of position, speed and acceleration, of which none is differentiated.

    Notes
    -----
    Where the motion is needed at a higher level, the next signal is used. It should be the derivative of the one before.
    """

    motion_units = ("m", "m/s", "m/s2")
    motion: Any = variable(
        "position, speed and acceleration as the signals give them",
        unit=lambda self: self.motion_units[: self.levels()],
        shape=lambda self: (self.levels(),),
    )

    def levels(self) -> int:
        """Return how many of position, speed and acceleration are given."""
        return 3

    def given(self, *signals: Any) -> Iterator[Any]:
        """Yield equations of position, speed and acceleration; signals that are not used are 0."""
        for k, signal in enumerate(signals):
            yield self.motion[k] == signal if k < self.levels() else signal == 0

    def declared_derivatives(self):
        for k in range(1, self.levels()):
            yield self.motion[k - 1], self.motion[k]
