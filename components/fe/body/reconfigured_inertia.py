"""Inertia forces of a free body in the limit of short steps in reconfigured inertial frames."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import cross, dot, quantity
from components.fe.body.modal_inertia import ModalInertia, _tensor


@dataclass(frozen=True)
class ReconfiguredInertia(ModalInertia):
    """Inertia of a free body with mean axes in the limit of short steps.

    With G_k the antisymmetric matrices of the integrals of (phi_c x phi_b)_k dm and v = q' + M^-1 (w . G) q the rates
    of the modes in the inertial frame that the reference frame coincides with, P' twice the sum of g_b v_b and J' =
    trace(P') E - P',

    force = m a,    moment = J z + w x J w + J' w / 2,
    row b = W : g_b + (w . G v)_b + (M q'' + (z . G) q + (w . G) q')_b,

    with all integrals over the undeformed body: the corrected equations of `simulate_reconfigured` for dt -> 0, in the
    notation of `ModalInertia`. Moments use the levers of the undeformed body. `centrifugal` switches the part
    M^-1 (w . G) q of v, `coriolis` the terms in q' and w.

    Energy is not conserved, because w x u is projected on the modes. Without loads and damping, the sum of
    `kinetic_energy` and elastic energy changes at the rate -q . K M^-1 (w . G) q.
    """

    def forces(self, a: Any, z: Any, w: Any) -> tuple[Any, Any, Any]:
        """Return force, moment about the origin, and modal inertia forces; see `ModalInertia.forces`."""
        J, carried = _tensor(self._rest), self._around(w, self.q)
        rates = self._none
        modal = self.body.M @ self.qdd + self._around(z, self.q) + self._turned(w, self._straight)
        if self.centrifugal:
            rates += self._inverse @ carried
            modal += self._around(w, self._inverse @ carried)
        if self.coriolis:
            rates += self.qd
            modal += 2 * self._around(w, self.qd)
        moment = J @ z + cross(w, J @ w) + _tensor([dot(g, rates) for g in self._straight]) @ w
        return self.mass * a, moment, modal

    def first(self) -> Any:
        """Return the first moment of the mass, 0 with mean axes."""
        return quantity(np.zeros(3), "kg.m")

    def relative_momentum(self) -> Any:
        """Return the momentum of the modal rates, 0 with mean axes."""
        return quantity(np.zeros(3), "kg.m/s")

    def rates(self, w: Any) -> Any:
        """Return the modal rates in the inertial frame in m/s, shape (n,)."""
        return self.qd + self._inverse @ self._around(w, self.q)

    def kinetic_energy(self, v: Any, w: Any) -> Any:
        """Return the kinetic energy in J of the undeformed body and of the modal rates in the inertial frame."""
        rates = self.rates(w)
        return (self.mass * dot(v, v) + dot(w, _tensor(self._rest) @ w) + dot(rates, self.body.M @ rates)) / 2

    def _around(self, w: Any, values: Any) -> Any:
        """Return (w . G) values."""
        return self._along([G @ values for G in self._gyroscopic], w)

    @property
    def _inverse(self) -> Any:
        return np.linalg.inv(self.body.M)
