"""IdealOpeningSwitch: switch that is open while its control is true (above 0.5)."""

from __future__ import annotations

from acausal import Scalar, input
from components.electrical.ideal_switch import IdealSwitch


class IdealOpeningSwitch(IdealSwitch):
    """Switch that is open while its control is true (above 0.5)."""

    control: Scalar = input("truth value: open")

    def open(self):
        """While the control is true."""
        return self.control > 0.5
