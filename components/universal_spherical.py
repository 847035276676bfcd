"""UniversalSpherical: a rod with a universal joint and a ball joint at its ends."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError, Vector3, chain, connect, part, port, structural, variable
from components.fixed_translation import FixedTranslation
from components.frame import Frame, TwoFrames
from components.orientation import parallel
from components.spherical import Spherical
from components.universal import Universal
from components.world import require_direction


class UniversalSpherical(TwoFrames):
    """Massless rod with a universal joint at frame_a and a ball joint at frame_b; bodies of the rod are fixed to frame_ia.

    Notes
    -----
    The first axis of the universal joint is n1_a, the second is at right angles to that and to the rod.
    """

    n1_a: Any = structural(
        "first axis of the universal joint, resolved in frame_a",
        default=(0, 0, 1),
        shape=(3,),
        doc="Not along the rod.",
    )
    r_rod_ia: Any = structural("from frame_a to frame_b, resolved in frame_ia, in m", default=(1, 0, 0), shape=(3,))
    frame_ia: Frame = port(Frame, "fixed to the rod at frame_a")
    r_rod_0: Vector3 = variable("from frame_a to frame_b, resolved in the world", unit="m")

    def check(self) -> None:
        """Refuse a rod of length 0, and one along the first axis."""
        require_direction(self, self.n1_a, "n1_a")
        require_direction(self, self.r_rod_ia, "r_rod_ia")
        if parallel(self.n1_a, self.r_rod_ia):
            raise DeclarationError("`n1_a` lies along the rod `r_rod_ia`; give another axis, such as n1_a=(0, 1, 0).")

    @part
    def universal(self):
        """Universal joint at frame_a."""
        return Universal(n_a=self.n1_a, n_b=np.cross(self.n1_a, self.r_rod_ia))

    @part
    def rod(self):
        """Rod from frame_a to frame_b."""
        return FixedTranslation(r=self.r_rod_ia)

    @part
    def spherical(self):
        """Ball joint at frame_b."""
        return Spherical()

    def connections(self):
        yield chain(self.frame_a, self.universal, self.rod, self.spherical, self.frame_b)
        yield connect(self.universal.frame_b, self.frame_ia)

    def equations(self):
        yield self.r_rod_0 == self.frame_b.r_0 - self.frame_a.r_0
