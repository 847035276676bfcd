"""BodyRod: a thin uniform rod."""

from __future__ import annotations

from acausal import Matrix33, Scalar, Vector3, parameter
from components.orientation import skew
from components.two_frame_body import TwoFrameBody


class BodyRod(TwoFrameBody):
    """Thin uniform rod along r: m r^2 / 12 across it, no moment of inertia about its own axis.

    Parameters
    ----------
    r : array of 3 floats
        From frame_a to frame_b along the rod, resolved in frame_a, in m.
    m : float
        Mass in kg.
    r_CM, I
        Centre of mass from frame_a in m and inertia tensor about it in kg.m2, both resolved in frame_a; given instead of
        the values of the rod.
    """

    r: Vector3 = parameter("from frame_a to frame_b, resolved in frame_a", unit="m")
    m: Scalar = parameter("mass", unit="kg", minimum=0)
    r_CM: Vector3 = parameter("centre of mass, resolved in frame_a", unit="m", default=lambda s: s.r / 2)
    I: Matrix33 = parameter(
        "inertia tensor about the centre of mass",
        unit="kg.m2",
        default=lambda s: s.m / 12 * (skew(s.r).T @ skew(s.r)),
    )
