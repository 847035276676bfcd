"""Rotor1D: rotor on a moving body."""

from __future__ import annotations

from typing import Any

from acausal import PREFER, Scalar, cross, der, dot, effect, geometry, parameter, port, structural, variable
from components.flange import TwoFlanges
from components.frame import Frame, pose
from components.orientation import unit_vector
from components.world import require_direction


class Rotor1D(TwoFlanges):
    """Rotor of a drive train with its housing fixed to frame_a.

    Notes
    -----
    J (a + e . z) = tau_a + tau_b,  t = w_a x (J w e) - J (e . z) e, with e along n and w_a, z the angular velocity and
    acceleration of frame_a. The mass and the inertia of the locked rotor belong to the carrying body. A Mounting1D or a
    BevelGear1D applies the reaction torques of the drive train to a body.
    """

    J: Scalar = parameter("moment of inertia about n", unit="kg.m2", minimum=0)
    n: Any = structural("rotation axis, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="Any nonzero length.")
    exact: bool = structural(
        "whether the angular acceleration of frame_a accelerates the rotor", default=True, choices=(True, False)
    )
    reaction: bool = effect("reaction torque on the carrying body", default=True)
    frame_a: Frame = port(Frame, "housing of the rotor")
    phi: Scalar = variable("angle relative to frame_a", unit="rad", select=PREFER)
    w: Scalar = variable("der(phi)", unit="rad/s", select=PREFER)
    a: Scalar = variable("der(w)", unit="rad/s2")

    def check(self) -> None:
        """Reject an axis of length 0."""
        require_direction(self, self.n, "n")

    def equations(self):
        e, frame = unit_vector(self.n), self.frame_a
        carried = self.J * dot(e, frame.z)
        yield self.flange_a.phi == self.phi
        yield self.flange_b.phi == self.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.J * self.a == self.flange_a.tau + self.flange_b.tau - (carried if self.exact else 0)
        yield frame.f == (0, 0, 0)
        yield frame.t == (cross(frame.R.w, e * (self.J * self.w)) - e * carried if self.reaction else (0, 0, 0))

    def stored_energy(self):
        """Kinetic energy in excess of the locked rotor."""
        return self.J * self.w * (self.w / 2 + dot(unit_vector(self.n), self.frame_a.R.w))

    def shapes(self):
        """A rotor."""
        yield geometry.Axle(pose(self.frame_a), unit_vector(self.n), style="rotor")
