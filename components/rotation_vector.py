"""Orientations by rotation vectors, regular at zero rotation."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import as_expr, atan2, cos, cross, piecewise, sin, sqrt
from components.orientation import outer_product, skew

# Added to the square of an angle in rad2: its root, 1e-15 rad, is below round-off of any sine or cosine.
NOTHING = 1e-30
# Square of an angle in rad2 below which series replace quotients 0 / 0; their first neglected term is below round-off.
SMALL = 0.02


def attitude(m: Any) -> Any:
    """Rotation matrix from the world to a frame rotated by a rotation vector, shape (3, 3).

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
    """Rate J(m) w of a rotation vector, shape (3,); singular at a full turn.

    With the angle phi = |m|, J(m) w = w + m x w / 2 + (1 - phi / 2 cot(phi / 2)) / phi^2 m x (m x w). As J(m)' = J(-m), it also
    maps a generalised torque g, with power g . der(m), to the torque J(m)' g = rate(-m, g), with power t . w.

    Parameters
    ----------
    m : Expr, shape (3,)
        Rotation vector in rad.
    w : Expr, shape (3,)
        Angular velocity in rad/s, resolved in the rotated frame; with J(-m), in the frame before the rotation.
    """
    square, turned = m @ m, cross(m, w)
    safe = piecewise((square, square > SMALL), SMALL, smooth=True)
    half = sqrt(safe) / 2
    closed = (1 - half * cos(half) / sin(half)) / safe
    series = _polynomial(square, (1 / 12, 1 / 720, 1 / 30240, 1 / 1209600, 1 / 47900160))
    return w + turned / 2 + piecewise((closed, square > SMALL), series, smooth=True) * cross(m, turned)


def rotation_vector(T: Any) -> Any:
    """Rotation vector in rad of a rotation matrix, shape (3,), up to half a turn; inverse of `attitude`.

    T - T' has the axial vector -2 sin(phi) n and T the trace 1 + 2 cos(phi): the result is phi / sin(phi) times sin(phi) n.

    Parameters
    ----------
    T : Expr, shape (3, 3)
        Rotation matrix.
    """
    sine, versine = sine_axis(T), (3 - T[0, 0] - T[1, 1] - T[2, 2]) / 2  # 1 - cos(phi), about phi^2 / 2
    far = versine > SMALL / 2
    size = sqrt(piecewise((sine @ sine + NOTHING, far), SMALL, smooth=True))
    closed = atan2(size, 1 - versine) / size
    series = _polynomial(versine, (1, 1 / 3, 2 / 15, 2 / 35, 8 / 315, 8 / 693, 16 / 3003))
    return piecewise((closed, far), series, smooth=True) * sine


def sine_axis(T: Any) -> Any:
    """Axis of a rotation matrix times the sine of its angle, shape (3,)."""
    return as_expr((T[1, 2] - T[2, 1], T[2, 0] - T[0, 2], T[0, 1] - T[1, 0])) / 2


def _polynomial(x: Any, coefficients: tuple[float, ...]) -> Any:
    """Polynomial with coefficients in ascending order, by Horner's scheme."""
    total = as_expr(coefficients[-1])
    for coefficient in coefficients[-2::-1]:
        total = coefficient + x * total
    return total
