"""JointRRR: planar chain of three revolute joints."""

from __future__ import annotations

from typing import Any

from acausal import connect, part, port, structural
from components.assemblies.revolute_end import RevoluteEnd
from components.frame import Frame
from components.universal_spherical import UniversalSpherical


class JointRRR(RevoluteEnd):
    """Revolute joint at frame_a, rod 1, revolute joint in the middle, rod 2, revolute joint at frame_b, all in one plane."""

    n_a: Any = structural("axis of the revolute joints, resolved in frame_a", default=(0, 0, 1), shape=(3,))
    r_rod1_ia: Any = structural(
        "from frame_a to the middle joint, resolved in frame_ia, in m", default=(1, 0, 0), shape=(3,)
    )
    frame_ia: Frame = port(Frame, "fixed to rod 1 at frame_a")

    @part
    def rod1(self):
        """Rod whose joints constrain no motion in the plane."""
        return UniversalSpherical(n1_a=self.n_a, r_rod_ia=self.r_rod1_ia)

    def connections(self):
        yield from super().connections()
        yield connect(self.rod1.frame_a, self.frame_a)
        yield connect(self.rod1.frame_ia, self.frame_ia)
        yield connect(self.rod1.frame_b, self.rod2.frame_b)
