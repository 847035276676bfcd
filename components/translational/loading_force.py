"""LoadingForce: base of forces as functions of speed or time."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, variable
from components.translational.one_flange import OneFlange


class LoadingForce(OneFlange):
    """Base of forces on a rod end; a subclass defines f."""

    f: Scalar = variable("cut force, flange.f: positive against forward motion", unit="N")

    def equations(self):
        yield from super().equations()
        yield self.f == self.flange.f
        yield from self.law()

    def law(self) -> Any:
        """Yield the equation of f."""
        raise NotImplementedError("yields the equation of the force f", "yield self.f == ...")
