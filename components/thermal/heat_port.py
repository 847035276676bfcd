"""HeatPort: the connector of heat."""

from __future__ import annotations

from typing import ClassVar

from acausal import Connector, Scalar, flow, variable


class HeatPort(Connector):
    """Place where heat is exchanged."""

    domain: ClassVar[str] = "thermal"
    T: Scalar = variable("absolute temperature", unit="K", start=293.15)
    Q_flow: Scalar = flow("flow of heat into the component", unit="W")
