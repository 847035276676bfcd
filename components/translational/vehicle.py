"""Vehicle: longitudinal dynamics of a vehicle."""

from __future__ import annotations

from acausal import PREFER, Component, Scalar, der, input, parameter, port, sqrt, variable
from components.flange import Flange
from components.regularized_sign import regularized_sign
from components.translational.flange import TranslationalFlange


class Vehicle(Component):
    """Longitudinal dynamics of a vehicle on wheels without slip, with drag, rolling resistance and road inclination.

    Notes
    -----
    (m + J / R^2) a = tau / R + f - Cd A rho (v - v_wind) |v - v_wind| / 2 - m g (cr cos(alpha) sign(v) + sin(alpha)), where
    tan(alpha) is the inclination.
    """

    ends = ("flange_r", "flange_t")
    m: Scalar = parameter("mass", unit="kg", minimum=0)
    g: Scalar = parameter("acceleration of gravity", unit="m/s2", default=9.80665)
    J: Scalar = parameter("moment of inertia of the drive train", unit="kg.m2", minimum=0)
    R: Scalar = parameter("radius of the wheels", unit="m", positive=True)
    A: Scalar = parameter("cross section", unit="m2", minimum=0)
    Cd: Scalar = parameter("drag coefficient", unit="1", minimum=0)
    rho: Scalar = parameter("density of air", unit="kg/m3", default=1.2, minimum=0)
    v_wind_constant: Scalar = parameter("wind speed", unit="m/s", default=0)
    cr_constant: Scalar = parameter("coefficient of rolling resistance", unit="1", default=0.015, minimum=0)
    v_reg: Scalar = parameter(
        "speed below which the rolling resistance is linear", unit="m/s", default=1e-3, positive=True
    )
    inclination_constant: Scalar = parameter(
        "inclination of the road", unit="1", default=0, doc="Tangent of the angle."
    )
    v_wind: Scalar = input(
        "variable wind speed",
        unit="m/s",
        default=lambda s: s.v_wind_constant,
        doc="v_wind_constant if not given.",
    )
    cr: Scalar = input(
        "variable coefficient of rolling resistance",
        unit="1",
        default=lambda s: s.cr_constant,
        doc="cr_constant if not given.",
    )
    inclination: Scalar = input(
        "variable inclination of the road",
        unit="1",
        default=lambda s: s.inclination_constant,
        doc="Tangent of the angle; inclination_constant if not given.",
    )
    flange_r: Flange = port(Flange, "drive shaft")
    flange_t: TranslationalFlange = port(TranslationalFlange, "drawbar")
    s: Scalar = variable("position", unit="m", select=PREFER)
    v: Scalar = variable("der(s)", unit="m/s", select=PREFER)
    a: Scalar = variable("der(v)", unit="m/s2")
    f_drag: Scalar = variable("drag", unit="N")
    f_roll: Scalar = variable("rolling resistance", unit="N")
    f_grav: Scalar = variable("downhill force", unit="N")

    def equations(self):
        air, steepness = self.v - self.v_wind, sqrt(1 + self.inclination**2)
        yield self.flange_r.phi * self.R == self.s
        yield self.flange_t.s == self.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.f_drag == self.Cd * self.A * self.rho / 2 * air * abs(air)
        yield self.f_roll == self.cr * self.m * self.g / steepness * regularized_sign(self.v, self.v_reg, "linear")
        yield self.f_grav == self.m * self.g * self.inclination / steepness
        drive = self.flange_r.tau / self.R + self.flange_t.f
        yield (self.m + self.J / self.R**2) * self.a == drive - self.f_drag - self.f_roll - self.f_grav

    def stored_energy(self):
        """Kinetic energy."""
        return (self.m + self.J / self.R**2) * self.v**2 / 2

    def dissipated_power(self):
        """Power of the rolling resistance, and of the drag at the relative air speed."""
        return self.f_roll * self.v + self.f_drag * (self.v - self.v_wind)

    def supplied_power(self):
        """Power of the wind and of the slope."""
        return -self.f_drag * self.v_wind - self.f_grav * self.v
