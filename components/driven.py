"""Driven: base of joints and assemblies with an optional drive."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, ClassVar

from acausal import connect, port, structural
from components.flange import Flange
from components.frame import TwoFrames
from components.translational.flange import TranslationalFlange


class Driven(TwoFrames):
    """Base of joints and assemblies with an optional drive; a subclass declares the ports `axis` and `support`."""

    use_axis_flange: bool = structural(
        "whether the joint has a drive",
        default=False,
        choices=(True, False),
        doc="True adds the drive port `axis` and the housing of the drive, `support`.",
    )
    axis: ClassVar[Any]
    support: ClassVar[Any]

    def drive_connections(self, joint: Any) -> Iterator[Any]:
        """Connect the drive ports to those of the joint inside an assembly."""
        if self.use_axis_flange:
            yield connect(self.axis, joint.axis)
            yield connect(self.support, joint.support)


class DrivenByShaft(Driven):
    """Base of joints and assemblies with an optional rotational drive."""

    @port
    def axis(self) -> Flange | None:
        """Drive shaft."""
        return Flange() if self.use_axis_flange else None

    @port
    def support(self) -> Flange | None:
        """Housing of the drive."""
        return Flange() if self.use_axis_flange else None


class DrivenByRod(Driven):
    """Base of joints and assemblies with an optional translational drive."""

    @port
    def axis(self) -> TranslationalFlange | None:
        """Drive rod."""
        return TranslationalFlange() if self.use_axis_flange else None

    @port
    def support(self) -> TranslationalFlange | None:
        """Housing of the drive."""
        return TranslationalFlange() if self.use_axis_flange else None
