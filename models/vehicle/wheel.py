"""Wheel with a tyre."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, chain, connect, fixed, parameter, part, port, structural
from components import Body, Flange, Frame, Rotor1D, Tyre
from models.vehicle.points import diagonal


class Wheel(Component):
    """Wheel rotating about z on an upright, with a drive shaft `axis`."""

    ends = ("frame_a", "axis")
    height: Any = structural("height of the ground, as for Tyre", default=None, choices=(None, callable))
    R_0: Scalar = parameter("radius of the unloaded tyre", unit="m", default=0.317)
    radius: Scalar = parameter("initial height of the centre, as the rolling radius", unit="m", default=0.3037)
    J: Scalar = parameter("moment of inertia about the axis", unit="kg.m2", default=1)
    v: Scalar = parameter("initial speed", unit="m/s", default=0)
    frame_a, axis = port(Frame, "fixed to the upright at the centre of the wheel"), port(Flange, "drive shaft")

    @part
    def body(self):
        """Mass, and inertia of the locked wheel."""
        return Body(m=20, I=diagonal(0.6 * self.J, 0.6 * self.J, self.J))

    @part
    def rotor(self):
        """Rotation relative to the upright."""
        return Rotor1D(J=self.J, n=(0, 0, 1), phi=fixed(0), w=fixed(-self.v / self.radius))

    @part
    def tyre(self):
        """Tyre, replaceable."""
        stiffness = {"c_z": 2.2e5, "d_z": 500, "c_kappa": 8e4, "c_alpha": 6e4}
        return Tyre(use_axis_flange=True, R_0=self.R_0, height=self.height, **stiffness)

    def connections(self):
        for member in (self.body, self.rotor, self.tyre):
            yield connect(self.frame_a, member.frame_a)
        yield chain(self.axis, self.rotor, self.tyre.axis)
