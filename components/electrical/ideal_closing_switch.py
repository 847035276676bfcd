"""IdealClosingSwitch: switch that is closed while its control is true (above 0.5)."""

from __future__ import annotations

from acausal import Scalar, input
from components.electrical.ideal_switch import IdealSwitch


class IdealClosingSwitch(IdealSwitch):
    """Switch that is closed while its control is true (above 0.5)."""

    control: Scalar = input("truth value: closed")

    def open(self):
        """While the control is false."""
        return self.control <= 0.5
