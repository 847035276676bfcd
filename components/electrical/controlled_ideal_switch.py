"""ControlledIdealSwitch: base of switches that a voltage controls."""

from __future__ import annotations

from acausal import Scalar, parameter, port
from components.electrical.ideal_switch import IdealSwitch
from components.electrical.pin import Pin


class ControlledIdealSwitch(IdealSwitch):
    """Base of switches that a voltage controls."""

    level: Scalar = parameter("voltage of the control above which it acts", unit="V", default=0.5)
    control: Pin = port(Pin, "control, which takes no current")

    def equations(self):
        yield from super().equations()
        yield self.control.i == 0
