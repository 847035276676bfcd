"""DCElectricalExcited: machine with a separate excitation."""

from __future__ import annotations

from acausal import Scalar, der, parameter, port, variable
from components.electrical.dc_machine import DCMachine
from components.electrical.pin import Pin


class DCElectricalExcited(DCMachine):
    """Machine with a commutator and a separate excitation."""

    I_e_nominal: Scalar = parameter("nominal current of the excitation", unit="A", default=1, positive=True)
    R_e: Scalar = parameter("resistance of the excitation", unit="Ohm", default=100)
    L_e: Scalar = parameter("inductance of the excitation", unit="H", default=1)
    pin_ep: Pin = port(Pin, "positive pin of the excitation")
    pin_en: Pin = port(Pin, "negative pin of the excitation")
    ve: Scalar = variable("voltage of the excitation", unit="V")
    ie: Scalar = variable("current of the excitation", unit="A", fixed=True)

    def equations(self):
        yield from super().equations()
        yield self.ve == self.pin_ep.v - self.pin_en.v
        yield self.pin_ep.i == self.ie
        yield self.pin_en.i == -self.ie
        yield self.ve == self.R_e * self.ie + self.L_e * der(self.ie)

    def coefficient(self):
        """Proportional to the current of the excitation."""
        return self.nominal_coefficient() * self.ie / self.I_e_nominal

    def loss(self):
        """Power of the resistances."""
        return self.R_a * self.ia**2 + self.R_e * self.ie**2

    def stored_energy(self):
        """Energy of the fields and of the rotor."""
        return super().stored_energy() + self.L_e * self.ie**2 / 2
