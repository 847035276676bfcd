"""Elastic and damping forces of a beam in space."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import sqrt
from typing import Any

from acausal import as_expr
from components.beams.nodes import Nodes, first, last, to_first, to_last
from components.beams.pair import Pair, Symmetric
from components.beams.strain import Bend, Strain


@dataclass(frozen=True)
class SteepBending:
    """Energy of bending at a section of every element beyond the square of the curvature, to the fourth order.

    The shortest turn from x to the tangent leaves the curvature v'' + v' (v' . v'') / 2, where v' and v'' have both
    components; the section is turned further by phi. With k = v'', k~ = (w'', -v'') and the stiffness K, the energy is

    V = (v' . k) (v' K k) / 2 + phi k~ K k + phi^2 (k~ K k~ - k K k) / 2.

    Parameters
    ----------
    K : Symmetric
        Stiffness over 2 l^3 in N/m: the lengths below are l v' and l^2 v''.
    slope, bent : Pair
        l v' and -l^2 v'' in m.
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
        K, k, phi = self.K, self.bent, self.phi
        M, aside = K.times(k), k.quarter_turn()
        turned = phi * M.dot(aside) + phi * phi / 2 * (K.times(aside).dot(aside) - M.dot(k))
        return self.slope.dot(k) * self.slope.dot(M) / (2 * self.l * self.l) + turned

    def forces(self) -> tuple[Pair, Pair, Any]:
        """Forces on `slope` and on `bent` in N, and the torque on phi in N.m."""
        K, (A, B), (k, m), phi = self.K, self.slope, self.bent, self.phi
        # V = (y + z) (K_yy y + K_zz z + K_yz x) / (2 l^2) + phi (D p + K_yz d) + phi^2 (D d - 4 K_yz p) / 2
        y, z, x, p, d, D = A * k, B * m, A * m + B * k, k * m, m * m - k * k, K.yy - K.zz
        K_yy, cross, K_zz = K.yy / (self.l * self.l), K.yz / (2 * self.l * self.l), K.zz / (self.l * self.l)
        both = (K_yy + K_zz) / 2
        on_y, on_z = K_yy * y + both * z + cross * x, both * y + K_zz * z + cross * x
        on_x = cross * (y + z)
        on_p, on_d = phi * D - 2 * phi * phi * K.yz, phi * K.yz + phi * phi / 2 * D
        on_slope = Pair(on_y * k + on_x * m, on_z * m + on_x * k)
        turned = Pair(on_p * m - 2 * on_d * k, on_p * k + 2 * on_d * m)
        on_bent = Pair(on_y * A + on_x * B, on_z * B + on_x * A).plus(turned)
        return on_slope, on_bent, D * p + K.yz * d + phi * (D * d - 4 * K.yz * p)


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
        if strain.second_order:
            (slope, bent, phi), (slope_2, bent_2, phi_2) = (point.forces() for point in self._points(U, e))
            aside = slope.plus(slope_2.times(-1.0)).times(1 / sqrt(12))
            on_r = bent_2.plus(bent.times(-1.0)).times(sqrt(3))
            on = on.plus(Bend(slope.plus(slope_2), aside.plus(bent).plus(bent_2), on_r))
            if self.twists:
                near, far = (1 + 1 / sqrt(3)) / 2, (1 - 1 / sqrt(3)) / 2
                at_first, at_last = at_first + near * phi + far * phi_2, at_last + far * phi + near * phi_2
        turned = to_first(at_first / l) + to_last(at_last / l)
        total = strain.on_nodes(on)
        return total._replace(u=to_last(N) - to_first(N), phi=total.phi + turned)

    def _linear(self, e: Bend, ed: Bend) -> Bend:
        """Forces of linear bending and of shear."""
        own, l, beta = self.strain.stiffness, self.strain.l, self.beta
        q, r = (a.plus(b.times(beta)) for a, b in ((e.q, ed.q), (e.r, ed.r)))
        mean, slant = (Symmetric(*(x / (l * l * l) for x in K)) for K in (own.mean, own.slant))
        thrice = Symmetric(*(3 * x for x in mean))
        on_r = slant.times(q).plus(thrice.times(r)).plus(r.scaled(own.shear.times(1 / (l * l * l))))
        return Bend(q.times(0.0), mean.times(q).plus(slant.times(r)), on_r)

    def _points(self, U: Nodes, e: Bend) -> Iterator[SteepBending]:
        """Yield the bending at both points of Gauss, s = -1 / sqrt(3) and 1 / sqrt(3)."""
        l, q, r = self.strain.l, e.q.times(1 / sqrt(12)), e.r.times(sqrt(3))
        mean, half = (first(U.phi) + last(U.phi)) / (2 * l), (last(U.phi) - first(U.phi)) / (sqrt(12) * l)
        for sign, K in zip((-1.0, 1.0), self.strain.stiffness.bending, strict=True):
            weighted = Symmetric(*(x / (2 * l * l * l) for x in K))
            slope, bent = e.d.plus(q.times(-sign)), e.q.plus(r.times(sign))
            yield SteepBending(weighted, slope, bent, mean + sign * half, l)

    def _torsion(self, U: Nodes, e: Bend) -> Any:
        """Angle of torsion of the elements in rad."""
        twist, l = self.strain.twist(U), self.strain.l
        if not self.strain.second_order:
            return twist
        return twist + e.d.plus(e.r.times(1 / 2)).dot(e.q.quarter_turn()) / (2 * l * l)

    def energy(self, U: Nodes, stretches: bool) -> Any:
        """Strain energy in J; that of stretch only if `stretches`."""
        own, l, e = self.strain.stiffness, self.strain.l, self.strain.bend(U)
        total = self._work(e) + e.r.scaled(own.shear).dot(e.r) / (2 * l * l * l)
        for point in self._points(U, e) if self.strain.second_order else ():
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
