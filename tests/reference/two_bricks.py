"""A body of two 8-node bricks that moves and deforms, by its Lagrangian: nodal masses, automatic differentiation, no moments."""

from __future__ import annotations

from functools import cached_property, reduce
from typing import Any

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

SIZE, COUNTS, DENSITY = (0.5, 0.2, 0.12), (2, 1, 1), 2500.0


def line_mass(length: float, elements: int) -> np.ndarray:
    """Consistent mass matrix of a line of linear elements and unit density; bricks are products of lines."""
    M = np.zeros((elements + 1, elements + 1))
    for j in range(elements):
        M[j : j + 2, j : j + 2] += length / elements / 6 * np.array([[2, 1], [1, 2]])
    return M


class TwoBricks:
    """Two bricks, off the axes of their frame, that deform far in `modes` random fields with a random stiffness."""

    def __init__(self, modes: int, seed: int) -> None:
        rng = np.random.default_rng(seed)
        grid = np.meshgrid(*(np.linspace(0, s, k + 1) for s, k in zip(SIZE, COUNTS, strict=True)), indexing="ij")
        turn = Rotation.from_rotvec([0.4, -0.3, 0.7]).as_matrix()
        self.nodes = np.stack([g.ravel() for g in grid], axis=1) @ turn.T + [0.3, -0.2, 0.1]
        self.masses = DENSITY * reduce(np.kron, (line_mass(s, k) for s, k in zip(SIZE, COUNTS, strict=True)))
        self.fields = rng.normal(size=(len(self.nodes), 3, modes))
        root = rng.normal(size=(modes, modes))
        self.K = 100 * root @ root.T
        self.state = {k: rng.normal(size=3) for k in ("x", "angles", "v", "rates", "acceleration", "second")}
        self.q, self.qd, self.qdd = [[0.3], [1], [1]] * rng.normal(size=(3, modes))
        self.modes = modes

    def moments(self) -> dict[str, Any]:
        """Integrals over the mass, by the names of ReducedBody."""
        m, X, phi = self.masses, self.nodes, self.fields
        B = np.einsum("ij,iab,jcd->bdac", m, phi, phi)
        return {
            "mass": float(m.sum()),
            "first_moment": m.sum(axis=0) @ X,
            "second_moment": X.T @ m @ X,
            "modal_first": np.einsum("ij,jab->ab", m, phi),
            "modal_second": np.einsum("ij,ia,jcb->bac", m, X, phi),
            "modal_products": B,
            "M": np.einsum("bcii->bc", B),
            "K": self.K,
            "D": np.zeros_like(self.K),
        }

    @cached_property
    def _symbols(self) -> tuple[ca.SX, ca.SX, ca.SX]:
        size = 6 + self.modes
        return ca.SX.sym("y", size), ca.SX.sym("yd", size), ca.SX.sym("ydd", size)

    def places(self, y: Any) -> Any:
        """World positions of the nodes, for generalized coordinates: origin, angles, amplitudes."""
        bent = [ca.DM(X) + ca.DM(f) @ y[6:] for X, f in zip(self.nodes, self.fields, strict=True)]
        return [y[:3] + turned(y[3:6]) @ r for r in bent]

    def forces(self, gravity: np.ndarray | None = None) -> np.ndarray:
        """Generalized forces d/dt (dL/dy') - dL/dy that the motion needs: on origin (world), angles and amplitudes."""
        y, yd, ydd = self._symbols
        rates = ca.horzcat(*(ca.jtimes(place, y, yd) for place in self.places(y)))
        kinetic = ca.trace(rates @ ca.DM(self.masses) @ rates.T) / 2
        potential = ca.bilin(ca.DM(self.K), y[6:], y[6:]) / 2
        if gravity is not None:
            each = self.masses.sum(axis=0)
            potential -= sum(m * ca.dot(gravity, place) for m, place in zip(each, self.places(y), strict=True))
        L = kinetic - potential
        momentum = ca.gradient(L, yd)
        needed = ca.jtimes(momentum, y, yd) + ca.jtimes(momentum, yd, ydd) - ca.gradient(L, y)
        s = self.state
        values = [
            np.r_[s["x"], s["angles"], self.q],
            np.r_[s["v"], s["rates"], self.qd],
            np.r_[s["acceleration"], s["second"], self.qdd],
        ]
        return np.array(ca.Function("forces", [y, yd, ydd], [needed])(*values)).ravel()

    def motion(self) -> tuple[np.ndarray, ...]:
        """Rotation matrix from the body to the world, slopes of w by the rates; a, z, w and v resolved in the body."""
        angles, rates, second = (ca.SX.sym(k, 3) for k in ("angles", "rates", "second"))
        A = turned(angles)
        spin = A.T @ ca.reshape(ca.jtimes(ca.vec(A), angles, rates), 3, 3)
        w = ca.vertcat(spin[2, 1], spin[0, 2], spin[1, 0])
        z = ca.jtimes(w, angles, rates) + ca.jtimes(w, rates, second)
        f = ca.Function("motion", [angles, rates, second], [A, ca.jacobian(w, rates), z, w])
        s = self.state
        A, G, z, w = (np.array(x) for x in f(s["angles"], s["rates"], s["second"]))
        return A, G, A.T @ s["acceleration"], z.ravel(), w.ravel(), A.T @ s["v"]


def turned(angles: Any) -> Any:
    """Rotation matrix from the body to the world, by three turns about x, y and z."""
    A = ca.SX.eye(3)
    for axis in range(3):
        c, s = ca.cos(angles[axis]), ca.sin(angles[axis])
        i, j = (axis + 1) % 3, (axis + 2) % 3
        T = ca.SX.eye(3)
        T[i, i], T[j, j], T[i, j], T[j, i] = c, c, -s, s
        A = A @ T
    return A
