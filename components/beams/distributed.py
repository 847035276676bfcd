"""Forces of distributed loads on a beam."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from acausal import DeclarationError, as_expr, cross, dot, quantity, time
from components.beams.load import Load
from components.beams.nodes import Nodes
from components.beams.pair import Pair
from components.beams.section_rotation import SectionRotation
from components.beams.station import Station, Vector
from components.beams.stiffness import ZERO
from components.orientation import RelativeOrientation, resolve1, resolve2


class PointLoad(NamedTuple):
    """Force and torque on the section of element j at a station, resolved in the reference frame.

    Parameters
    ----------
    at : Station
        Section of every element.
    j : int
        Element.
    rotation : SectionRotation
        Rotation of the section.
    r, force, torque : Expr, shape (3,)
        Position in m, force in N and torque in N.m.
    power : Expr
        Power of both in W.
    """

    at: Station
    j: int
    rotation: SectionRotation
    r: Any
    force: Any
    torque: Any
    power: Any


def point_loads(motion: Any) -> Iterator[PointLoad]:
    """Yield the loads on a beam at their points of Gauss.

    Parameters
    ----------
    motion : BeamMotion
        Motion of the beam.
    """
    for load in motion.beam.loads:
        for s, weight, elements in load.points(motion.n):
            at = Station(motion.strain, s, ZERO)
            (U, Ud, _), (c, cd, _) = motion.coordinates, motion.bubbles
            moved = at.rest, at.displacement(U, c), at.displacement(Ud, cd), at.rotation(U), at.rotation(Ud)
            for j in elements:
                yield _at(motion, load, at, j, motion.l / 2 * weight, moved)


def _at(motion: Any, load: Load, at: Station, j: int, dx: Any, moved: tuple[Any, ...]) -> PointLoad:
    """Load on the section of element j over the length dx in m."""
    ref, (rest, displaced, moving, (slope, phi), (slope_rate, phi_rate)) = motion.beam.ref, moved
    r = as_expr([a[j] + b[j] for a, b in zip(rest, displaced, strict=True)])
    v = ref.v + cross(ref.R.w, r) + as_expr([part[j] for part in moving])
    rotation = SectionRotation(slope.y[j], slope.z[j], phi[j], motion.strain.second_order)
    turning, _ = rotation.rates(as_expr((slope_rate.y[j], slope_rate.z[j], phi_rate[j])), np.zeros(3))
    T, w = rotation.matrix(), ref.R.w + turning
    R = RelativeOrientation(T @ ref.R.T, T @ w)
    s = (j + (1 + at.s) / 2) / motion.n
    given = load.at(s, time, ref.r_0 + resolve1(ref.R, r), resolve1(ref.R, v), R)
    force, torque = (_resolved(x, unit, load, ref, T, dx) for x, unit in zip(given, ("N/m", "N"), strict=True))
    return PointLoad(at, j, rotation, r, force, torque, dot(force, v) + dot(torque, w))


def _resolved(x: Any, unit: str, load: Load, ref: Any, T: Any, dx: Any) -> Any:
    """Load over the length dx, resolved in the reference frame."""
    if x is None:
        return as_expr(np.zeros(3))
    x = as_expr(x)
    if x.shape != (3,):
        raise DeclarationError(f"force and moment of a Load are vectors of 3, not {x!r}.")
    x = x if x.unit is not None else quantity(1.0, unit) * x
    return dx * (resolve2(ref.R, x) if load.axes == "world" else T.T @ x)


def resultant(loads: Sequence[PointLoad]) -> tuple[Any, Any]:
    """Return the force in N, and the moment about the origin in N.m, resolved in the reference frame."""
    force = moment = as_expr(np.zeros(3))
    for load in loads:
        force, moment = force + load.force, moment + cross(load.r, load.force) + load.torque
    return force, moment


def on_nodes(loads: Sequence[PointLoad], elements: int) -> tuple[Nodes, Any]:
    """Return the forces of loads on the nodal coordinates and on the bubble coefficients, in N."""
    nodal, on_c = Nodes.zero(elements + 1), as_expr(np.zeros(elements))
    for load in loads:
        here = (np.arange(elements) == load.j).astype(float)
        force = Vector(*(x * here for x in load.force))
        v, w, phi = (x * here for x in load.rotation.forces(load.torque))
        own, more = load.at.on_nodes(force, Pair(v, w), phi)
        nodal, on_c = nodal.plus(own), on_c + more
    return nodal, on_c
