"""The limit dt -> 0 of steps in reconfigured inertial frames, as a component: an ordinary differential equation in body axes.

With v_f = q' + M^-1 (w . G) q the rates of the modes in the inertial frame, G_k the antisymmetric matrices of the integrals of
(phi_c x phi_b)_k dm, and the integrals of the undeformed body: m a = f, J z + w x J w + J'(v_f) w / 2 = moment with the levers of
the undeformed body, and M v_f' + (W : A) + (w . G) v_f + K q + D v_f = Phi' f + Psi' t.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import as_expr, cross, der, dot, fixed, part, quantity
from components.fe import FEBody
from components.fe.body.modal_inertia import ModalInertia, _tensor
from components.fe.body.modal_properties import critical_damping
from components.frame import move
from components.orientation import null_rotation, resolve1, rodrigues_rotation
from models import FEPlate
from models.fe_plate import REST, plate


@dataclass(frozen=True)
class LimitInertia(ModalInertia):
    """Inertia forces of the limit, for a body with mean axes."""

    def rates(self, w: Any) -> Any:
        """v_f, shape (n,)."""
        return self.qd + np.linalg.inv(self.body.M) @ self._carried(w, self.q)

    def forces(self, a: Any, z: Any, w: Any) -> tuple[Any, Any, Any]:
        """Force, moment and forces of inertia on the modes."""
        J, v_f = _tensor(self._rest), self.rates(w)
        x, y, k = (w[i] * w[i] for i in range(3))
        W = (x - k, y - k, 2 * (w[0] * w[1]), 2 * (w[0] * w[2]), 2 * (w[1] * w[2]), -(x + y))
        moment = J @ z + cross(w, J @ w) + _tensor([dot(g, v_f) for g in self._straight]) @ w
        changed = self.body.M @ self.qdd + self._carried(z, self.q) + self._carried(w, self.qd)
        centrifugal = sum((factor * g for factor, g in zip(W, self._straight, strict=True)), self._none)
        return self.mass * a, moment, changed + centrifugal + self._carried(w, v_f)

    def _carried(self, w: Any, rates: Any) -> Any:
        return self._along([C @ rates for C in self._gyroscopic], w)


class LimitBody(FEBody):
    """A body without weight in this motion."""

    def equations(self):
        ref = self.reference
        inertia = LimitInertia(self._body, self.q, self.qd, self.qdd)
        force, moment, modal = inertia.forces(ref.a, ref.z, ref.R.w)
        f, t, load = ref.f, ref.t, as_expr(np.zeros(self.modes))
        for k, (interface, frame) in enumerate(self._moving):
            X, theta = quantity(interface.place, "m"), interface.rotation @ self.q
            R = rodrigues_rotation(theta) if np.any(interface.rotation) else null_rotation()
            yield from move(ref, frame, X + interface.displacement @ self.q, R)
            f_k, t_k = self.frame_force[k], self.frame_torque[k]
            yield f_k == resolve1(R, frame.f)
            yield t_k == resolve1(R, frame.t)
            f, t = f + f_k, t + t_k + cross(X, f_k)
            load += interface.displacement.T @ f_k + interface.rotation.T @ t_k
        drag = self.damping_ratio * (critical_damping(self._body) @ inertia.rates(ref.R.w))
        yield from (force == f, moment == t, modal + self._elastic() + drag == load)
        yield from (self.qd == der(self.q), self.qdd == der(self.qd))
        yield from self.motion(ref)


class LimitPlate(FEPlate):
    """`fe-plate` with it."""

    @part
    def body(self):
        start: dict = {"angles_fixed": True, "r_0": REST, "v_0": REST, "w_a": fixed(tuple(self.spin))}
        return LimitBody(reduced=plate(str(self.mesh), self.modes), damping_ratio=self.damping, **start)
