"""Planetary gearbox with three gears."""

from __future__ import annotations

from acausal import Component, Scalar, chain, connect, fixed, input, parameter, port
from components import Flange
from components.rotational import Clutch, Fixed, IdealPlanetary, Inertia


class PlanetaryGearbox(Component):
    """Two planetary gear sets, with each carrier coupled to the ring of the other, two clutches and a brake.

    Notes
    -----
    Two closed elements select a gear; the second carrier is the output. With the tooth ratios i1, i2 of rings and suns, the
    speed ratio of input and output is (1 + i1 + i2) / (1 + i1) with clutch 1 and the brake closed, 1 with both clutches, and
    i1 / (1 + i1) with clutch 2 and the brake. Clutch 1 drives the second sun, clutch 2 the first carrier; the brake holds the
    first sun.
    """

    ends = ("flange_a", "flange_b")
    ratio_1: Scalar = parameter("teeth of the ring over those of the sun, first gear set", unit="1", default=2)
    ratio_2: Scalar = parameter("teeth of the ring over those of the sun, second gear set", unit="1", default=2)
    tau_max: Scalar = parameter("torque of the closed clutches and brake", unit="N.m", default=500)
    J: Scalar = parameter("moment of inertia of each internal shaft", unit="kg.m2", default=0.05)
    clutch_1: Scalar = input("normal force of clutch 1 as a fraction of its maximum", unit="1", default=0)
    clutch_2: Scalar = input("normal force of clutch 2 as a fraction of its maximum", unit="1", default=0)
    brake: Scalar = input("normal force of the brake as a fraction of its maximum", unit="1", default=0)
    flange_a: Flange = port(Flange, "shaft of the motor")
    flange_b: Flange = port(Flange, "shaft of the load")
    first, second = IdealPlanetary(ratio=ratio_1), IdealPlanetary(ratio=ratio_2)
    to_sun = Clutch(tau_max=tau_max, f_normalized=clutch_1)
    to_carrier = Clutch(tau_max=tau_max, f_normalized=clutch_2)
    hold, housing = Clutch(tau_max=tau_max, f_normalized=brake), Fixed()
    sun, carrier = Inertia(J=J, phi=fixed(0), w=fixed(0)), Inertia(J=J)

    def connections(self):
        yield chain(self.flange_a, self.to_sun, self.second.sun)
        yield chain(self.flange_a, self.to_carrier, self.carrier, self.first.carrier)
        yield chain(self.housing.flange, self.hold, self.sun, self.first.sun)
        yield connect(self.first.carrier, self.second.ring)
        yield connect(self.first.ring, self.second.carrier)
        yield connect(self.second.carrier, self.flange_b)
