"""DCPermanentMagnet: machine with permanent magnets."""

from __future__ import annotations

from components.electrical.dc_machine import DCMachine


class DCPermanentMagnet(DCMachine):
    """Machine with a commutator and permanent magnets.

    Notes
    -----
    The parameters and defaults are those of the Modelica Standard Library. Losses of brushes, iron and
    friction, and stray losses, are left out: its defaults have none.
    """

    def coefficient(self):
        """The one at nominal operation."""
        return self.nominal_coefficient()
