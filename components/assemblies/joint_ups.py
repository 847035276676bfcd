"""JointUPS: chain of a universal, a prismatic and a ball joint."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError, Scalar, chain, connect, guess, parameter, part, port, require, structural
from components.driven import DrivenByRod
from components.fixed_translation import FixedTranslation
from components.frame import Frame
from components.orientation import parallel, unit_vector
from components.prismatic import Prismatic
from components.spherical import Spherical
from components.universal import Universal
from components.world import require_direction


class JointUPS(DrivenByRod):
    """Strut of length s + s_offset: universal joint at frame_a, prismatic joint, ball joint at frame_b.

    Notes
    -----
    The first axis of the universal joint is n1_a; the second is perpendicular to n1_a and to the strut.
    """

    n1_a: Any = structural(
        "first axis of the universal joint, resolved in frame_a",
        default=(0, 0, 1),
        shape=(3,),
        doc="Not parallel to the strut.",
    )
    n_axis_ia: Any = structural("from frame_a to frame_b, resolved in frame_ia", default=(1, 0, 0), shape=(3,))
    s_offset: Scalar = parameter("length at s = 0", unit="m", default=0)
    s_guess: Scalar = parameter("initial guess of s", unit="m", default=1, doc="The initial length is nonzero.")
    frame_ia: Frame = port(Frame, "fixed to the strut at frame_a")
    frame_ib: Frame = port(Frame, "fixed to the strut at frame_b")

    @part
    def universal(self):
        """Universal joint at frame_a."""
        return Universal(n_a=self.n1_a, n_b=np.cross(self.n1_a, self.n_axis_ia))

    @part
    def offset(self):
        """Shifts the zero of s."""
        return FixedTranslation(r=unit_vector(self.n_axis_ia) * self.s_offset)

    @part
    def prismatic(self):
        """Prismatic joint along the strut."""
        return Prismatic(n=self.n_axis_ia, s=guess(self.s_guess), use_axis_flange=self.use_axis_flange)

    @part
    def spherical(self):
        """Ball joint at frame_b."""
        return Spherical()

    def check(self) -> None:
        """Reject axes of length 0, and a strut parallel to the first axis."""
        require_direction(self, self.n1_a, "n1_a")
        require_direction(self, self.n_axis_ia, "n_axis_ia")
        if parallel(self.n1_a, self.n_axis_ia):
            raise DeclarationError(
                "`n1_a` is parallel to the strut `n_axis_ia`; give another axis, such as n1_a=(0, 1, 0)."
            )

    def requirements(self):
        yield require(
            self.prismatic.s + self.s_offset > 0,
            "the initial length of the strut is negative; give n_axis_ia a direction closer to that from frame_a to frame_b",
        )

    def connections(self):
        yield chain(self.frame_a, self.universal, self.offset, self.prismatic, self.spherical, self.frame_b)
        yield connect(self.universal.frame_b, self.frame_ia)
        yield connect(self.prismatic.frame_b, self.frame_ib)
        yield from self.drive_connections(self.prismatic)
