"""TriaxialSpring: linear springs and dampers along three axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Vector3, cross, dot, geometry, parameter, variable
from components.frame import TwoFrames
from components.orientation import resolve1, resolve2
from components.thermal.heat_loss import HeatLoss


class TriaxialSpring(HeatLoss, TwoFrames):
    """Linear springs and dampers along the three axes of frame_a, which act on the origin of frame_b.

    Notes
    -----
    f = f_0 + diag(c) (r_rel - r_rel0) + diag(d) v_rel. At frame_a the opposite force acts, with the moment r_rel x f. No branch:
    the component does not relate the orientations of its ends; other parts must hold both.
    """

    c: Vector3 = parameter("stiffness along the axes of frame_a", unit="N/m", minimum=0)
    d: Vector3 = parameter("damping along the axes of frame_a", unit="N.s/m", default=(0, 0, 0), minimum=0)
    r_rel0: Vector3 = parameter(
        "position of frame_b from frame_a at zero elastic force, resolved in frame_a", unit="m", default=(0, 0, 0)
    )
    f_0: Vector3 = parameter("preload: force f at r_rel0, resolved in frame_a", unit="N", default=(0, 0, 0))
    r_rel: Vector3 = variable("position of frame_b from frame_a, resolved in frame_a", unit="m")
    v_rel: Vector3 = variable("der(r_rel)", unit="m/s")
    f: Vector3 = variable("restoring force on frame_b, resolved in frame_a", unit="N")

    def equations(self):
        yield from super().equations()
        a, b, (f, t) = self.frame_a, self.frame_b, self.load()
        yield self.r_rel == resolve2(a.R, b.r_0 - a.r_0)
        yield self.v_rel == resolve2(a.R, resolve1(b.R, b.v)) - a.v - cross(a.R.w, self.r_rel)
        yield self.f == f
        yield a.f == -self.f
        yield a.t == -t - cross(self.r_rel, self.f)
        yield b.f == self.rotation_matrix() @ self.f
        yield b.t == self.rotation_matrix() @ t

    def load(self) -> tuple[Any, Any]:
        """Force and torque at frame_b, resolved in frame_a."""
        return self._spring() + self.d * self.v_rel, np.zeros(3)

    def rotation_matrix(self) -> Any:
        """Rotation matrix from frame_a to frame_b."""
        return self.frame_b.R.T @ self.frame_a.R.T.T

    def shapes(self):
        """A coil."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0, "coil")

    def stored_energy(self):
        """Elastic energy and work against the preload."""
        return dot(self._spring() + self.f_0, self.r_rel - self.r_rel0) / 2

    def loss(self):
        """Power of the dampers."""
        return dot(self.d * self.v_rel, self.v_rel)

    def _spring(self) -> Any:
        return self.f_0 + self.c * (self.r_rel - self.r_rel0)
