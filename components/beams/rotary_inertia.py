"""Inertia of the sections of a beam against rotation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from acausal import as_expr, cross, dot
from components.beams.nodes import Nodes, first, last, to_first, to_last
from components.beams.pair import Pair, Symmetric
from components.beams.section_rotation import SectionRotation
from components.beams.station import Station, Vector, entry


@dataclass(frozen=True)
class Spin:
    """Inertia against rotation about the axis alone: T = int I (w_x + phi')^2 / 2 dx.

    Parameters
    ----------
    polar : Expr
        Moment of inertia of every element about the axis in kg.m2.
    l : Expr
        Length of an element in m.
    rate, acceleration : Nodes
        Derivatives of the nodal coordinates, in m/s and m/s2.
    coriolis : bool
        Whether products of angular velocity and rates of deformation are included.
    """

    polar: Any
    l: Any
    rate: Nodes
    acceleration: Nodes
    coriolis: bool

    @property
    def _one(self) -> Any:
        return np.ones(len(self.polar))

    def _mean(self, U: Nodes) -> Any:
        """Mean of phi of the elements, in rad, or a derivative."""
        return (first(U.phi) + last(U.phi)) / (2 * self.l)

    def forces(self, z: Any, w: Any) -> tuple[Any, Nodes]:
        """Return the inertia moment in N.m, shape (3,), and nodal forces in N.

        Parameters
        ----------
        z, w : Expr, shape (3,)
            Angular acceleration and angular velocity of the frame, resolved in it.
        """
        spin = w[0] * self._one + self._mean(self.rate) if self.coriolis else w[0] * self._one
        L, own = dot(self.polar, spin), self.polar * (z[0] * self._one + self._mean(self.acceleration))
        apart = self.polar * (last(self.acceleration.phi) - first(self.acceleration.phi)) / (12 * self.l)
        turned = to_first(own / 2 - apart) + to_last(own / 2 + apart)
        moment = as_expr((sum(own, as_expr(0.0)), w[2] * L, -w[1] * L))
        return moment, Nodes.zero(len(turned))._replace(phi=turned / self.l)

    def momentum(self) -> tuple[Any, Nodes]:
        """Return the angular momentum of the rates of deformation in kg.m2/s, and their momenta in kg.m/s."""
        return _momentum(self)

    def kinetic_energy(self, w: Any) -> Any:
        """Kinetic energy in J."""
        mean, apart = w[0] * self._one + self._mean(self.rate), (last(self.rate.phi) - first(self.rate.phi)) / self.l
        return dot(self.polar, mean * mean / 2 + apart * apart / 24)

    def element(self, j: int) -> Spin:
        """Return the sections of element j alone."""
        return replace(self, polar=self.polar * (np.arange(len(self.polar)) == j))


@dataclass(frozen=True)
class Discs:
    """Sections as rigid discs, at the points of Simpson's rule in every element.

    Parameters
    ----------
    discs : list of (Station, Expr, Symmetric)
        Sections, their moments of inertia about the axis, and their second moments of mass along y and z, in kg.m2.
    place, rate, acceleration : Nodes
        Nodal coordinates in m, and their derivatives.
    second_order, centrifugal, coriolis : bool
        As in the beam.
    elements : iterable of int
        Elements that count.
    """

    discs: list[tuple[Station, Any, Symmetric]]
    place: Nodes
    rate: Nodes
    acceleration: Nodes
    second_order: bool
    centrifugal: bool
    coriolis: bool
    elements: Sequence[int]

    def _turned(
        self, at: Station, polar: Any, second: Symmetric
    ) -> Iterator[tuple[int, SectionRotation, Any, Any, Any, Any]]:
        """Yield elements with the rotation of their section, its inertia tensors undeformed and now, and its w and z."""
        motion = [at.rotation(U) for U in (self.place, self.rate, self.acceleration)]
        for j in self.elements:
            yy, yz, zz = (entry(x, j) for x in second)
            rest = as_expr([[entry(polar, j), 0.0, 0.0], [0.0, zz, -yz], [0.0, -yz, yy]])
            c, cd, cdd = ((slope.y[j], slope.z[j], phi[j]) for slope, phi in motion)
            rotation = SectionRotation(*c, self.second_order)
            T = rotation.matrix()
            yield j, rotation, rest, T.T @ rest @ T, *rotation.rates(as_expr(cd), as_expr(cdd))

    def forces(self, z: Any, w: Any) -> tuple[Any, Nodes]:
        """Return the inertia moment and nodal forces, as `Spin.forces`."""
        nodal, moment = Nodes.zero(len(self.place.u)), as_expr(np.zeros(3))
        for at, polar, second in self.discs:
            on = [[0.0] * (len(self.place.u) - 1) for _ in range(3)]
            for j, rotation, rest, I, own, change in self._turned(at, polar, second):
                torque = I @ (z + change) + cross(own, I @ own) + cross(w, (I if self.centrifugal else rest) @ w)
                if self.coriolis:
                    torque += I @ cross(w, own) + cross(w, I @ own) + cross(own, I @ w)
                moment = moment + torque
                for k, part in enumerate(rotation.forces(torque)):
                    on[k][j] = part
            v, w_, phi = (as_expr(part) for part in on)
            nothing = 0.0 * v
            nodal = nodal.plus(at.on_nodes(Vector(nothing, nothing, nothing), Pair(v, w_), phi)[0])
        return moment, nodal

    def momentum(self) -> tuple[Any, Nodes]:
        """Return the momenta, as `Spin.momentum`."""
        return _momentum(self)

    def kinetic_energy(self, w: Any) -> Any:
        """Kinetic energy in J."""
        total = as_expr(0.0)
        for disc in self.discs:
            for _, _, _, I, own, _ in self._turned(*disc):
                total += dot(w + own, I @ (w + own)) / 2
        return total

    def element(self, j: int) -> Discs:
        """Return the sections of element j alone."""
        return replace(self, elements=(j,))


def _momentum(sections: Spin | Discs) -> tuple[Any, Nodes]:
    """Momenta of the rates of deformation: the inertia forces of these as accelerations, at rest."""
    still = replace(sections, rate=Nodes.zero(len(sections.rate.u)), acceleration=sections.rate)
    return still.forces(np.zeros(3), np.zeros(3))


def micro_inertia(rate: Any, m: Any) -> Any:
    """Return the nodal forces in N of the energy m (u_2' - u_1')^2 / 24 of every element, from u'' of the nodes.

    It is the mean of consistent and lumped inertia, less the consistent one. Frequencies of linear elements, in stretch and
    torsion, then converge with order 4 instead of 2. It depends on rates of elongation, or of torsion, alone.
    """
    force = m * (last(rate) - first(rate)) / 12
    return to_last(force) - to_first(force)


def micro_energy(rate: Any, m: Any) -> Any:
    """Return the energy of `micro_inertia` in J, from u' of the nodes."""
    apart = last(rate) - first(rate)
    return sum(m * apart * apart / 24, as_expr(0.0))
