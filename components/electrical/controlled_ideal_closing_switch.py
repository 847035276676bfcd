"""ControlledIdealClosingSwitch: switch that is closed while the voltage of its control is above a level."""

from __future__ import annotations

from components.electrical.controlled_ideal_switch import ControlledIdealSwitch


class ControlledIdealClosingSwitch(ControlledIdealSwitch):
    """Switch that is closed while the voltage of its control is above a level."""

    def open(self):
        """While the voltage is not above the level."""
        return self.control.v <= self.level
