"""Source: base of sources."""

from __future__ import annotations

from components.electrical.one_port import OnePort


class Source(OnePort):
    """Base of sources of voltage or current."""

    def supplied_power(self):
        """Power into the circuit."""
        return -self.v * self.i
