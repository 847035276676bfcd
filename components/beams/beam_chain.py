"""Elements of all frames of a beam in series."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from itertools import accumulate
from typing import Any

import numpy as np

from acausal import Expr, as_expr, sqrt
from components.beams.beam_motion import BeamMotion
from components.beams.pair import Pair, Symmetric
from components.beams.strain import Bend

HINGE = 0.1  # end moment over mean bending moment: well below it the end counts as a hinge


class BeamChain:
    """Elements of all frames of a beam in series: vectors have one entry per element, without units.

    Parameters
    ----------
    beam : Beam
        The whole beam.
    frames : list of FlexibleBeam
        Its flexible beams, from frame_a to frame_b.
    """

    def __init__(self, beam: Any, frames: list[Any]) -> None:
        self.beam, self.frames = beam, frames
        self.motions = [BeamMotion(frame) for frame in frames]
        self.n, self.l = frames[0]._elements, as_expr(self.motions[0].l.sx)
        self.count = self.n * len(frames)

    def joined(self, parts: Iterable[Any]) -> Any:
        """Vector of the values of all frames, each a vector or a scalar for all its elements."""
        found = [list(part) if as_expr(part).shape else [part] * self.n for part in parts]
        return as_expr([Expr(entry.sx) for part in found for entry in map(as_expr, part)])

    def pairs(self, parts: Iterable[Pair]) -> Pair:
        """Pair of the values of all frames."""
        parts = list(parts)
        return Pair(self.joined(p.y for p in parts), self.joined(p.z for p in parts))

    @cached_property
    def stiffness(self) -> Symmetric:
        """Mean bending stiffness of the elements in N.m2."""
        means = [motion.strain.stiffness.mean for motion in self.motions]
        return Symmetric(*(self.joined(getattr(m, name) for m in means) for name in ("yy", "yz", "zz")))

    @cached_property
    def torsional(self) -> Any:
        """Torsional stiffness of the elements in N.m2."""
        return self.joined(motion.strain.stiffness.GJ_t for motion in self.motions)

    @cached_property
    def mass(self) -> Any:
        """Mass of the elements in kg."""
        return self.joined(motion.inertia.mass * np.ones(self.n) / self.n for motion in self.motions)

    @cached_property
    def shape(self) -> Bend:
        """Bending of the elements in m."""
        bends = [motion.strain.bend(motion.coordinates[0]) for motion in self.motions]
        return Bend(*(self.pairs(getattr(b, mode) for b in bends) for mode in ("d", "q", "r")))

    def phi(self, last: bool) -> Any:
        """Angles phi of the first or last nodes of the elements, in rad."""
        return self.joined(
            m.coordinates[0].phi[1 if last else 0 : m.n + 1 if last else m.n] / m.l for m in self.motions
        )

    @property
    def ends(self) -> list[tuple[int, Any, list[Any]]]:
        """Node, sign of the load on the part beyond, and ports of roots and tips of all frames."""
        return [(0, -1, [f.frame_a for f in self.frames]), (-1, 1, [f.frame_b for f in self.frames])]

    @cached_property
    def tension(self) -> Any:
        """Axial forces in N: linear between the ends of a frame, plus a parabola by its rotation."""
        along = [
            [(motion.rotation(node).matrix().T @ port.f)[0] for motion, port in zip(self.motions, ports, strict=True)]
            for node, _, ports in self.ends
        ]
        x, L = (np.arange(self.n) + 0.5) / self.n, self.n * self.l
        found = []
        for motion, root, tip in zip(self.motions, *along, strict=True):
            w, mass = motion.beam.ref.R.w, motion.inertia.mass
            hung = mass * L / 2 * (w[1] * w[1] + w[2] * w[2])
            found.append((1 - x) * -root + x * tip + x * (1 - x) * hung)
        return self.joined(found)

    def spread(self, weights: np.ndarray, values: Any) -> Any:
        """Distribute the value of each frame to its elements by weights."""
        return mapped(np.kron(np.eye(len(self.frames)), weights[:, None]), values)

    def work(self, e: Bend) -> Any:
        """Work of the bending moments in a shape, in N.m."""
        q, r = self.stiffness.times(e.q).dot(e.q), self.stiffness.times(e.r).dot(e.r)
        return total((q + 3 * r) / (self.l * self.l * self.l))

    @cached_property
    def hinged(self) -> tuple[Pair, Pair]:
        """Degree to which each end is a hinge in xy and xz, 0 to 1: a clamping moment has the size of those in the beam."""
        moment = (
            self.work(self.shape) * total(self.stiffness.yy + self.stiffness.zz) / (2 * self.count * self.beam.length)
        )
        squares = [[p.t[k] * p.t[k] / (HINGE * HINGE) for k in (2, 1)] for p in (self.beam.frame_a, self.beam.frame_b)]
        moment = as_expr(moment.sx)
        a, b = (Pair(*(moment / (moment + as_expr(t.sx)) for t in own)) for own in squares)
        return a, b

    def heights(self, e: Bend) -> Pair:
        """Heights of all nodes in m above the chord, or the tangent at the root, or at the tip if only the tip is clamped."""
        k, ends = np.arange(self.count + 1), self.hinged
        found = []
        for q, r, at_a, at_b in zip(e.q, e.r, *ends, strict=True):
            y = cumulative((r - q) / 2 - cumulative(q)[:-1])
            if self.beam.reference == "pinned":
                found.append(y - k / self.count * y[self.count])
                continue
            turned = at_a * (1 - at_b)
            found.append(y - turned * (np.ones(k.size) * y[self.count] - (k - self.count) * total(q)))
        return Pair(*found)

    def deflection(self, e: Bend) -> Any:
        """Maximum height of a node in m, approximated by the smooth 8-norm."""
        heights = self.heights(e)
        squares = heights.dot(heights)
        squares = squares * squares
        return sqrt(sqrt(sqrt(total(squares * squares))))

    def amplification(self, e: Bend) -> Any:
        """Amplification of the bending of a rotating beam, relative to its bending stiffness alone: B / (B - C + H).

        B is the work of bending in the shape, C that of the transverse centrifugal forces, int w~ w~ r . r of the heights,
        and H that of axial forces on the slopes included in the frames.
        """
        w, k = self.frames[0].ref.R.w, np.arange(self.count + 1)
        heights = [
            # A beam between two hinges rotates until the transverse forces have no moment.
            y - k * (a * b * total(k / np.sum(k * k) * y))
            for y, a, b in zip(self.heights(e), *self.hinged, strict=True)
        ]
        ends = [(y[:-1], y[1:]) for y in heights]
        (yy, zz), held = (total(self.mass / 3 * (a * a + a * b + b * b)) for a, b in ends), 0
        (a, b), (c, d) = ends
        yz = total(self.mass / 6 * (2 * (a * c + b * d) + a * d + b * c))
        away = (w[0] * w[0] + w[2] * w[2]) * yy + (w[0] * w[0] + w[1] * w[1]) * zz - 2 * w[1] * w[2] * yz
        stiff, away = self.work(e), as_expr(away.sx)
        if len(self.frames) == 1 and not self.beam.geometric_stiffness:
            return stiff / (stiff - away)
        held = sum(total(self.tension * (b - a) * (b - a)) for a, b in ends) / self.l
        return stiff / (stiff - away + held)


def mapped(M: np.ndarray, x: Any) -> Any:
    """Numerical matrix times a vector, without units."""
    return Expr(as_expr(M).sx @ x.sx, shape=(len(M),))


def cumulative(x: Any) -> Any:
    """Cumulative sums, starting with 0: one entry more than x."""
    return as_expr([as_expr(0), *(Expr(entry) for entry in accumulate(x.sx.elements()))])


def total(x: Any) -> Any:
    """Sum of all entries, without units."""
    return mapped(np.ones((1, len(x))), x)[0]
