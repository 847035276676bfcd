"""Elastic and damping forces of a beam in space."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from acausal import as_expr
from components.beams.nodes import Nodes, first, last, to_first, to_last
from components.beams.pair import Pair, Symmetric
from components.beams.stiffness import GAUSS
from components.beams.strain import Bend, Strain


@dataclass(frozen=True)
class BendingPoint:
    """Bending of a section of every element, to the fourth order.

    The shortest turn from x to the tangent leaves the curvature v'' + v' (v' . v'') / 2, where v' and v'' have both
    components; the section is turned further by phi. With k = v'', k~ = (w'', -v'') and the stiffness K, the energy is

    V = k K k / 2 + (v' . k) (v' K k) / 2 + phi k~ K k + phi^2 (k~ K k~ - k K k) / 2.

    Parameters
    ----------
    K : Symmetric
        Stiffness over 2 l^3, in N/m: the lengths below are l v' and l^2 v''.
    slope, bent : Pair
        l v' and l^2 v'' in m.
    phi : Expr
        Angle in rad.
    l : Expr
        Length of an element in m.
    """

    K: Symmetric
    slope: Pair
    bent: Pair
    phi: Any
    l: Any

    def energy(self) -> Any:
        """Energy in J."""
        k, aside, K = self.bent, self.bent.quarter_turn(), self.K
        M, steep = K.times(k), self.slope.dot(k) * self.slope.dot(K.times(k)) / (2 * self.l * self.l)
        turned = self.phi * M.dot(aside) + self.phi * self.phi / 2 * (K.times(aside).dot(aside) - M.dot(k))
        return M.dot(k) / 2 + steep + turned

    def forces(self) -> tuple[Pair, Pair, Any]:
        """Forces on l v' and l^2 v'' in N, and the torque on phi in N.m."""
        k, aside, K, phi = self.bent, self.bent.quarter_turn(), self.K, self.phi
        M, across = K.times(k), K.times(aside)
        steep, on_steep = self.slope.dot(k) / (2 * self.l * self.l), self.slope.dot(M) / (2 * self.l * self.l)
        on_bent = M.plus(self.slope.times(on_steep)).plus(K.times(self.slope).times(steep))
        turned = across.plus(M.quarter_turn().times(-1.0)).plus(across.quarter_turn().plus(M).times(-phi))
        on_phi = M.dot(aside) + phi * (across.dot(aside) - M.dot(k))
        return k.times(on_steep).plus(M.times(steep)), on_bent.plus(turned.times(phi)), on_phi


@dataclass(frozen=True)
class Elasticity:
    """Elastic forces of N elements, with damping proportional to the stiffness.

    The axial force and the torque are constant in an element. With second order the bending moments are integrated at
    both points of Gauss, and the torsion includes the mean of (v'' w' - v' w'') / 2.

    Parameters
    ----------
    strain : Strain
        Bending and extension of the elements.
    beta : Expr or float
        Damping in s, of the rates of the linear strains and of the extension.
    twists : bool
        Whether the sections turn about the axis.
    """

    strain: Strain
    beta: Any
    twists: bool

    def tensions(self, U: Nodes, Ud: Nodes) -> Any:
        """Axial force of each element from its extension, in N."""
        extension, rate = self.strain.extension(U, Ud)
        return self.strain.stiffness.EA / self.strain.l * (extension + self.beta * rate)

    def forces(self, U: Nodes, Ud: Nodes, N: Any) -> Nodes:
        """Nodal forces of the axial forces N, of bending and of torsion, in N, conjugate to U."""
        strain, l = self.strain, self.strain.l
        e, ed = strain.bend(U), strain.bend(Ud)
        on = strain.pull(e, N).plus(self._linear(e, ed))
        at_first = at_last = 0.0 * N
        if self.twists:
            elastic = strain.stiffness.GJ_t / l * self._torsion(U, e)
            torque = elastic + strain.stiffness.GJ_t / l * self.beta * strain.twist(Ud)
            at_first, at_last = at_first - torque, at_last + torque
            if strain.second_order:
                half = elastic / (2 * l * l)
                turn = e.q.quarter_turn().times(half)
                across = e.d.plus(e.r.times(1 / 2)).quarter_turn()
                on = on.plus(Bend(turn, across.times(-half), turn.times(1 / 2)))
        for s, point in self._points(U, e):
            on_slope, on_bent, on_phi = point.forces()
            on = on.plus(Bend(on_slope, on_slope.times(-s / 2).plus(on_bent.times(-1.0)), on_bent.times(-3 * s)))
            if self.twists:
                at_first, at_last = at_first + (1 - s) / 2 * on_phi, at_last + (1 + s) / 2 * on_phi
        turned = to_first(at_first / l) + to_last(at_last / l)
        total = strain.on_nodes(on)
        return total._replace(u=to_last(N) - to_first(N), phi=total.phi + turned)

    def _linear(self, e: Bend, ed: Bend) -> Bend:
        """Forces of linear bending and of shear; with second order, of shear and damping alone."""
        own, l, beta = self.strain.stiffness, self.strain.l, self.beta
        q, r = (a.plus(b.times(beta)) for a, b in ((e.q, ed.q), (e.r, ed.r)))
        sheared = r.scaled(own.shear)
        if self.strain.second_order:
            q, r = ed.q.times(beta), ed.r.times(beta)
        k = 1 / (l * l * l)
        mean, slant = own.mean, own.slant
        on_r = slant.times(q).plus(mean.times(r).times(3)).plus(sheared)
        return Bend(q.times(0.0), mean.times(q).plus(slant.times(r)).times(k), on_r.times(k))

    def _points(self, U: Nodes, e: Bend) -> Iterator[tuple[float, BendingPoint]]:
        """Yield s and the bending at both points of Gauss, with second order."""
        l, bending = self.strain.l, self.strain.stiffness.bending
        a, b = first(U.phi) / l, last(U.phi) / l
        for s, K in zip(GAUSS, bending, strict=True) if self.strain.second_order else ():
            slope, bent = e.d.plus(e.q.times(-s / 2)), e.q.times(-1.0).plus(e.r.times(-3 * s))
            weighted = Symmetric(*(x / (2 * l * l * l) for x in K))
            yield s, BendingPoint(weighted, slope, bent, ((1 - s) * a + (1 + s) * b) / 2, l)

    def _torsion(self, U: Nodes, e: Bend) -> Any:
        """Angle of torsion of the elements in rad."""
        twist, l = self.strain.twist(U), self.strain.l
        if not self.strain.second_order:
            return twist
        return twist + e.d.plus(e.r.times(1 / 2)).dot(e.q.quarter_turn()) / (2 * l * l)

    def energy(self, U: Nodes, stretches: bool) -> Any:
        """Strain energy in J; that of stretch only if `stretches`."""
        own, l, e = self.strain.stiffness, self.strain.l, self.strain.bend(U)
        total = e.r.scaled(own.shear).dot(e.r) / (2 * l * l * l)
        if not self.strain.second_order:
            total = total + self._work(e)
        for _, point in self._points(U, e):
            total = total + point.energy()
        if self.twists:
            total = total + own.GJ_t / l * self._torsion(U, e) * self._torsion(U, e) / 2
        if stretches:
            extension, _ = self.strain.extension(U, U)
            total = total + own.EA / l * extension * extension / 2
        return sum(total, as_expr(0.0))

    def _work(self, e: Bend) -> Any:
        """Energy of linear bending of the elements in J."""
        own, l = self.strain.stiffness, self.strain.l
        mean, slant = own.mean, own.slant
        on_q = mean.times(e.q).plus(slant.times(e.r).times(2))
        return (on_q.dot(e.q) + 3 * mean.times(e.r).dot(e.r)) / (2 * l * l * l)

    def dissipated(self, U: Nodes, Ud: Nodes, stretches: bool) -> Any:
        """Power of the stiffness-proportional damping, in W."""
        own, l, ed = self.strain.stiffness, self.strain.l, self.strain.bend(Ud)
        total = 2 * self._work(ed) + ed.r.scaled(own.shear).dot(ed.r) / (l * l * l)
        if self.twists:
            total = total + own.GJ_t / l * self.strain.twist(Ud) * self.strain.twist(Ud)
        if stretches:
            _, rate = self.strain.extension(U, Ud)
            total = total + own.EA / l * rate * rate
        return self.beta * sum(total, as_expr(0.0))
