"""ElastoGap: compliant stop of a spring and a damper."""

from __future__ import annotations

from acausal import Expr, Scalar, parameter, piecewise
from components.thermal.heat_loss import HeatLoss
from components.translational.compliant import Compliant


class ElastoGap(HeatLoss, Compliant):
    """Spring and damper of a compliant stop, in contact for s_rel < s_rel0.

    Notes
    -----
    The damper force is limited to the spring force, so that the stop is never adhesive.

    The two stops of a Prismatic with a drive are a gap from `support` to `axis` with s_rel0 = s_min, and one from `axis` to
    `support` with s_rel0 = -s_max.
    """

    c: Scalar = parameter("spring constant", unit="N/m", minimum=0)
    d: Scalar = parameter("damping constant", unit="N.s/m", minimum=0)
    s_rel0: Scalar = parameter("unstretched length", unit="m", default=0, doc="No force beyond it.")
    s_ref: Scalar = parameter("compression at which the force is f_ref", unit="m", default=1, positive=True)
    f_ref: Scalar = parameter(
        "force at the compression s_ref",
        unit="N",
        default=lambda s: s.c * s.s_ref,
        minimum=0,
        doc="c s_ref if not given.",
    )
    n: Scalar = parameter(
        "exponent of the force",
        unit="1",
        default=1,
        minimum=1,
        doc="The spring force is -f_ref ((s_rel0 - s_rel) / s_ref)^n.",
    )

    def law(self):
        """Spring and limited damper in contact, else 0."""
        yield self.f == piecewise((-self._spring() + self._damping(), self._compression() > 0), 0)

    def stored_energy(self):
        """Elastic energy."""
        energy = self._spring() * self._compression() / (self.n + 1)
        return piecewise((energy, self._compression() > 0), 0)

    def loss(self):
        """Power of the damper."""
        return piecewise((self._damping() * self.v_rel, self._compression() > 0), 0)

    def _compression(self) -> Expr:
        return self.s_rel0 - self.s_rel

    def _spring(self) -> Expr:
        return self.f_ref * abs(self._compression() / self.s_ref) ** self.n

    def _damping(self) -> Expr:
        most, free = self._spring(), self.d * self.v_rel
        return piecewise((most, free > most), (-most, free < -most), free)
