"""ControlledIdealOpeningSwitch: switch that is open while the voltage of its control is above a level."""

from __future__ import annotations

from components.electrical.controlled_ideal_switch import ControlledIdealSwitch


class ControlledIdealOpeningSwitch(ControlledIdealSwitch):
    """Switch that is open while the voltage of its control is above a level."""

    def open(self):
        """While the voltage is above the level."""
        return self.control.v > self.level
