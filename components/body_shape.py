"""BodyShape: rigid body with two frames."""

from __future__ import annotations

import numpy as np

from acausal import Matrix33, Scalar, Vector3, parameter
from components.two_frame_body import TwoFrameBody


class BodyShape(TwoFrameBody):
    """Rigid body with mass and inertia tensor, and with frame_b at r from frame_a."""

    r: Vector3 = parameter("from frame_a to frame_b, resolved in frame_a", unit="m")
    m: Scalar = parameter("mass", unit="kg", minimum=0)
    r_CM: Vector3 = parameter("centre of mass, resolved in frame_a", unit="m", default=(0, 0, 0))
    I: Matrix33 = parameter(
        "inertia tensor about the centre of mass", unit="kg.m2", default=np.zeros((3, 3)), doc="Resolved in frame_a."
    )
