"""Double wishbone suspension."""

from __future__ import annotations

from acausal import Component, Scalar, chain, connect, parameter, part, port, structural
from components import FixedTranslation, Frame, Revolute, SphericalSpherical, SpringDamperParallel, Universal
from components.constraints import Spherical
from models.vehicle.arm import Arm
from models.vehicle.points import length, offset, point
from models.vehicle.upright import Upright


class DoubleWishbone(Component):
    """Two arms with an upright, a tie rod for steering, and a strut between lower arm and chassis."""

    ends = ("frame_a", "frame_b")
    side: int = structural("1 on the right, -1 on the left", default=1, choices=(1, -1))
    lower_in, lower_out = point("bearing of the lower arm", 0, 0.2, 0.35), point("its ball joint", 0, 0.2, 0.7)
    upper_in, upper_out = point("bearing of the upper arm", 0, 0.45, 0.42), point("its ball joint", 0, 0.45, 0.68)
    tie_in, tie_out = point("inner end of the tie rod", -0.12, 0.25, 0.38), point("outer end", -0.12, 0.25, 0.7)
    strut_in, strut_out = point("strut at the chassis", 0, 0.65, 0.48), point("strut at the lower arm", 0, 0.2, 0.6)
    hub = point("centre of the wheel", 0, 0.3, 0.75)
    c: Scalar = parameter("stiffness of the strut", unit="N/m", default=4e4)
    d: Scalar = parameter("damping constant of the strut", unit="N.s/m", default=3e3)
    preload: Scalar = parameter("initial force of the strut", unit="N", default=3.6e3)
    frame_a, frame_b = port(Frame, "fixed to the chassis"), port(Frame, "fixed to the upright at the wheel")
    frame_tie = port(Frame, "inner end of the tie rod")
    tilt, steer, ball = Universal(n_a=(1, 0, 0), n_b=(0, 0, 1)), Revolute(n=(0, 1, 0)), Spherical()
    lower = part(lambda s: Arm(at=s.to("lower_in"), r=s.to("lower_out", "lower_in"), m=6, starts=True))
    upper = part(lambda s: Arm(at=s.to("upper_in"), r=s.to("upper_out", "upper_in"), m=3))
    at_strut = part(lambda s: FixedTranslation(r=s.to("strut_in")))
    on_arm = part(lambda s: FixedTranslation(r=s.to("strut_out", "lower_out")))
    tie = part(lambda s: SphericalSpherical(rod_length=length(s.tie_in, s.tie_out), m=1))

    @part
    def upright(self):
        """Upright, mounted on the lower arm."""
        return Upright(**{f"r_{end}": self.to(name, "lower_out") for end, name in ENDS.items()})

    @part
    def strut(self):
        """Spring and damper, replaceable."""
        s_unstretched = length(self.strut_in, self.strut_out) + self.preload / self.c
        return SpringDamperParallel(c=self.c, d=self.d, s_unstretched=s_unstretched)

    def to(self, end: str, start: str | None = None):
        """Return the vector to a point from another point, or from the origin of frame_a."""
        return offset(getattr(self, start) if start else (0, 0, 0), getattr(self, end), self.side)

    def connections(self):
        yield chain(self.frame_a, self.lower, self.tilt, self.steer, self.upright, self.frame_b)
        yield chain(self.frame_a, self.upper, self.ball, self.upright.upper)
        yield chain(self.frame_tie, self.tie, self.upright.tie)
        yield chain(self.frame_a, self.at_strut, self.strut, self.on_arm.frame_b)
        yield connect(self.lower.frame_b, self.on_arm.frame_a)


ENDS = {"upper": "upper_out", "tie": "tie_out", "hub": "hub"}
