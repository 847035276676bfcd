"""PointToPoint: the fastest way between two points, of all coordinates together."""

from __future__ import annotations

from functools import reduce
from typing import Any

from acausal import maximum, minimum, piecewise, sqrt


class PointToPoint:
    """Part s of a way from 0 to 1, with the greatest acceleration, then the greatest speed, then the greatest deceleration.

    Parameters
    ----------
    way, qd_max, qdd_max : Expr, shape (n,)
        Distances, and limits of speed and acceleration, of each coordinate.
    t : Expr
        Time since the start of the motion.

    Attributes
    ----------
    s, sd, sdd : Expr
        The part and its derivatives by time.
    moving : Expr
        1 during the motion, else 0.
    """

    def __init__(self, way: Any, qd_max: Any, qdd_max: Any, t: Any) -> None:
        slowest = reduce(maximum, [abs(d) / v for d, v in zip(way, qd_max, strict=True)])
        laziest = reduce(maximum, [abs(d) / a for d, a in zip(way, qdd_max, strict=True)])
        rise = minimum(laziest / slowest, sqrt(laziest))  # until the speed, or half of the way, is reached
        a, v = 1 / laziest, rise / laziest
        cruise = 1 / v - rise
        end = cruise + 2 * rise
        left = end - t
        self.sdd = piecewise((0, t < 0), (a, t < rise), (0, t < rise + cruise), (-a, t < end), 0)
        self.sd = piecewise((0, t < 0), (a * t, t < rise), (v, t < rise + cruise), (a * left, t < end), 0)
        self.s = piecewise(
            (0, t < 0),
            (a * t**2 / 2, t < rise),
            (v * (t - rise / 2), t < rise + cruise),
            (1 - a * left**2 / 2, t < end),
            1,
        )
        self.moving = piecewise((0, t < 0), (1, t < end), 0)
