"""JointSSP: chain of two ball joints and a prismatic joint."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, connect, parameter, part, structural
from components.assemblies.prismatic_end import PrismaticEnd
from components.spherical_spherical import SphericalSpherical


class JointSSP(PrismaticEnd):
    """Ball joint at frame_a, rod 1, ball joint in the middle, rod 2, prismatic joint at frame_b."""

    n_b: Any = structural("axis of the prismatic joint, resolved in frame_b", default=(0, 0, 1), shape=(3,))
    r_rod2_ib: Any = structural(
        "from frame_ib to the middle joint, resolved in frame_ib, in m", default=(1, 0, 0), shape=(3,)
    )
    rod1_length: Scalar = parameter("distance between the ball joints", unit="m", positive=True)
    rod1_mass: Scalar = parameter("mass at the midpoint of rod 1", unit="kg", default=0, minimum=0)

    @part
    def rod1(self):
        """Rod between the ball joints."""
        return SphericalSpherical(rod_length=self.rod1_length, m=self.rod1_mass)

    def connections(self):
        yield from super().connections()
        yield connect(self.rod1.frame_a, self.frame_a)
        yield connect(self.rod1.frame_b, self.rod2.frame_b)
