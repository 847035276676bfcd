"""PrescribedMotion: base of drives prescribed by position, speed and acceleration signals."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal import Component, variable


class PrescribedMotion(Component):
    """Base of drives prescribed by signals of position, speed and acceleration, without differentiating any of them.

    Notes
    -----
    The next signal replaces each derivative, so each signal should be the derivative of the one before.
    """

    motion_units = ("m", "m/s", "m/s2")
    motion: Any = variable(
        "prescribed position, speed and acceleration",
        unit=lambda self: self.motion_units[: self.levels()],
        shape=lambda self: (self.levels(),),
    )

    def levels(self) -> int:
        """Return the number of signals: position, speed and acceleration."""
        return 3

    def motion_equations(self, *signals: Any) -> Iterator[Any]:
        """Yield the equations of the prescribed motion; unused signals are 0."""
        for k, signal in enumerate(signals):
            yield self.motion[k] == signal if k < self.levels() else signal == 0

    def declared_derivatives(self):
        for k in range(1, self.levels()):
            yield self.motion[k - 1], self.motion[k]
