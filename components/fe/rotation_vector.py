"""Attitudes by rotation vectors, without a division by 0 where there is no turn."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import cos, cross, sin, sqrt
from components.orientation import outer_product, skew

# Added to the square of an angle: below the square root of the rounding error, so that no sine or cosine changes by it.
NOTHING = 1e-30


def attitude(m: Any) -> Any:
    """Matrix that turns world components into those of a frame turned by a rotation vector: equation (18), shape (3, 3).

    Parameters
    ----------
    m : Expr, shape (3,)
        Rotation vector in rad.
    """
    square = m @ m + NOTHING
    half = sqrt(square) / 2
    share = sin(half) / half
    return np.eye(3) - share * cos(half) * skew(m) + share * share / 2 * (outer_product(m, m) - m @ m * np.eye(3))


def rate(m: Any, w: Any) -> Any:
    """Rate of a rotation vector: equations (20) and (22), shape (3,); it has no value after a full turn.

    Parameters
    ----------
    m : Expr, shape (3,)
        Rotation vector in rad.
    w : Expr, shape (3,)
        Angular velocity in rad/s, resolved in the turned frame.
    """
    square = m @ m + NOTHING
    half = sqrt(square) / 2
    turned = cross(m, w)
    return w + turned / 2 + (1 - half * cos(half) / sin(half)) / square * cross(m, turned)
