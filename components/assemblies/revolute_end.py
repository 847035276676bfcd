"""RevoluteEnd: base of assemblies with a revolute joint at frame_b."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, chain, connect, guess, parameter, part, port, structural
from components.driven import DrivenByShaft
from components.fixed_rotation import FixedRotation
from components.fixed_translation import FixedTranslation
from components.frame import Frame
from components.revolute import Revolute
from components.world import require_direction


class RevoluteEnd(DrivenByShaft):
    """Base: revolute joint at frame_b, then rod 2 up to the middle joint; a subclass connects frame_a to rod 2."""

    n_b: Any = structural("axis of the revolute joint, resolved in frame_b", default=(0, 0, 1), shape=(3,))
    r_rod2_ib: Any = structural(
        "from frame_ib to the middle joint, resolved in frame_ib, in m", default=(-1, 0, 0), shape=(3,)
    )
    phi_offset: Any = structural("angle of the revolute joint at phi = 0, in rad", default=0.0, shape=())
    phi_guess: Scalar = parameter(
        "initial guess of phi",
        unit="rad",
        default=0,
        doc="Helps to select one of the two assembly configurations; a guess midway between them may find neither.",
    )
    frame_ib: Frame = port(Frame, "fixed to rod 2 at frame_b")
    frame_im: Frame = port(Frame, "fixed to rod 2 at the middle joint")

    @part
    def offset(self):
        """Turns the zero of phi."""
        return FixedRotation(n=self.n_b, angle=self.phi_offset)

    @part
    def revolute(self):
        """Revolute joint at frame_b."""
        return Revolute(n=self.n_b, phi=guess(self.phi_guess), use_axis_flange=self.use_axis_flange)

    @part
    def rod2(self):
        """Rod from frame_ib to the middle joint."""
        return FixedTranslation(r=self.r_rod2_ib)

    def check(self) -> None:
        """Reject an axis of length 0."""
        require_direction(self, self.n_b, "n_b")

    def connections(self):
        yield chain(self.frame_b, self.offset, self.revolute, self.rod2, self.frame_im)
        yield connect(self.revolute.frame_b, self.frame_ib)
        yield from self.drive_connections(self.revolute)
