"""Bending and torsion by the forces that the frames of a beam neglect."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from acausal import as_expr
from components.beams.beam_chain import BeamChain, mapped
from components.beams.pair import Pair, Symmetric, inverse
from components.beams.quadrature import GAUSS
from components.beams.section_rotation import SectionRotation
from components.beams.strain import Bend


class Errors(NamedTuple):
    """Bending of the elements in m by neglected effects: of axial forces, of slopes, and of twist."""

    axial: Bend
    slope: Bend
    twist: Bend


def errors(chain: BeamChain) -> Errors:
    """Return the bending by the first terms that the frames neglect.

    Parameters
    ----------
    chain : BeamChain
        Elements of the beam.
    """
    e, N, l, second_order = chain.shape, chain.tension, chain.l, chain.beam.geometric_stiffness
    zero = e.d.times(0.0)
    axial, slope = Bend(zero, zero, zero), Bend(zero, zero, zero)
    for s, K, at, bent in _points(chain):
        square, M = at.dot(at) / (l * l), K.times(bent)
        along, steep = at.dot(bent) / (2 * l * l), at.dot(M) / (2 * l * l)
        on_at, on_bent = bent.times(steep).plus(M.times(along)), at.times(steep).plus(K.times(at).times(along))
        if second_order:
            both = at.dot(bent) * at.dot(M) / (l * l * l * l)
            on_at, on_bent = on_at.times(square).plus(at.times(both)), on_bent.times(square)
            axial = axial.plus(_at(s, at.times(3 * N / (16 * l) * square * square), zero))
        slope = slope.plus(_at(s, on_at, on_bent))
    if not second_order:
        axial = Bend(e.d.times(N / l), e.q.times(N / (12 * l)), e.r.times(N / (20 * l)))
    still = [Pair(*[as_expr(np.zeros(len(chain.frames)))] * 2)] * 2
    ends = [_end_torques(chain, k) for k in (0, 1)]
    twist = Bend(zero, zero, zero)
    if chain.beam.torsion and not second_order:
        twist = _bent(chain, _twisted(chain), still)
    return Errors(_bent(chain, axial, still), _bent(chain, slope, ends), twist)


def _points(chain: BeamChain) -> Any:
    """Yield s, weighted stiffness, l v' and l^2 v'' at both points of Gauss."""
    e, l = chain.shape, chain.l
    K = Symmetric(*(x / (2 * l * l * l) for x in chain.stiffness))
    for s in GAUSS:
        yield s, K, e.d.plus(e.q.times(-s / 2)), e.q.times(-1.0).plus(e.r.times(-3 * s))


def _at(s: float, on_slope: Pair, on_bent: Pair) -> Bend:
    """Generalised forces on the modes equivalent to forces on l v' and l^2 v'' at s."""
    return Bend(on_slope, on_slope.times(-s / 2).plus(on_bent.times(-1.0)), on_bent.times(-3 * s))


def _twisted(chain: BeamChain) -> Bend:
    """Forces of the moments that turn with the sections, in N, with the twist that they cause themselves.

    The torque of the moments on phi is k~ K k per length. The torsion is phi' + k~ . s / 2, so that bending in both planes
    twists the sections as well.
    """
    e, l, n = chain.shape, chain.l, chain.n
    first, last = chain.phi(False), chain.phi(True)
    torque = chain.torsional / l * (last - first)
    lean = e.d.plus(e.r.times(1 / 2)).dot(e.q.quarter_turn()) / (2 * l * l)
    on_first, on_last = 0.0 * lean, 0.0 * lean
    for s, K, _, bent in _points(chain):
        on = K.times(bent).dot(bent.quarter_turn())
        on_first, on_last = on_first + (1 - s) / 2 * on, on_last + (1 + s) / 2 * on
    # The torque in an element balances those on the nodes beyond it, in its frame.
    beyond = np.kron(np.eye(len(chain.frames)), np.triu(np.ones((n, n)), 1))
    turned = -l * inverse(chain.torsional) * (mapped(beyond, on_first + on_last) + on_last) - lean
    within = np.kron(np.eye(len(chain.frames)), np.tril(np.ones((n, n)), -1))
    start = mapped(within, turned)
    if chain.beam.reference == "pinned":  # the chord turns with the mean of both ends
        start = start - mapped(np.kron(np.eye(len(chain.frames)), np.ones((n, n)) / 2), turned)
    half = torque / (2 * l * l)
    turn = e.q.quarter_turn().times(half)
    forces = Bend(turn, e.d.plus(e.r.times(1 / 2)).quarter_turn().times(-half), turn.times(1 / 2))
    for s, K, _, bent in _points(chain):
        phi = ((1 - s) * (first + start) + (1 + s) * (last + start + turned)) / 2
        on_bent = K.times(bent.quarter_turn()).plus(K.times(bent).quarter_turn().times(-1.0)).times(phi)
        forces = forces.plus(_at(s, on_bent.times(0.0), on_bent))
    return forces


def _end_torques(chain: BeamChain, which: int) -> Pair:
    """Neglected forces of end moments on the nodal coordinates l v' and l w' at roots or tips of the frames."""
    found = []
    node, _, ports = chain.ends[which]
    for motion, port in zip(chain.motions, ports, strict=True):
        own = motion.rotation(node)
        t = own.matrix().T @ port.t
        if chain.beam.geometric_stiffness:
            square = own.v * own.v + own.w * own.w
            neglected = [3 / 8 * square * square * x for x in (t[2], -t[1])]
        else:
            further = SectionRotation(own.v, own.w, own.phi, second_order=True).forces(t)
            neglected = [a - b for a, b in zip(further, own.forces(t), strict=True)]
        found.append([-as_expr((x / motion.l).sx) for x in neglected[:2]])
    return Pair(*(as_expr(list(column)) for column in zip(*found, strict=True)))


def _bent(chain: BeamChain, forces: Bend, ends: list[Pair]) -> Bend:
    """Bending by generalised forces on the elements, and at roots and tips of the frames."""
    n, each, ones = chain.n, np.eye(len(chain.frames)), np.ones(chain.n)
    at_q, at_r = [], []
    for d, q, r, at_root, at_tip in zip(*forces, *ends, strict=True):
        across = d
        if chain.beam.reference == "pinned":  # the chord rotates freely
            across = (
                across - mapped(np.kron(each, np.ones((n, n)) / n), across) - chain.spread(ones / n, at_root + at_tip)
            )
        # d = r / 2 + mean slope of both nodes, and the slope of a node is that of the root minus q of all elements before.
        beyond = np.kron(each, np.triu(np.ones((n, n)), 1) + np.eye(n) / 2)
        at_q.append(q - mapped(beyond, across) - chain.spread(ones, at_tip))
        at_r.append(r + across / 2)
    l, K = chain.l, chain.stiffness
    det = K.yy * K.zz - K.yz * K.yz
    soft = Symmetric(*(l * l * l * x * inverse(det) for x in (K.zz, -K.yz, K.yy)))
    bent = soft.times(Pair(*at_q))
    return Bend(bent.times(0.0), bent, soft.times(Pair(*at_r)).times(1 / 3))
