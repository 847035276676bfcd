"""Angles of a rotation matrix, and HasAngles, the base of sensors that measure them."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Component, DeclarationError, Scalar, as_expr, atan2, cos, cross, dot, parameter, sin, structural


def axes_angles(T: Any, sequence: Any = (1, 2, 3), guess_angle1: Any = 0.0) -> Any:
    """Angles of three successive rotations about the axes of `sequence`, each about the rotated axis.

    Of the two solutions, the first angle is within 90 degrees of `guess_angle1`. If the first and the third axis are
    parallel, only the sum or the difference of their angles is determined.

    Parameters
    ----------
    T : Expr, shape (3, 3)
        Rotation matrix, from frame 1 to frame 2.
    sequence : sequence of 3 int
        Rotation axes, 1, 2 or 3; no axis twice in a row.
    guess_angle1 : float or Expr
        In rad.

    Returns
    -------
    Expr, shape (3,)
        In rad.
    """
    first, second, third = (np.eye(3)[int(axis) - 1] for axis in sequence)
    n_3, second_turned = T[int(sequence[2]) - 1], T[int(sequence[1]) - 1]  # axes of frame 2, resolved in frame 1
    across = np.cross(first, second)
    # The second axis, second cos(a) + across sin(a), is perpendicular to the third.
    A, B, g = dot(second, n_3), dot(across, n_3), guess_angle1
    s, c = A * cos(g) + B * sin(g), A * sin(g) - B * cos(g)
    a = g + atan2(s * c, c * c)
    n_2 = second * cos(a) + across * sin(a)
    n_3_before = third * cos(a) + np.cross(first, third) * sin(a) + first * (float(first @ third) * (1 - cos(a)))
    b = atan2(dot(n_2, cross(n_3_before, n_3)), dot(n_3_before, n_3))
    return as_expr((a, b, atan2(dot(n_3, cross(n_2, second_turned)), dot(n_2, second_turned))))


class HasAngles(Component):
    """Base of sensors of angles about a sequence of axes."""

    sequence: Any = structural("rotation axes, 1, 2 or 3", default=(1, 2, 3), shape=(3,))
    guess_angle1: Scalar = parameter("reference of angles[0], which is within 90 degrees of it", unit="rad", default=0)

    def check(self) -> None:
        """Reject invalid axis numbers, and one axis twice in a row."""
        super().check()
        a, b, c = self.sequence
        if not {a, b, c} <= {1, 2, 3} or a == b or b == c:
            raise DeclarationError(
                f"`sequence` is {tuple(self.sequence)}; give axes 1, 2 or 3, no axis twice in a row, such as sequence=(1, 2, 3)."
            )
