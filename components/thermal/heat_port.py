"""HeatPort: connector of heat transfer."""

from __future__ import annotations

from typing import ClassVar

from acausal import Connector, Scalar, flow, variable


class HeatPort(Connector):
    """Point of heat exchange."""

    domain: ClassVar[str] = "thermal"
    T: Scalar = variable("absolute temperature", unit="K", start=293.15)
    Q_flow: Scalar = flow("heat flow into the component", unit="W")
