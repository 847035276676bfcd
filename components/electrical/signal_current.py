"""SignalCurrent: source of a current that is a signal."""

from __future__ import annotations

from acausal import Scalar, input
from components.electrical.source import Source


class SignalCurrent(Source):
    """Source of a current that is a signal."""

    i: Scalar = input("current from p to n", unit="A")
