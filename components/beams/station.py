"""Station: a section of every element, its motion and its loads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from acausal import as_expr
from components.beams.nodes import Nodes, along_nodes, first, last, to_first, to_last
from components.beams.pair import Pair
from components.beams.strain import Bend, Strain


class Vector(NamedTuple):
    """Vector of every element, resolved in the reference frame."""

    x: Any
    y: Any
    z: Any


@dataclass(frozen=True)
class Station:
    """Section of all elements at s, -1 at the first node of each and 1 at the second one.

    Parameters
    ----------
    strain : Strain
        Bending of the elements.
    s : float
        Place of the section.
    offset : Pair
        Place of the material point along y and z of the section, in m.
    """

    strain: Strain
    s: float
    offset: Pair

    @property
    def _arm(self) -> Pair:
        """Displacement of the point by phi = 1 rad, from the shear centre, in m."""
        centre, own = (Pair(*map(self._each, x)) for x in (self.strain.stiffness.shear_centre, self.offset))
        return centre.plus(own.times(-1.0)).quarter_turn()

    @property
    def rest(self) -> Vector:
        """Place of the point in the straight beam, in m."""
        x = (np.arange(self.strain.elements) + (1 + self.s) / 2) * self.strain.l
        return Vector(x, *(self._each(k) for k in self.offset))

    def _each(self, k: Any) -> Any:
        """Vector with one entry per element."""
        return as_expr([entry(k, j) for j in range(self.strain.elements)])

    def displacement(self, U: Nodes, c: Any) -> Vector:
        """Displacement of the point in m, or its rate, by nodal coordinates and bubble coefficients."""
        s, e, (slope, phi) = self.s, self.strain.bend(U), self.rotation(U)
        x = ((1 - s) * first(U.u) + (1 + s) * last(U.u)) / 2 - self.offset.dot(slope)
        mean = Pair(*((first(v) + last(v)) / 2 for v in U.across))
        turned = self.strain._shift.times((first(U.phi) + last(U.phi)) / (2 * self.strain.l))
        bent = e.d.times(s / 2).plus(e.q.times((1 - s * s) / 8)).plus(e.r.times((s - s**3) / 8))
        y, z = mean.plus(turned).plus(bent).plus(self._arm.times(phi))
        return Vector(x + (1 - s * s) / 4 * c if len(c) else x, y, z)

    def rotation(self, U: Nodes) -> tuple[Pair, Any]:
        """Slopes v' and w' of the section, and its angle phi, in rad."""
        s, l, e = self.s, self.strain.l, self.strain.bend(U)
        mean = Pair(*((first(a) + last(a)) / 2 for a in U.slopes))
        slope = mean.plus(e.q.times(-s / 2)).plus(e.r.times(3 / 4 * (1 - s * s))).times(1 / l)
        return slope, ((1 - s) * first(U.phi) + (1 + s) * last(U.phi)) / (2 * l)

    def on_nodes(self, force: Vector, turn: Pair, twist: Any) -> tuple[Nodes, Any]:
        """Forces on the nodal coordinates and bubble coefficients, of forces on the point and torques on `rotation`."""
        s, l, across = self.s, self.strain.l, Pair(force.y, force.z)
        turn = turn.plus(self.offset.times(-force.x)).times(1 / l)
        twist = (twist + self._arm.dot(across)) / l
        shifted = self.strain._shift.dot(across) / (2 * l)
        q = across.times((1 - s * s) / 8).plus(turn.times(-s / 2))
        r = across.times((s - s**3) / 8).plus(turn.times(3 / 4 * (1 - s * s)))
        v, w, dv, dw = (to_first(x / 2) + to_last(x / 2) for x in (*across, *turn))
        along = to_first((1 - s) / 2 * force.x) + to_last((1 + s) / 2 * force.x)
        phi = to_first((1 - s) / 2 * twist + shifted) + to_last((1 + s) / 2 * twist + shifted)
        own = along_nodes(along, Pair(v, w), Pair(dv, dw), phi)
        return own.plus(self.strain.on_nodes(Bend(across.times(s / 2), q, r))), (1 - s * s) / 4 * force.x


def entry(part: Any, j: int) -> Any:
    """Return the entry of element j, of a vector with an entry per element or a scalar."""
    return part[j] if as_expr(part).shape else part
