"""Inertia forces of a beam whose sections vary, have offsets or shear, by quadrature."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from acausal import as_expr
from components.beams.inertia import Nodal
from components.beams.nodes import Nodes
from components.beams.pair import Pair
from components.beams.station import Station, Vector
from components.orientation import skew

Coordinates = tuple[Nodes, Any]  # nodal coordinates, bubble coefficients


@dataclass(frozen=True)
class PointInertia:
    """Inertia of masses at stations of a beam, with the methods of `Inertia`.

    Four points of Gauss are exact for the products of the shape functions.

    Parameters
    ----------
    stations : list of (Station, Expr)
        Stations, and masses of all elements in kg.
    place, rate, acceleration : (Nodes, Expr)
        Nodal coordinates and bubble coefficients in m, and their derivatives.
    centrifugal, coriolis : bool
        As in `Inertia`.
    """

    stations: list[tuple[Station, Any]]
    place: Coordinates
    rate: Coordinates
    acceleration: Coordinates
    centrifugal: bool = True
    coriolis: bool = True

    @property
    def mass(self) -> Any:
        """Mass of the beam in kg."""
        return sum((sum(m, as_expr(0.0)) for _, m in self.stations), as_expr(0.0))

    def _position(self, at: Station) -> Vector:
        return _plus(at.rest, at.displacement(*self.place))

    def _spread(self, forces: list[Vector]) -> Nodal:
        nodal, on_c = Nodes.zero(len(self.place[0].u)), 0.0 * self.place[1] if len(self.place[1]) else ()
        nothing = Pair(*[np.zeros(len(self.place[0].u) - 1)] * 2)
        for (at, _), force in zip(self.stations, forces, strict=True):
            own, more = at.on_nodes(force, nothing, nothing.y)
            nodal, on_c = nodal.plus(own), on_c + more if len(on_c) else on_c
        return nodal, on_c

    def forces(self, a: Any, z: Any, w: Any) -> tuple[Any, Any, Nodal]:
        """Force, moment about the origin, and nodal forces of inertia, as `Inertia.forces`."""
        Z, W, C, found = skew(z), skew(w) @ skew(w), 2 * skew(w), []
        force = moment = as_expr(np.zeros(3))
        for at, m in self.stations:
            r = self._position(at)
            acc = _plus(
                _times(Z, r), _times(W, r if self.centrifugal else at.rest), at.displacement(*self.acceleration)
            )
            if self.coriolis:
                acc = _plus(acc, _times(C, at.displacement(*self.rate)))
            found.append(Vector(*(k * m + m * own for k, own in zip(a, acc, strict=True))))
            force, moment = force + _total(found[-1]), moment + _moment(r, found[-1])
        return force, moment, self._spread(found)

    def first_moment(self) -> Any:
        """First moment of mass, the integral of r, in kg.m, shape (3,)."""
        return sum(
            (_total(Vector(*(m * k for k in self._position(at)))) for at, m in self.stations), as_expr(np.zeros(3))
        )

    def momentum(self) -> Nodal:
        """Generalised momenta of the rates of deformation alone, in kg.m/s."""
        return self._spread([Vector(*(m * k for k in at.displacement(*self.rate))) for at, m in self.stations])

    def kinetic_energy(self, v: Any, w: Any) -> Any:
        """Kinetic energy in J, with velocity and angular velocity of the frame resolved in it."""
        total, W = as_expr(0.0), skew(w)
        for at, m in self.stations:
            own = _plus(_times(W, self._position(at)), at.displacement(*self.rate))
            for k, part in zip(v, own, strict=True):
                speed = k * np.ones(len(part)) + part
                total += (m * speed) @ speed / 2
        return total

    def deformation_momentum(self) -> tuple[Any, Any]:
        """Momentum of the rates of deformation in kg.m/s, and their angular momentum about the origin in kg.m2/s."""
        nothing = as_expr(np.zeros(3))
        force, moment, _ = replace(self, acceleration=self.rate, coriolis=False).forces(nothing, nothing, nothing)
        return force, moment

    def element(self, j: int) -> PointInertia:
        """Inertia of element j alone, in the same frame."""
        n = len(self.place[0].u) - 1
        return replace(self, stations=[(at, m * (np.arange(n) == j)) for at, m in self.stations])


def _plus(*vectors: Vector) -> Vector:
    return Vector(*(sum(parts[1:], parts[0]) for parts in zip(*vectors, strict=True)))


def _times(M: Any, r: Vector) -> Vector:
    return Vector(*(M[i, 0] * r.x + M[i, 1] * r.y + M[i, 2] * r.z for i in range(3)))


def _total(r: Vector) -> Any:
    return as_expr([sum(part, as_expr(0.0)) for part in r])


def _moment(r: Vector, f: Vector) -> Any:
    return as_expr((r.y @ f.z - r.z @ f.y, r.z @ f.x - r.x @ f.z, r.x @ f.y - r.y @ f.x))
