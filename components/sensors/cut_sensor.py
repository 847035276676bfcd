"""CutSensor: base of sensors of the load between two frames."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import branch, port, structural
from components.frame import Frame, TwoFrames, move
from components.orientation import null_rotation, resolve1
from components.sensors.one_frame_sensor import resolved


class CutSensor(TwoFrames):
    """Base of sensors in a rigid connection of two frames; a subclass defines the measured values."""

    resolve_in_frame: str = structural(
        "resolving frame of vectors", default="frame_a", choices=("world", "frame_a", "frame_resolve")
    )
    positive_sign: bool = structural(
        "whether the load at frame_a or that at frame_b is measured", default=True, choices=(True, False)
    )

    @port
    def frame_resolve(self) -> Frame | None:
        """Frame in which the vectors are resolved."""
        return Frame() if self.resolve_in_frame == "frame_resolve" else None

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        a, b = self.frame_a, self.frame_b
        yield from move(a, b, np.zeros(3), null_rotation())
        yield a.f + b.f == (0, 0, 0)
        yield a.t + b.t == (0, 0, 0)
        if self.resolve_in_frame == "frame_resolve":
            yield self.frame_resolve.f == (0, 0, 0)
            yield self.frame_resolve.t == (0, 0, 0)
        yield from self.measure()

    def signed(self, load: Any) -> Any:
        """Return the load in resolve_in_frame and with the measured sign, from the load at frame_a in frame_a."""
        load = load if self.positive_sign else -load
        if self.resolve_in_frame == "frame_a":
            return load
        return resolved(resolve1(self.frame_a.R, load), getattr(self, self.resolve_in_frame, None))

    def measure(self) -> Any:
        """Yield the equations of the measured values."""
        raise NotImplementedError("yields the equations of the measured values", "yield self.y == ...")

    def shapes(self):
        """No shape: the sensor has no size."""
        yield from ()
