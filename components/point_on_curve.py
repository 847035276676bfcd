"""PointOnCurve: guidance of a point along a curve."""

from __future__ import annotations

from typing import Any

from acausal import (
    PREFER,
    DeclarationError,
    Expr,
    Scalar,
    as_expr,
    cross,
    der,
    dot,
    geometry,
    require,
    structural,
    variable,
)
from components.frame import TwoFrames, pose
from components.gradient import gradient
from components.orientation import resolve1, resolve2


class PointOnCurve(TwoFrames):
    """Guides the origin of frame_b along a curve fixed to frame_a, without friction; the rotation is free.

    Notes
    -----
    r_rel = c(u), f . dc/du = 0. No branch: other parts hold both frames, or the frames belong to free bodies. The constraint
    is bilateral. On a curve that passes a point repeatedly, u=guess(...) selects the branch at the start. The curve must be
    twice differentiable with nonzero dc/du.

    Examples
    --------
    >>> PointOnCurve(curve=lambda u: (0.3 * cos(u), 0.2 * sin(u), 0))  # doctest: +SKIP
    """

    curve: Any = structural(
        "function of u returning the three coordinates of the point, resolved in frame_a",
        cls=object,
        doc="In m; u may be any parameter, such as an angle or a length.",
    )
    u: Scalar = variable("curve parameter of the point", select=PREFER)
    der_u: Scalar = variable("der(u)", select=PREFER)
    der2_u: Scalar = variable("der(der_u)")
    f: Any = variable("force of the curve on the point, resolved in frame_a", unit="N", shape=(3,))

    def check(self) -> None:
        """Reject a curve that is not a function."""
        if not callable(self.curve):
            raise DeclarationError(
                "`curve` is not a function; give a function of u, such as curve=lambda u: (0.3 * cos(u), 0.2 * sin(u), 0)."
            )

    def equations(self):
        a, b = self.frame_a, self.frame_b
        c = self._point()
        yield self.der_u == der(self.u)
        yield self.der2_u == der(self.der_u)
        yield resolve2(a.R, b.r_0 - a.r_0) == c
        yield dot(self.f, self._tangent(c)) == 0
        yield a.f == self.f
        yield a.t == cross(c, self.f)
        yield b.f == -resolve2(b.R, resolve1(a.R, self.f))
        yield b.t == (0, 0, 0)

    def requirements(self):
        tangent = self._tangent(self._point())
        yield require(
            dot(tangent, tangent) > 0,
            "the curve has no tangent at the start, dc/du = 0; use another parameter u, or start elsewhere: u=guess(...)",
        )

    def shapes(self):
        """The point."""
        yield geometry.Sphere(pose(self.frame_b))

    def _point(self) -> Expr:
        c = as_expr(self.curve(self.u))
        if c.shape != (3,):
            raise DeclarationError(
                "`curve` does not return three coordinates; give a function such as curve=lambda u: (u, 0.1 * u**2, 0)."
            )
        return c

    def _tangent(self, c: Expr) -> Expr:
        """dc/du."""
        return gradient(c, self.u)
