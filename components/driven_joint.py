"""DrivenJoint: base of joints with one freedom, which may have a drive, friction and an elastic drive."""

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
    """Base of joints along or about an axis n; a subclass declares n, d, compliance and its own motion."""

    friction: Any = effect(
        "friction in the joint",
        default=True,
        choices=(True, "stiction", "reaction", False),
        tries=(True, False),
        doc="True: viscous, and dry friction that fades where the joint rests, and creeps. stiction: viscous, and dry friction "
        "that sticks. reaction: viscous, and friction under the reaction force, of the coefficient mu, that sticks. False: none.",
    )
    mu: Scalar = parameter(
        "coefficient of friction under the reaction force",
        unit="1",
        default=0,
        minimum=0,
        doc='With friction="reaction".',
    )
    peak: Scalar = parameter(
        "ratio of the greatest loads of sticking and of sliding",
        unit="1",
        default=1,
        minimum=1,
        doc='With friction="stiction" or "reaction".',
    )
    f_small: Scalar = parameter(
        "reaction force below which its friction fades",
        unit="N",
        default=1e-6,
        positive=True,
        doc='With friction="reaction": |f| is sqrt(f^2 + f_small^2) - f_small.',
    )
    elasticity: bool = effect(
        "compliance of the drive", default=True, doc="False makes the drive rigid, whatever its compliance."
    )
    n: Any
    d: Any
    compliance: Any
    stiction: ClassVar[Any]  # part of a subclass: friction that sticks, or None

    def check(self) -> None:
        """Refuse an axis of length 0, and compliance of a drive that is not there."""
        require_direction(self, self.n, "n")
        if not self.use_axis_flange and not self.compliance.sx.is_zero():
            where = f"{self._path} ({type(self).__name__})"
            raise DeclarationError(
                f"`compliance` of {where} is that of the drive, which this joint does not have; give it one, "
                f"{type(self).__name__}(use_axis_flange=True, compliance=...), or leave the compliance out."
            )

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def drag(self, speed: Any, dry: Any, slow: Any) -> Any:
        """Friction against the motion: d speed + dry tanh(speed / slow), d speed where `stiction` adds the rest, or 0.

        A dry friction of 0 leaves no tanh.
        """
        if self.sticks():
            return self.d * speed
        return self.d * speed + dry * tanh(speed / slow) if self.friction else 0.0

    def sticks(self) -> bool:
        """Whether it has dry friction that sticks."""
        return self.friction in ("stiction", "reaction")

    def resisting(self, drag: Any) -> Any:
        """Load of all friction against the motion."""
        return drag + self.stiction.load if self.sticks() else drag

    def sliding(self, speed: Expr, dry: Expr, arm: Expr) -> Iterator[Any]:
        """Give the friction that sticks its speed and load: `dry`, or mu |f| arm, f the force on frame_b across the axis."""
        if self.sticks():
            yield self.stiction.speed == speed
            yield self.stiction.sliding == (self.mu * self._across() * arm if self.friction == "reaction" else dry)

    def _across(self) -> Expr:
        """Size of the force on frame_b across the axis, smooth where that is 0."""
        f, n, small = self.frame_b.f, unit_vector(self.n), self.f_small
        return sqrt(dot(f, f) - dot(n, f) ** 2 + small**2) - small

    def give(self, load: Any) -> Any:
        """How far the drive is ahead of the joint under its load, or 0."""
        return self.compliance * load if self.elasticity else 0.0
