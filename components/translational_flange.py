"""TranslationalFlange: the connector of one-dimensional translation."""

from __future__ import annotations

from acausal import Connector, Scalar, flow, variable


class TranslationalFlange(Connector):
    """End of a rod in one-dimensional translation."""

    s: Scalar = variable("absolute position", unit="m")
    f: Scalar = flow("cut force", unit="N")
