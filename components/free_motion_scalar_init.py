"""FreeMotionScalarInit: joint with six degrees of freedom and scalar start values."""

from __future__ import annotations

from functools import reduce
from typing import Any

import numpy as np

from acausal import PREFER, Scalar, as_expr, branch, der, structural, variable
from components.frame import TwoFrames, move
from components.orientation import absolute_rotation, planar_rotation, resolve1, resolve2
from components.sensors.angles import axes_angles


class FreeMotionScalarInit(TwoFrames):
    """Joint with six degrees of freedom: each coordinate of frame_b relative to frame_a has its own start value.

    Notes
    -----
    With use_angle=True the three angles are states, which are singular when the first and the third axis are parallel.
    Otherwise the orientation of the body at frame_b is the state and determines the angles.
    """

    use_angle: bool = structural("whether the angles are states", default=False, choices=(True, False))
    sequence_start: Any = structural(
        "rotation axes of the angles",
        default=(1, 2, 3),
        shape=(3,),
        choices=(1, 2, 3),
        doc="Rotated axes; no axis twice in a row.",
    )
    r_rel_a_1: Scalar = variable("x of frame_b, resolved in frame_a", unit="m", select=PREFER)
    r_rel_a_2: Scalar = variable("y of frame_b, resolved in frame_a", unit="m", select=PREFER)
    r_rel_a_3: Scalar = variable("z of frame_b, resolved in frame_a", unit="m", select=PREFER)
    v_rel_a_1: Scalar = variable("der(r_rel_a_1)", unit="m/s", select=PREFER)
    v_rel_a_2: Scalar = variable("der(r_rel_a_2)", unit="m/s", select=PREFER)
    v_rel_a_3: Scalar = variable("der(r_rel_a_3)", unit="m/s", select=PREFER)
    a_rel_a_1: Scalar = variable("der(v_rel_a_1)", unit="m/s2")
    a_rel_a_2: Scalar = variable("der(v_rel_a_2)", unit="m/s2")
    a_rel_a_3: Scalar = variable("der(v_rel_a_3)", unit="m/s2")
    angle_1: Scalar = variable("first angle from frame_a to frame_b", unit="rad", select=PREFER)
    angle_2: Scalar = variable("second angle from frame_a to frame_b", unit="rad", select=PREFER)
    angle_3: Scalar = variable("third angle from frame_a to frame_b", unit="rad", select=PREFER)
    angle_d_1: Scalar = variable("der(angle_1)", unit="rad/s", select=PREFER)
    angle_d_2: Scalar = variable("der(angle_2)", unit="rad/s", select=PREFER)
    angle_d_3: Scalar = variable("der(angle_3)", unit="rad/s", select=PREFER)
    angle_dd_1: Scalar = variable("der(angle_d_1)", unit="rad/s2")
    angle_dd_2: Scalar = variable("der(angle_d_2)", unit="rad/s2")
    angle_dd_3: Scalar = variable("der(angle_d_3)", unit="rad/s2")
    w_rel_b_1: Scalar = variable("relative angular velocity about x of frame_b", unit="rad/s")
    w_rel_b_2: Scalar = variable("relative angular velocity about y of frame_b", unit="rad/s")
    w_rel_b_3: Scalar = variable("relative angular velocity about z of frame_b", unit="rad/s")
    z_rel_b_1: Scalar = variable("der(w_rel_b_1)", unit="rad/s2")
    z_rel_b_2: Scalar = variable("der(w_rel_b_2)", unit="rad/s2")
    z_rel_b_3: Scalar = variable("der(w_rel_b_3)", unit="rad/s2")

    def connections(self):
        if self.use_angle:
            yield branch(self.frame_a, self.frame_b)

    def equations(self):
        r, v, a, angle, angle_d, angle_dd, w, z = (
            as_expr([getattr(self, f"{name}_{k}") for k in (1, 2, 3)])
            for name in ("r_rel_a", "v_rel_a", "a_rel_a", "angle", "angle_d", "angle_dd", "w_rel_b", "z_rel_b")
        )
        for rate, value in ((v, r), (a, v), (angle_d, angle), (angle_dd, angle_d), (z, w)):
            yield rate == der(value)
        yield from self._to_motion(r, angle, w) if self.use_angle else self._from_motion(r, angle, w)
        for frame in (self.frame_a, self.frame_b):
            yield frame.f == (0, 0, 0)
            yield frame.t == (0, 0, 0)

    def _to_motion(self, r: Any, angle: Any, w: Any) -> Any:
        """Motion of frame_b from the coordinates."""
        axes = (np.eye(3)[int(axis) - 1] for axis in self.sequence_start)
        R = reduce(absolute_rotation, (planar_rotation(n, angle[k]) for k, n in enumerate(axes)))
        yield w == R.w
        yield from move(self.frame_a, self.frame_b, r, R)

    def _from_motion(self, r: Any, angle: Any, w: Any) -> Any:
        """Coordinates from the motion of frame_b."""
        a, b = self.frame_a, self.frame_b
        yield r == resolve2(a.R, b.r_0 - a.r_0)
        yield angle == axes_angles(b.R.T @ a.R.T.T, self.sequence_start)
        yield w == b.R.w - resolve2(b.R, resolve1(a.R, a.R.w))

    def shapes(self):
        """No shape: the part has no size."""
        yield from ()
