"""PrismaticEnd: base of assemblies with a prismatic joint at frame_b."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, chain, connect, guess, parameter, part, port, structural
from components.driven import DrivenByRod
from components.fixed_translation import FixedTranslation
from components.frame import Frame
from components.orientation import unit_vector
from components.prismatic import Prismatic
from components.world import require_direction


class PrismaticEnd(DrivenByRod):
    """Base: prismatic joint at frame_b, then rod 2 up to the middle joint; a subclass connects frame_a to rod 2."""

    n_b: Any = structural("axis of the prismatic joint, resolved in frame_b", default=(-1, 0, 0), shape=(3,))
    r_rod2_ib: Any = structural(
        "from frame_ib to the middle joint, resolved in frame_ib, in m", default=(-1, 0, 0), shape=(3,)
    )
    s_offset: Scalar = parameter("distance between the frames of the prismatic joint at s = 0", unit="m", default=0)
    s_guess: Scalar = parameter(
        "initial guess of s",
        unit="m",
        default=0,
        doc="Selects the closer of the two assembly configurations; a guess midway between them may find neither.",
    )
    frame_ib: Frame = port(Frame, "fixed to rod 2 at the prismatic joint")
    frame_im: Frame = port(Frame, "fixed to rod 2 at the middle joint")

    @part
    def offset(self):
        """Shifts the zero of s."""
        return FixedTranslation(r=unit_vector(self.n_b) * self.s_offset)

    @part
    def prismatic(self):
        """Prismatic joint at frame_b."""
        return Prismatic(n=self.n_b, s=guess(self.s_guess), use_axis_flange=self.use_axis_flange)

    @part
    def rod2(self):
        """Rod from frame_ib to the middle joint."""
        return FixedTranslation(r=self.r_rod2_ib)

    def check(self) -> None:
        """Reject an axis of length 0."""
        require_direction(self, self.n_b, "n_b")

    def connections(self):
        yield chain(self.frame_b, self.offset, self.prismatic, self.rod2, self.frame_im)
        yield connect(self.prismatic.frame_b, self.frame_ib)
        yield from self.drive_connections(self.prismatic)
