"""LineForceLaw: line force as a function of length and speed."""

from __future__ import annotations

from typing import Any

from acausal import Expr, Scalar, as_expr, geometry, parameter, structural
from components.line_force import LineForce
from components.thermal.heat_loss import HeatLoss


class LineForceLaw(HeatLoss, LineForce):
    """Force along the line from frame_a to frame_b as a function of its length and rate of extension.

    Notes
    -----
    f = f_0 + force(s, v), with the spring force(s, 0) and the damper force(s, v) - force(s, 0).
    """

    force: Any = structural(
        "force as a function of s and v",
        choices=(callable,),
        doc="In N, positive in tension, for instance lambda s, v: 100 * (s - 0.3) + 2 * v * abs(v).",
    )
    energy: Any = structural(
        "elastic energy as a function of s",
        default=None,
        choices=(None, callable),
        doc="In J, with the derivative force(s, 0). Without it the work of force(s, 0) counts as supplied energy.",
    )
    f_0: Scalar = parameter("preload, a constant part of f", unit="N", default=0)

    def law(self):
        """Preload and specified function."""
        yield self.f == self.f_0 + self._force(self.v)

    def shapes(self):
        """A coil."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0, "coil")

    def stored_energy(self):
        """Work against the preload, and the elastic energy if specified."""
        return self.f_0 * self.s + (self._number(self.energy(Expr(self.s.sx))) if self.energy else 0.0)

    def supplied_power(self):
        """Power of the spring if its energy is not specified."""
        return 0.0 if self.energy else -self._force(0.0) * self.v

    def loss(self):
        """Power of the damper."""
        return (self._force(self.v) - self._force(0.0)) * self.v

    def _force(self, v: Any) -> Expr:
        return self._number(self.force(Expr(self.s.sx), Expr(as_expr(v).sx)))

    def _number(self, value: Any) -> Expr:
        """Value of a user's function, without units."""
        return Expr(as_expr(value).sx)
