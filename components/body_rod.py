"""BodyRod: thin uniform rod."""

from __future__ import annotations

from typing import Any

from acausal import Matrix33, Scalar, Vector3, geometry, parameter
from components.frame import pose
from components.orientation import skew
from components.two_frame_body import TwoFrameBody


class BodyRod(TwoFrameBody):
    """Thin uniform rod along r: moment of inertia m r^2 / 12 about the transverse axes, 0 about its own axis.

    Notes
    -----
    It must not rotate freely about its own axis, as between two Spherical joints: give I, or use a BodyCylinder.
    """

    r: Vector3 = parameter("from frame_a to frame_b, resolved in frame_a", unit="m", doc="Axis of the rod.")
    m: Scalar = parameter("mass", unit="kg", minimum=0)
    r_CM: Vector3 = parameter(
        "centre of mass, resolved in frame_a", unit="m", default=lambda s: s.r / 2, doc="That of the rod if not given."
    )
    I: Matrix33 = parameter(
        "inertia tensor about the centre of mass",
        unit="kg.m2",
        default=lambda s: _inertia(s.m, s.r),
        doc="Resolved in frame_a; that of the rod if not given.",
    )

    def shapes(self):
        """The rod."""
        yield geometry.Cylinder(pose(self.frame_a), (0, 0, 0), self.r, style="link")


def _inertia(m: Any, r: Any) -> Any:
    S = skew(r)
    return m / 12 * (S.T @ S)
