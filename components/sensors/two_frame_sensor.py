"""TwoFrameSensor: base of sensors between two frames."""

from __future__ import annotations

from typing import Any

from acausal import port, structural
from components.frame import Frame, TwoFrames


class TwoFrameSensor(TwoFrames):
    """Base of sensors between two frames, which transmit no load; a subclass defines the measured values."""

    resolve_in_frame: str = structural(
        "resolving frame of vectors", default="frame_a", choices=("frame_a", "frame_b", "world", "frame_resolve")
    )

    @port
    def frame_resolve(self) -> Frame | None:
        """Frame in which the vectors are resolved."""
        return Frame() if self.resolve_in_frame == "frame_resolve" else None

    @property
    def resolving(self) -> Any:
        """Frame in which the vectors are resolved, or None for the world."""
        return None if self.resolve_in_frame == "world" else getattr(self, self.resolve_in_frame)

    def equations(self):
        further = (self.frame_resolve,) if self.resolve_in_frame == "frame_resolve" else ()
        for frame in (self.frame_a, self.frame_b, *further):
            yield frame.f == (0, 0, 0)
            yield frame.t == (0, 0, 0)
        yield from self.measure()

    def measure(self) -> Any:
        """Yield the equations of the measured values."""
        raise NotImplementedError("yields the equations of the measured values", "yield self.y == ...")

    def shapes(self):
        """No shape: the sensor has no size."""
        yield from ()
