"""Rope: elastic rope over frictionless points."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from acausal import (
    Expr,
    Scalar,
    apart,
    discrete,
    dot,
    geometry,
    parameter,
    piecewise,
    ports,
    require,
    sqrt,
    structural,
    variable,
)
from components.frame import Frame, TwoFrames
from components.orientation import norm, resolve1, resolve2
from components.thermal.heat_loss import HeatLoss


class Rope(HeatLoss, TwoFrames):
    """Massless elastic rope from frame_a over the origins of frame_1, frame_2, ... to frame_b, without compression.

    Notes
    -----
    If the rope is taut, s > length, the tension is f = max(0, c (s - length) + d der(s)). It is uniform because the points
    are massless and frictionless, like pulleys of zero radius. At each point it acts along both adjacent segments. If
    neighbouring points meet under tension, the segment between them has no direction and the run ends with an error.

    No branch: the rope does not relate orientations; other parts must hold each frame.
    """

    points: int = structural(
        "number of points between the ends", default=0, cls=int, minimum=0, doc="Its ports are frame_1, frame_2, ..."
    )
    c: Scalar = parameter("spring constant of the whole rope", unit="N/m", positive=True, doc="E A / length.")
    d: Scalar = parameter("damping constant of the whole rope", unit="N.s/m", default=0, minimum=0)
    length: Scalar = parameter(
        "unstretched length",
        unit="m",
        default=0,
        minimum=0,
        doc="0: the initial length of the path.",
    )
    s_small: Scalar = parameter(
        "smallest distance between points used as a divisor",
        unit="m",
        default=1e-10,
        positive=True,
        doc="Lower bound of the distances in the directions of the segments.",
    )
    s: Scalar = variable("length of the path over all points", unit="m")
    v: Scalar = variable("der(s)", unit="m/s")
    f: Scalar = variable("tension, not negative", unit="N")
    length_0: Scalar = discrete("effective unstretched length", unit="m", start=piecewise((length, length > 0), s))

    @ports
    def over(self) -> dict[str, Frame]:
        """Frames of the intermediate points."""
        return {f"frame_{k + 1}": Frame() for k in range(self.points)}

    def equations(self):
        yield from super().equations()
        e, none = self._directions(), 0 * self._directions()[0]
        yield self.s == _total(self._lengths())
        yield self.v == _total(self._rates())
        yield self.f == piecewise((self._pull(), (self.s > self.length_0) & (self._pull() > 0)), 0)
        for frame, before, after in zip(self._frames(), [none, *e], [*e, none], strict=True):
            yield frame.f == resolve2(frame.R, self.f * (before - after))
            yield frame.t == (0, 0, 0)

    def requirements(self):
        name = self._path or type(self).__name__
        for part, (one, other) in zip(self._offsets(), pairwise(self._names()), strict=True):
            yield require(
                norm(part) > 1.5 * self.s_small,
                f"{one} and {other} of {name} coincide at the start and the rope between them has no direction; separate them, "
                "or omit one of them",
            )

    def validity(self):
        for part, rate, (one, other) in zip(self._offsets(), self._rates(), pairwise(self._names()), strict=True):
            yield apart(
                part,
                rate,
                self.f,
                f"{one} and {other} meet, where the rope has no direction. Offset their paths, for instance by "
                "FixedTranslation(r=...), or add a stop that keeps them apart",
            )

    def shapes(self):
        """The straight segments."""
        for one, other in pairwise(self._frames()):
            yield geometry.Span(one.r_0, other.r_0, "rope")

    def stored_energy(self):
        """Elastic energy."""
        return self.c * self._stretch() ** 2 / 2

    def loss(self):
        """Power of the damper."""
        return (self.f - self.c * self._stretch()) * self.v

    def _stretch(self) -> Expr:
        """Elongation, 0 for a slack rope."""
        elongation = self.s - self.length_0
        return (elongation + abs(elongation)) / 2

    def _pull(self) -> Expr:
        return self.c * self._stretch() + self.d * self.v

    def _names(self) -> list[str]:
        return ["frame_a", *self.over, "frame_b"]

    def _frames(self) -> list[Any]:
        return [self.frame_a, *self.over.values(), self.frame_b]

    def _offsets(self) -> list[Any]:
        """Vectors along the segments, resolved in the world."""
        return [other.r_0 - one.r_0 for one, other in pairwise(self._frames())]

    def _lengths(self) -> list[Any]:
        least = self.s_small**2
        squares = [dot(part, part) for part in self._offsets()]
        return [sqrt(piecewise((square, square > least), least, smooth=True)) for square in squares]

    def _directions(self) -> list[Any]:
        return [part / length for part, length in zip(self._offsets(), self._lengths(), strict=True)]

    def _rates(self) -> list[Any]:
        """Derivatives of the lengths."""
        v = [resolve1(frame.R, frame.v) for frame in self._frames()]
        return [dot(e, after - before) for e, (before, after) in zip(self._directions(), pairwise(v), strict=True)]


def _total(values: list[Any]) -> Any:
    return sum(values[1:], values[0])
