"""Ground: potential 0 of a circuit."""

from __future__ import annotations

from acausal import Component, port
from components.electrical.pin import Pin


class Ground(Component):
    """Potential 0. Every circuit needs one."""

    p: Pin = port(Pin, "pin at potential 0")

    def equations(self):
        yield self.p.v == 0
