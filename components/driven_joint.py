"""DrivenJoint: base of joints with one degree of freedom, friction and an optional, elastic drive."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, ClassVar

from acausal import (
    DeclarationError,
    Expr,
    Scalar,
    branch,
    dot,
    effect,
    parameter,
    sqrt,
    tanh,
)
from components.driven import Driven
from components.orientation import unit_vector
from components.world import require_direction


class DrivenJoint(Driven):
    """Base of joints with one degree of freedom along or about n; a subclass declares n, d, compliance and its motion."""

    friction: Any = effect(
        "friction in the joint",
        default=True,
        choices=(True, "stiction", "reaction", False),
        tries=(True, False),
        doc="True: viscous and regularised dry friction, which creeps at rest. stiction: viscous and dry friction with "
        "stiction. reaction: viscous friction, and friction mu times the reaction force with stiction. False: none.",
    )
    mu: Scalar = parameter(
        "coefficient of friction with the reaction force",
        unit="1",
        default=0,
        minimum=0,
        doc='With friction="reaction".',
    )
    peak: Scalar = parameter(
        "ratio of the largest sticking load to the sliding load",
        unit="1",
        default=1,
        minimum=1,
        doc='With friction="stiction" or "reaction".',
    )
    f_small: Scalar = parameter(
        "reaction force of regularisation",
        unit="N",
        default=1e-6,
        positive=True,
        doc='With friction="reaction": |f| is regularised as sqrt(f^2 + f_small^2) - f_small.',
    )
    elasticity: bool = effect("compliance of the drive", default=True, doc="False makes the drive rigid.")
    n: Any
    d: Any
    compliance: Any
    stiction: ClassVar[Any]  # part of a subclass: dry friction with stiction, or None

    def check(self) -> None:
        """Reject an axis of length 0, and a compliance without a drive."""
        require_direction(self, self.n, "n")
        if not self.use_axis_flange and not self.compliance.sx.is_zero():
            where = f"{self._path} ({type(self).__name__})"
            raise DeclarationError(
                f"`compliance` of {where} applies to the drive, but the joint has no drive; add one, "
                f"{type(self).__name__}(use_axis_flange=True, compliance=...), or leave the compliance out."
            )

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def drag(self, speed: Any, dry: Any, slow: Any) -> Any:
        """Return d speed + dry tanh(speed / slow); d speed if `stiction` provides the dry friction; or 0.

        Zero dry friction leaves no tanh in the equations.
        """
        if self.sticks():
            return self.d * speed
        return self.d * speed + dry * tanh(speed / slow) if self.friction else 0.0

    def sticks(self) -> bool:
        """Return whether the joint has dry friction with stiction."""
        return self.friction in ("stiction", "reaction")

    def friction_load(self, drag: Any) -> Any:
        """Return the total friction load against the motion."""
        return drag + self.stiction.load if self.sticks() else drag

    def stiction_equations(self, speed: Expr, dry: Expr, arm: Expr) -> Iterator[Any]:
        """Yield speed and sliding load of `stiction`: `dry`, or mu |f| arm with the force f on frame_b normal to the axis."""
        if self.sticks():
            yield self.stiction.speed == speed
            yield self.stiction.sliding == (
                self.mu * self._normal_force() * arm if self.friction == "reaction" else dry
            )

    def _normal_force(self) -> Expr:
        """Magnitude of the force on frame_b normal to the axis, regularised at 0."""
        f, n, small = self.frame_b.f, unit_vector(self.n), self.f_small
        return sqrt(dot(f, f) - dot(n, f) ** 2 + small**2) - small

    def drive_deflection(self, load: Any) -> Any:
        """Return the elastic displacement of the drive relative to the joint under its load, or 0."""
        return self.compliance * load if self.elasticity else 0.0
