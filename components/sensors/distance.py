"""Distance: measures the distance between two frames."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, dot, output, parameter, piecewise, sqrt
from components.frame import TwoFrames


def distance(frame_a: Any, frame_b: Any, s_small: Any = 1e-10) -> Any:
    """Distance between the origins of two frames, regularised below s_small, in m."""
    r = frame_b.r_0 - frame_a.r_0
    square = dot(r, r)
    return piecewise(
        (sqrt(square), square > s_small**2), square / (2 * s_small) * (3 - square / s_small**2), smooth=True
    )


class Distance(TwoFrames):
    """Measures the distance between the origins of frame_a and frame_b."""

    s_small: Scalar = parameter("distance of regularisation", unit="m", default=1e-10, positive=True)
    distance: Scalar = output("distance between the origins", unit="m")

    def equations(self):
        for frame in (self.frame_a, self.frame_b):
            yield frame.f == (0, 0, 0)
            yield frame.t == (0, 0, 0)
        yield self.distance == distance(self.frame_a, self.frame_b, self.s_small)

    def shapes(self):
        """No shape: the sensor has no size."""
        yield from ()
