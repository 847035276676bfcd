"""OneFrameSensor: base of sensors of a frame."""

from __future__ import annotations

from typing import Any

from acausal import Component, port, structural
from components.frame import Frame
from components.orientation import resolve2


class OneFrameSensor(Component):
    """Base of sensors of a frame, which transmit no load; a subclass defines the measured values."""

    ends = ("frame_a", "frame_a")
    resolve_in_frame: str = structural(
        "resolving frame of vectors", default="frame_a", choices=("frame_a", "world", "frame_resolve")
    )
    frame_a: Frame = port(Frame, "measured frame")

    @port
    def frame_resolve(self) -> Frame | None:
        """Frame in which the vectors are resolved."""
        return Frame() if self.resolve_in_frame == "frame_resolve" else None

    @property
    def resolving(self) -> Any:
        """Frame in which the vectors are resolved, or None for the world."""
        return None if self.resolve_in_frame == "world" else getattr(self, self.resolve_in_frame)

    def equations(self):
        for frame in (self.frame_a, *((self.frame_resolve,) if self.resolve_in_frame == "frame_resolve" else ())):
            yield frame.f == (0, 0, 0)
            yield frame.t == (0, 0, 0)
        yield from self.measure()

    def measure(self) -> Any:
        """Yield the equations of the measured values."""
        raise NotImplementedError("yields the equations of the measured values", "yield self.y == ...")

    def shapes(self):
        """No shape: the sensor has no size."""
        yield from ()


def resolved(vector: Any, resolving: Any) -> Any:
    """Transform a vector from the world to the frame `resolving`; None is the world."""
    return vector if resolving is None else resolve2(resolving.R, vector)
