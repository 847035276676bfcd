"""Right-angle frame: two elastic legs, moved out of their plane by a pulse at the elbow (Simo, Vu-Quoc 1988)."""

from math import pi

import acausal as ac
from acausal import Model, Scalar, chain, connect, output, part, piecewise, structural, time
from components import FixedRotation, Section, SubstructuredBeam, World, WorldForce

LEG = Section(EA=1e6, EJ_y=1e3, EJ_z=1e3, GJ_t=1e3, mass=1.0, I_y=10.0, I_z=10.0, kGA_y=1e6, kGA_z=1e6)


class RightAngleFrame(Model):
    """Legs of 10 m; the root is clamped, the force at the elbow grows to 50 N within 1 s and vanishes after 2 s."""

    stop_time = 10.0
    volumes: int = structural("volumes of a leg", default=8, minimum=1)
    world, elbow = World(gravity=None), FixedRotation(n=(0, 0, 1), angle=pi / 2)
    pulse = WorldForce(force=(0, 0, piecewise((50 * time, time < 1), (50 * (2 - time), time < 2), 0)))
    tip_x: Scalar = output("displacement of the tip along x", unit="m")
    tip_y: Scalar = output("displacement of the tip along y", unit="m")
    tip_z: Scalar = output("displacement of the tip across the undeformed plane", unit="m")

    def _leg(self):
        return SubstructuredBeam(
            length=10.0, section=LEG, volumes=self.volumes, geometric_stiffness=True, rotary_inertia=True
        )

    @part
    def first(self):
        return self._leg()

    @part
    def second(self):
        return self._leg()

    def connections(self):
        yield chain(self.world, self.first, self.elbow, self.second)
        yield connect(self.pulse.frame_b, self.first.frame_b)

    def equations(self):
        tip = self.second.frame_b.r_0
        yield from (self.tip_x == tip[0] - 10, self.tip_y == tip[1] - 10, self.tip_z == tip[2])


if __name__ == "__main__":
    ac.simulate(RightAngleFrame(), stop_time=10.0).plot("tip_x", "tip_y", "tip_z", path="right-angle-frame.png")
