"""SignalVoltage: source of a voltage that is a signal."""

from __future__ import annotations

from acausal import Scalar, input
from components.electrical.source import Source


class SignalVoltage(Source):
    """Source of a voltage that is a signal."""

    v: Scalar = input("voltage p.v - n.v", unit="V")
