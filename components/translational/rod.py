"""Rod: rigid massless rod."""

from __future__ import annotations

from components.translational.rigid import Rigid


class Rod(Rigid):
    """Rigid massless rod."""

    def equations(self):
        yield from super().equations()
        yield self.flange_a.f + self.flange_b.f == 0
