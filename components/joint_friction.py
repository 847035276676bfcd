"""JointFriction: dry friction with stiction in a joint."""

from __future__ import annotations

from typing import Any

from acausal import Expr, Scalar, discrete, input, parameter, quantity, sign, variable
from components.dry_friction import MODE, SLIP, STUCK, DryFriction


class JointFriction(DryFriction):
    """Base of the dry friction inside a joint, which prescribes its speed and its sliding load."""

    speed: Any
    sliding: Any
    load: Any
    stuck: Any
    slip: Any
    peak: Scalar = parameter("ratio of the largest sticking load to the sliding load", unit="1", default=1, minimum=1)

    def holding(self) -> Expr:
        """Largest load of sticking."""
        return self.peak * self.sliding

    def dragging(self) -> Expr:
        """Load of sliding."""
        return self.sliding

    def loss(self) -> Expr:
        """Power of the load."""
        return self.load * self.speed


class RevoluteFriction(JointFriction):
    """Dry friction of a revolute joint."""

    speed: Scalar = input("speed of the joint", unit="rad/s")
    sliding: Scalar = input("sliding torque", unit="N.m")
    load: Scalar = variable("torque against the motion", unit="N.m")
    mode: Scalar = discrete(MODE, unit="1", start=sign(speed))
    stuck: Scalar = discrete(STUCK, unit="rad/s")
    slip: Scalar = discrete(SLIP, unit="rad/s")

    def equations(self):
        yield from super().equations()
        yield from self.stick_slip(self.speed, self.load, quantity(1.0, "kg.m2"), self.stuck, self.slip)


class PrismaticFriction(JointFriction):
    """Dry friction of a prismatic joint."""

    speed: Scalar = input("speed of the joint", unit="m/s")
    sliding: Scalar = input("sliding force", unit="N")
    load: Scalar = variable("force against the motion", unit="N")
    mode: Scalar = discrete(MODE, unit="1", start=sign(speed))
    stuck: Scalar = discrete(STUCK, unit="m/s")
    slip: Scalar = discrete(SLIP, unit="m/s")

    def equations(self):
        yield from super().equations()
        yield from self.stick_slip(self.speed, self.load, quantity(1.0, "kg"), self.stuck, self.slip)
