"""ControlledIdealOpeningSwitch: switch that is open while the voltage of its control is above a level."""

from __future__ import annotations

from acausal import Scalar, parameter, port
from components.electrical.ideal_switch import IdealSwitch
from components.electrical.pin import Pin


class ControlledIdealOpeningSwitch(IdealSwitch):
    """Switch that is open while the voltage of its control is above a level."""

    level: Scalar = parameter("voltage of the control above which it acts", unit="V", default=0.5)
    control: Pin = port(Pin, "control, which takes no current")

    def equations(self):
        yield from super().equations()
        yield self.control.i == 0

    def open(self):
        """While the voltage is above the level."""
        return self.control.v > self.level
