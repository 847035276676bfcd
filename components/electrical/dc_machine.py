"""DCMachine: base of machines with a commutator."""

from __future__ import annotations

import math
from typing import Any

from acausal import Scalar, der, parameter, port, structural, variable
from components.electrical.pin import Pin
from components.flange import Flange
from components.thermal.heat_loss import HeatLoss


class DCMachine(HeatLoss):
    """Base of machines with a commutator: armature with resistance and inductance, and a rotor."""

    V_a_nominal: Scalar = parameter("nominal voltage of the armature", unit="V", default=100)
    I_a_nominal: Scalar = parameter("nominal current of the armature", unit="A", default=100)
    w_nominal: Scalar = parameter("nominal speed", unit="rad/s", default=1425 * 2 * math.pi / 60, positive=True)
    R_a: Scalar = parameter("resistance of the armature", unit="Ohm", default=0.05)
    L_a: Scalar = parameter("inductance of the armature", unit="H", default=0.0015)
    J_r: Scalar = parameter("moment of inertia of the rotor", unit="kg.m2", default=0.15, minimum=0)
    use_support: bool = structural("whether the housing has a flange `support`", default=False, choices=(True, False))
    pin_ap: Pin = port(Pin, "positive pin of the armature")
    pin_an: Pin = port(Pin, "negative pin of the armature")
    flange: Flange = port(Flange, "shaft end")
    va: Scalar = variable("voltage of the armature", unit="V")
    ia: Scalar = variable("current of the armature", unit="A", fixed=True)
    phi_mechanical: Scalar = variable("angle of the rotor against the housing", unit="rad")
    w_mechanical: Scalar = variable("speed of the rotor against the housing", unit="rad/s")
    tau_electrical: Scalar = variable("torque of the field on the rotor", unit="N.m")

    @port
    def support(self) -> Flange | None:
        """Housing."""
        return Flange() if self.use_support else None

    def equations(self):
        yield from super().equations()
        k = self.coefficient()
        yield self.va == self.pin_ap.v - self.pin_an.v
        yield self.pin_ap.i == self.ia
        yield self.pin_an.i == -self.ia
        yield self.va == self.R_a * self.ia + self.L_a * der(self.ia) + k * self.w_mechanical
        yield self.tau_electrical == k * self.ia
        yield self.phi_mechanical == self.flange.phi - (self.support.phi if self.use_support else 0)
        yield self.w_mechanical == der(self.phi_mechanical)
        yield self.flange.tau == self.J_r * der(der(self.flange.phi)) - self.tau_electrical
        if self.use_support:
            yield self.support.tau == self.tau_electrical

    def nominal_coefficient(self) -> Any:
        """Torque over current at nominal operation, in N.m/A: the induced voltage over the speed."""
        return (self.V_a_nominal - self.R_a * self.I_a_nominal) / self.w_nominal

    def coefficient(self) -> Any:
        """Torque over current, in N.m/A."""
        raise NotImplementedError("returns the torque over the current", "return ...")

    def loss(self):
        """Power of the resistances."""
        return self.R_a * self.ia**2

    def stored_energy(self):
        """Energy of the field and of the rotor."""
        return self.L_a * self.ia**2 / 2 + self.J_r * der(self.flange.phi) ** 2 / 2
