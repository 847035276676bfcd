"""JointFriction: dry friction with stiction about or along the axis of a joint."""

from __future__ import annotations

from typing import Any

from acausal import Expr, Scalar, discrete, input, parameter, quantity, sign, variable
from components.dry_friction import DryFriction


class JointFriction(DryFriction):
    """Base of the friction of a joint, a part of that, which gives it its speed and the load of sliding."""

    speed: Any
    sliding: Any
    load: Any
    stuck: Any
    slip: Any
    peak: Scalar = parameter("ratio of the greatest loads of sticking and of sliding", unit="1", default=1, minimum=1)

    def holding(self) -> Expr:
        """Greatest load of sticking."""
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
    sliding: Scalar = input("torque of sliding", unit="N.m")
    load: Scalar = variable("torque against the motion", unit="N.m")
    mode: Scalar = discrete("1 slides forward, 0 sticks, -1 slides backward", unit="1", start=sign(speed))
    stuck: Scalar = discrete("speed when it last stuck or broke away, 0 but for rounding", unit="rad/s")
    slip: Scalar = discrete(
        "change of the speed at which it no longer rests where others keep it at rest", unit="rad/s"
    )

    def equations(self):
        yield from super().equations()
        yield from self.stick_slip(self.speed, self.load, quantity(1.0, "kg.m2"), self.stuck, self.slip)


class PrismaticFriction(JointFriction):
    """Dry friction of a prismatic joint."""

    speed: Scalar = input("speed of the joint", unit="m/s")
    sliding: Scalar = input("force of sliding", unit="N")
    load: Scalar = variable("force against the motion", unit="N")
    mode: Scalar = discrete("1 slides forward, 0 sticks, -1 slides backward", unit="1", start=sign(speed))
    stuck: Scalar = discrete("speed when it last stuck or broke away, 0 but for rounding", unit="m/s")
    slip: Scalar = discrete("change of the speed at which it no longer rests where others keep it at rest", unit="m/s")

    def equations(self):
        yield from super().equations()
        yield from self.stick_slip(self.speed, self.load, quantity(1.0, "kg"), self.stuck, self.slip)
