"""LoadingForce: base of forces that follow a law of speed or time."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, variable
from components.translational.one_flange import OneFlange


class LoadingForce(OneFlange):
    """Base of forces at a rod end; a subclass states what f is."""

    f: Scalar = variable("cut force, flange.f: positive against the motion forwards", unit="N")

    def equations(self):
        yield from super().equations()
        yield self.f == self.flange.f
        yield from self.law()

    def law(self) -> Any:
        """Yield the equation of f."""
        raise NotImplementedError("states its force f", "yield self.f == ...")
