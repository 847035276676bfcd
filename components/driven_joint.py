"""DrivenJoint: base of joints with one freedom, which may have a drive, friction and an elastic drive."""

from __future__ import annotations

from typing import Any

from acausal import DeclarationError, branch, effect, structural, tanh
from components.frame import TwoFrames
from components.world import require_direction


class DrivenJoint(TwoFrames):
    """Base of joints along or about an axis n; a subclass declares n, d, compliance and its own motion."""

    use_axis_flange: bool = structural(
        "whether the joint has a drive",
        default=False,
        choices=(True, False),
        doc="True gives the joint a drive `axis` and the housing of the drive, `support`.",
    )
    friction: bool = effect("friction in the joint", default=True, doc="False leaves out viscous and dry friction.")
    elasticity: bool = effect(
        "compliance of the drive", default=True, doc="False makes the drive rigid, whatever its compliance."
    )
    n: Any
    d: Any
    compliance: Any

    def check(self) -> None:
        """Refuse an axis of length 0, and compliance of a drive that is not there."""
        require_direction(self, self.n, "n")
        if not self.use_axis_flange and not self.compliance.sx.is_zero():
            where = f"{self._path} ({type(self).__name__})"
            raise DeclarationError(
                f"`compliance` of {where} is that of the drive, which this joint does not have; give it one, "
                f"{type(self).__name__}(use_axis_flange=True, compliance=...), or leave the compliance out."
            )

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def drag(self, speed: Any, dry: Any, slow: Any) -> Any:
        """Friction d speed + dry tanh(speed / slow) against the motion, or 0; a dry friction of 0 leaves no tanh."""
        return self.d * speed + dry * tanh(speed / slow) if self.friction else 0.0

    def give(self, load: Any) -> Any:
        """How far the drive is ahead of the joint under its load, or 0."""
        return self.compliance * load if self.elasticity else 0.0
