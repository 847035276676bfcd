"""Deflections that a beam would have where its effects leave it rigid."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from acausal import Expr, as_expr, expect
from components.beams.beam_chain import BeamChain, total
from components.beams.pair import inverse

SIDE = 1e-3  # deflection over length, or twist in rad: a third of length / 300, the usual limit in structures


def rigid_range(chain: BeamChain) -> Iterator[Any]:
    """Expect small bending and torsion where the effects of the beam exclude them.

    The moment M in a frame of length L is the cubic with the moments and transverse forces V at both ends, exact for
    linearly distributed inertia forces. With M = EJ theta', the relative rotation of the ends is

        theta = (L (M_a + M_b) / 2 + L^2 (V_a - V_b) / 12) / EJ

    and the distance of frame_b from the tangent at frame_a is

        w = (L^2 (7 M_a + 3 M_b) / 20 + L^3 (3 V_a - 2 V_b) / 60) / EJ.

    Parameters
    ----------
    chain : BeamChain
        Elements of the beam.
    """
    beam, (a, b) = chain.beam, _end_loads(chain)
    for plane, k, excluded, M, V, sign in (("xy", "yy", "xz", 5, 1, -1), ("xz", "zz", "xy", 4, 2, 1)):
        if beam.bending in (excluded, "none"):
            EJ = getattr(chain.stiffness, k)
            side = _aside(chain, EJ, (sign * a[M], a[V]), (sign * b[M], b[V]))
            text = (
                f"bending in {plane} is left out, where the loads would bend the beam by more than 1/1000 of its length; use "
                'bending="both"'
            )
            yield expect(side, Expr(beam.length.sx), SIDE, text)
    if not beam.torsion:
        text = "torsion is left out, but the loads would twist the beam by more than 1/1000 rad; use torsion=True"
        n = len(chain.frames)
        stiff = as_expr([chain.torsional[k * chain.n] for k in range(n)])
        yield expect(beam.length.sx * total((a[3] + b[3]) * inverse(stiff)) / (2 * n), 1.0, SIDE, text)


def _end_loads(chain: BeamChain) -> list[list[Any]]:
    """Force and torque at roots and tips of the frames on the part beyond, in the axes of the frames: six vectors each."""
    found = []
    for node, sign, ports in chain.ends:
        turns = [motion.rotation(node).matrix().T * sign for motion in chain.motions]
        loads = [[T @ x for T, x in zip(turns, (getattr(p, name) for p in ports), strict=True)] for name in ("f", "t")]
        found.append([as_expr([Expr(x[k].sx) for x in load]) for load in loads for k in range(3)])
    return found


def _aside(chain: BeamChain, EJ: Any, at_a: tuple[Any, Any], at_b: tuple[Any, Any]) -> Any:
    """Deflection of the beam in a plane in m, from moments and forces at roots and tips."""
    n = len(chain.frames)
    l = chain.l * chain.n
    soft = inverse(as_expr([EJ[k * chain.n] for k in range(n)]))
    (M_a, V_a), (M_b, V_b) = at_a, at_b
    turns = (l / 2 * (M_a + M_b) + l * l / 12 * (V_a - V_b)) * soft
    aside = (l * l / 20 * (7 * M_a + 3 * M_b) + l * l * l / 60 * (3 * V_a - 2 * V_b)) * soft
    beyond = np.arange(n)[::-1]  # number of volumes beyond each
    from_a = abs(total(aside) + l * total(beyond * turns))
    from_b = abs(total(aside) + l * total(beyond * turns) - n * l * total(turns))
    return (from_a + from_b + abs(from_a - from_b)) / 2
