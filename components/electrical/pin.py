"""Pin: connector of electrical components."""

from __future__ import annotations

from typing import ClassVar

from acausal import Connector, Scalar, flow, variable


class Pin(Connector):
    """Pin of an electrical component."""

    domain: ClassVar[str] = "electrical"
    reference: ClassVar[str] = "Ground"  # what a circuit needs, named if its potentials are undetermined
    v: Scalar = variable("potential", unit="V")
    i: Scalar = flow("current into the component", unit="A")
