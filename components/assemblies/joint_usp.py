"""JointUSP: chain of a universal, a ball and a prismatic joint."""

from __future__ import annotations

from typing import Any

from acausal import connect, part, port, structural
from components.assemblies.prismatic_end import PrismaticEnd
from components.frame import Frame
from components.universal_spherical import UniversalSpherical


class JointUSP(PrismaticEnd):
    """Universal joint at frame_a, rod 1, ball joint in the middle, rod 2, prismatic joint at frame_b."""

    n1_a: Any = structural("first axis of the universal joint, resolved in frame_a", default=(0, 0, 1), shape=(3,))
    r_rod1_ia: Any = structural(
        "from frame_a to the ball joint, resolved in frame_ia, in m", default=(1, 0, 0), shape=(3,)
    )
    frame_ia: Frame = port(Frame, "fixed to rod 1 at frame_a")

    @part
    def rod1(self):
        """Rod with the universal and the ball joint."""
        return UniversalSpherical(n1_a=self.n1_a, r_rod_ia=self.r_rod1_ia)

    def connections(self):
        yield from super().connections()
        yield connect(self.rod1.frame_a, self.frame_a)
        yield connect(self.rod1.frame_ia, self.frame_ia)
        yield connect(self.rod1.frame_b, self.rod2.frame_b)
