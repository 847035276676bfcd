"""Inertia forces of a beam in a moving frame, with all couplings of rigid-body motion and deformation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from acausal import as_expr, dot
from components.beams.element import BeamMatrices, beam_matrices, places
from components.beams.nodes import Nodes
from components.orientation import skew

Nodal = tuple[Nodes, Any]  # forces on the nodal coordinates, and on the bubble coefficients, in N


class Place(NamedTuple):
    """Coordinates along (nodes, then bubbles), and across in y and z (v of all nodes, then l v'), in m, or forces on them."""

    x: Any
    y: Any
    z: Any

    @classmethod
    def of(cls, U: Nodes, c: Any) -> Place:
        """Return the place of nodal coordinates and bubble coefficients."""
        x = as_expr([*U.u, *c]) if len(c) else U.u
        return cls(x, as_expr([*U.v, *U.dv]), as_expr([*U.w, *U.dw]))

    def spread(self) -> Nodal:
        """Return forces on the nodal coordinates and on the bubble coefficients."""
        n = len(self.y) // 2
        nodal = Nodes(self.x[:n], self.y[:n], self.y[n:], self.z[:n], self.z[n:], as_expr(np.zeros(n)))
        return nodal, self.x[n:] if len(self.x) > n else ()


@dataclass(frozen=True)
class Inertia:
    """Inertia of N elements of constant section in a frame with acceleration a, angular acceleration z and velocity w.

    A point at r = (x, y, z), resolved in the frame, has the acceleration a + (z~ + w~ w~) r + 2 w~ r' + r'' (Schiavo,
    Vigano, Ferretti 2006, equations 36 to 38). Each component of it has one part among the shape functions along and one
    among those across. The mass matrices turn these parts into forces on the coordinates, and the forces on the
    coordinates in the three directions give the force, the moment and the nodal forces of inertia.

    Parameters
    ----------
    elements : int
        N.
    l, mu : Expr
        Length in m and mass in kg of an element.
    place, rate, acceleration : Place
        Place of the axis in the frame, and derivatives of its coordinates.
    centrifugal, coriolis : bool
        Whether w~ w~ r includes the deformation, beside the straight beam, and whether 2 w~ r' is included.
    first : int
        Number of the first element, at x = l first of the straight beam.
    """

    elements: int
    l: Any
    mu: Any
    place: Place
    rate: Place
    acceleration: Place
    centrifugal: bool = True
    coriolis: bool = True
    first: int = 0

    @property
    def mass(self) -> Any:
        """Mass of the beam in kg."""
        return self.elements * self.mu

    @cached_property
    def _matrices(self) -> BeamMatrices:
        return beam_matrices(self.elements, self._bubbles)

    @property
    def _bubbles(self) -> bool:
        return len(self.place.x) > self.elements + 1

    @cached_property
    def _one(self) -> np.ndarray:
        """Coordinates along of the function 1."""
        return np.arange(len(self.place.x)) <= self.elements

    def _forces(self, along: Any, across: Any) -> tuple[Any, Any]:
        """Forces on the coordinates along and across of an acceleration in m/s2, in N."""
        M = self._matrices
        return self.mu * (M.along @ along + M.mixed @ across), self.mu * (M.mixed.T @ along + M.across @ across)

    def forces(self, a: Any, z: Any, w: Any) -> tuple[Any, Any, Nodal]:
        """Force, moment about the origin, and nodal forces of inertia.

        Parameters
        ----------
        a, z, w : Expr, shape (3,)
            Acceleration minus gravity, angular acceleration and angular velocity of the frame, resolved in it.

        Returns
        -------
        force, moment : Expr, shape (3,)
            In N and N.m, resolved in the frame.
        nodal : (Nodes, Expr)
            In N, on the nodal coordinates and on the bubble coefficients.
        """
        r, turning = self.place, self.place if self.centrifugal else self._straight()
        Z, W, C = skew(z), skew(w) @ skew(w), 2 * skew(w)
        found = []
        for i in range(3):
            parts = [Z[i, j] * r[j] + W[i, j] * turning[j] for j in range(3)]
            if self.centrifugal:
                parts = [(Z[i, j] + W[i, j]) * r[j] for j in range(3)]
            if self.coriolis:
                parts = [part + C[i, j] * self.rate[j] for j, part in enumerate(parts)]
            parts[i] = parts[i] + self.acceleration[i]
            found.append(self._forces(parts[0] + a[i] * self._one, parts[1] + parts[2]))
        (x_along, x_across), (y_along, y_across), (z_along, z_across) = found
        force = as_expr([self._sum(along) for along, _ in found])
        moment = (
            dot(r.y, z_across) - dot(r.z, y_across),
            dot(r.z, x_across) - dot(r.x, z_along),
            dot(r.x, y_along) - dot(r.y, x_across),
        )
        return force, as_expr(moment), Place(x_along, y_across, z_across).spread()

    def _sum(self, along: Any) -> Any:
        """Sum of the forces of all nodes, whose shape functions add up to 1."""
        return dot(self._one, along)

    def _straight(self) -> Place:
        """Coordinates of the undeformed beam."""
        x = self.l * (self.first + np.arange(len(self.place.x))) * self._one
        return Place(x, 0.0 * self.place.y, 0.0 * self.place.z)

    def first_moment(self) -> Any:
        """First moment of mass, the integral of r, in kg.m, shape (3,)."""
        return self._moment(self.place)

    def _moment(self, r: Place) -> Any:
        zero = 0.0 * r.y
        parts = [self._forces(r.x, zero), self._forces(0.0 * r.x, r.y), self._forces(0.0 * r.x, r.z)]
        return as_expr([self._sum(along) for along, _ in parts])

    def momentum(self) -> Nodal:
        """Generalised momenta of the rates of deformation alone, in kg.m/s."""
        M, rate = self._matrices, self.rate
        own = self.mu * (M.along @ rate.x), self.mu * (M.across @ rate.y), self.mu * (M.across @ rate.z)
        return Place(*own).spread()

    def kinetic_energy(self, v: Any, w: Any) -> Any:
        """Kinetic energy in J, with velocity and angular velocity of the frame resolved in it."""
        total, W = as_expr(0.0), skew(w)
        for i in range(3):
            parts = [W[i, j] * self.place[j] for j in range(3)]
            parts[i] = parts[i] + self.rate[i]
            along, across = parts[0] + v[i] * self._one, parts[1] + parts[2]
            on_along, on_across = self._forces(along, across)
            total += (dot(along, on_along) + dot(across, on_across)) / 2
        return total

    def deformation_momentum(self) -> tuple[Any, Any]:
        """Momentum of the rates of deformation in kg.m/s, and their angular momentum about the origin in kg.m2/s."""
        still = replace(self, acceleration=self.rate, coriolis=False)
        nothing = as_expr(np.zeros(3))
        force, moment, _ = still.forces(nothing, nothing, nothing)
        return force, moment

    def element(self, j: int) -> Inertia:
        """Inertia of element j alone, in the same frame."""
        along, across = places(j, self.elements, self._bubbles)
        across = sorted(across)
        own = [_entries(x, along, across) for x in (self.place, self.rate, self.acceleration)]
        return replace(self, elements=1, place=own[0], rate=own[1], acceleration=own[2], first=self.first + j)


def _entries(r: Place, along: Sequence[int], across: Sequence[int]) -> Place:
    x, y, z = (as_expr([part[k] for k in at]) for part, at in zip(r, (along, across, across), strict=True))
    return Place(x, y, z)
