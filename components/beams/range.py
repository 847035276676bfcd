"""Range of validity of beam models: neglected forces of the frames, compared with the deflection.

The energy of an inextensible beam whose axis has the slope v' = sin(phi) at arc length x, with the axial force N, is

    V = int EJ v''^2 (1 + v'^2 + v'^4 + ...) / 2 + N (v'^2 / 2 + v'^4 / 8 + v'^6 / 16 + ...) dx,

and end moments work on phi = v' + v'^3 / 6 + 3 v'^5 / 40 + ... A linear frame includes EJ v''^2 / 2 only, a second-order
frame all terms up to the fourth power of v. The derivatives g of the first neglected terms are the neglected forces. They
bend a frame with the bending stiffness K by K^-1 g, which is the first-order error for any boundary conditions, because
whole frames are balanced in their deflected shapes. Two limitations: the loads must vary slowly compared with the first
natural frequency, and the phase error of free vibrations grows with time.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from math import sqrt as root
from typing import Any

import numpy as np

from acausal import Expr, as_expr, cos, expect, sin, sqrt
from components.beams.strain import Bend, gauss

SHARE = 0.01  # error over deflection that gives a warning
SIDE = (
    1e-3  # out-of-plane deflection over length, or twist in rad: a third of length / 300, the usual limit in structures
)
E_OVER_G = 2.6  # E / G = 2 (1 + nu) for Poisson's ratio nu = 0.3
SMALLEST = 2e-4  # deflection over length: errors of much smaller deflections are not reported
HINGE = 0.1  # end moment over mean bending moment: well below it the end counts as a hinge


def beam_range(beam: Any, frames: list[Any]) -> Iterator[Any]:
    """Expect small errors of a beam made of the flexible beams `frames`.

    Parameters
    ----------
    beam : Beam
        The whole beam.
    frames : list of FlexibleBeam
        Its flexible beams, from frame_a to frame_b.
    """
    chain = _Chain(beam, frames)
    yield from _out_of_plane(chain)
    shape, by_axial, by_slope = chain.shape, *chain.errors()
    error = Bend(*(a + s for a, s in zip(by_axial, by_slope, strict=True)))
    size, whole = chain.deflection(error) * chain.amplification(error), chain.deflection(shape)
    whole = sqrt(whole * whole + (SMALLEST * beam.length) * (SMALLEST * beam.length))
    more = "more volumes" if len(frames) > 1 else "SubstructuredBeam(volumes=...)"
    if beam.geometric_stiffness:
        text = (
            f"the slope is too large for second-order frames: the error is not small against the deflection; use {more}"
        )
        yield expect(size, whole, SHARE, text)
        return
    # Report the larger of the two errors, which may cancel each other.
    ahead = chain.deflection(by_axial) - chain.deflection(by_slope)
    side = ahead / sqrt(ahead * ahead)
    text = (
        "linear frames neglect the effect of the axial force on bending (rotation and tension stiffen, compression softens): "
        f"the error is not small against the deflection; use geometric_stiffness=True or {more}"
    )
    yield expect(size * (1 + side) / 2, whole, SHARE, text)
    text = (
        "the slope is too large for linear frames: the error is not small against the deflection; use "
        f"geometric_stiffness=True and, beyond 20 degrees, {more}"
    )
    yield expect(size * (1 - side) / 2, whole, SHARE, text)


def _out_of_plane(chain: _Chain) -> Iterator[Any]:
    """Expect small out-of-plane bending and torsion, which the beam model excludes.

    The moment M about y in a frame of length L is the cubic with the moments and out-of-plane forces V at both ends, exact for
    linearly distributed inertia forces. With M = EJ_y theta', the relative rotation of the ends is

        theta = (L (M_a + M_b) / 2 + L^2 (V_a - V_b) / 12) / EJ_y

    and the distance of frame_b from the tangent at frame_a is

        w = (L^2 (7 M_a + 3 M_b) / 20 + L^3 (3 V_a - 2 V_b) / 60) / EJ_y.

    The torsion constant is at most the polar moment J + J_y (Saint-Venant), so the twist angle below is a lower bound.
    """
    beam, n = chain.beam, len(chain.frames)
    l = beam.length / n
    J_y = beam.J if as_expr(beam.J_y).sx.is_zero() else beam.J_y
    (M_a, T_a, V_a), (M_b, T_b, V_b) = chain.side_loads()
    turns = (l / 2 * (M_a + M_b) + l * l / 12 * (V_a - V_b)) / (beam.E * J_y)
    aside = (l * l / 20 * (7 * M_a + 3 * M_b) + l * l * l / 60 * (3 * V_a - 2 * V_b)) / (beam.E * J_y)
    beyond = np.arange(n)[::-1]  # number of volumes beyond each
    from_a = abs(_total(aside) + l * _total(beyond * turns))
    from_b = abs(_total(aside) + l * _total(beyond * turns) - beam.length * _total(turns))
    text = (
        "the model is rigid out of its xy plane, where the loads would bend the beam by more than 1/1000 of its length; align "
        "the xy plane with the loads, or use an FEBody"
    )
    yield expect((from_a + from_b + abs(from_a - from_b)) / 2, Expr(beam.length.sx), SIDE, text)
    text = "the model is rigid in torsion, but the loads would twist the beam by more than 1/1000 rad; use an FEBody"
    yield expect(E_OVER_G * l / 2 * _total(T_a + T_b) / (beam.E * (beam.J + J_y)), 1.0, SIDE, text)


@dataclass
class _Chain:
    """Elements of all frames of a beam in series: vectors with one entry per element."""

    beam: Any
    frames: list[Any]

    def __post_init__(self) -> None:
        self.n, self.l = self.frames[0].elements, self.frames[0]._l
        self.count = self.n * len(self.frames)
        self.EJ = self.beam.E * self.beam.J
        self.nodes = [_across(frame) for frame in self.frames]
        roots, tips = (_joined([turns[k]] for _, turns in self.nodes) for k in (0, -1))
        self.ends = (roots, [f.frame_a for f in self.frames]), (tips, [f.frame_b for f in self.frames])
        self.tension = self._tension()
        # Degree to which each end is a hinge, 0 to 1: a clamping moment has the size of the moments in the beam.
        moment = self._stiffness(self.shape) * self.EJ / self.beam.length
        loads = (as_expr(port.t[2].sx) / HINGE for port in (self.beam.frame_a, self.beam.frame_b))
        self.hinged = tuple(moment / (moment + t * t) for t in loads)

    def _stiffness(self, e: Bend) -> Any:
        """Work of the bending forces in a given shape, in N.m."""
        return self.EJ / self.l**3 * _total(e.q * e.q + 3 * e.r * e.r)

    def side_loads(self) -> Iterator[tuple[Any, Any, Any]]:
        """Moment about y, torque about x and force along z at roots and tips of the frames, in section axes."""
        for sign, (turns, ports) in zip((-1, 1), self.ends, strict=True):
            phi = self.frames[0]._strain.angle(turns)
            t_x, t_y, f_z = (
                _joined(parts) for parts in zip(*(([p.t[0]], [p.t[1]], [p.f[2]]) for p in ports), strict=True)
            )
            yield sign * (sin(phi) * t_x + cos(phi) * t_y), sign * (cos(phi) * t_x - sin(phi) * t_y), sign * f_z

    def _tension(self) -> Any:
        """Axial forces in N: linear between the ends of a frame, plus a parabola by its rotation."""
        along = []
        for turns, ports in self.ends:
            phi = self.frames[0]._strain.angle(turns)
            along.append(cos(phi) * _joined([p.f[0]] for p in ports) - sin(phi) * _joined([p.f[1]] for p in ports))
        w_y, w_z = (_joined([frame.ref.R.w[k]] for frame in self.frames) for k in (1, 2))
        hung = self.beam.rho * self.beam.A * (self.n * self.l) * (self.n * self.l) / 2 * (w_y * w_y + w_z * w_z)
        x = (np.arange(self.n) + 0.5) / self.n
        parts = ((1 - x, -along[0]), (x, along[1]), (x * (1 - x), hung))
        return sum((self._spread(weight, values) for weight, values in parts), as_expr(np.zeros(self.count)))

    def _spread(self, weights: np.ndarray, values: Any) -> Any:
        """Distribute the value of each frame to its elements by weights."""
        return _map(np.kron(np.eye(len(self.frames)), weights[:, None]), values)

    @cached_property
    def shape(self) -> Bend:
        """Bending of every element, in m."""
        v_1, a, v_2, b = (_joined(frame[i][k : self.n + k] for frame in self.nodes) for k in (0, 1) for i in (0, 1))
        return Bend(v_2 - v_1, a - b, 2 * (v_2 - v_1) - a - b)

    def errors(self) -> tuple[Bend, Bend]:
        """Bending of every element, in m, by the neglected forces: of axial forces, and of slopes."""
        e, N, power = self.shape, self.tension, 2 if self.beam.geometric_stiffness else 1
        pulls, slopes = [], []
        for sign, slope, bent in gauss(e):
            stiff = self.EJ / (2 * self.l ** (2 * power + 3)) * _power(slope, 2 * power - 1) * bent
            slopes.append(_at(sign, power * stiff * bent, stiff * slope))
            pulls.append(_at(sign, 3 * N / (16 * self.l**5) * _power(slope, 5), 0 * N))
        if power == 1:
            pulls = [Bend(N / self.l * e.d, N / (12 * self.l) * e.q, N / (20 * self.l) * e.r)]
        zero = as_expr(np.zeros(len(self.frames)))
        return self._bent(_sum(pulls), zero, zero), self._bent(_sum(slopes), *self._end_forces())

    def _end_forces(self) -> Iterator[Any]:
        """Neglected forces of end moments on the nodal coordinates l v' at roots and tips of the frames."""
        for turns, ports in self.ends:
            slopes = turns / self.l
            neglected = 3 / 8 * _power(slopes, 4) if self.beam.geometric_stiffness else _power(slopes, 2) / 2
            yield -_joined([port.t[2]] for port in ports) / self.l * neglected

    def _bent(self, forces: Bend, at_root: Any, at_tip: Any) -> Bend:
        """Bending by generalised forces on the elements, and at roots and tips of the frames."""
        n, each = self.n, np.eye(len(self.frames))
        across, ones = forces.d, np.ones(n)
        if self.beam.reference == "pinned":  # the chord rotates freely
            across = (
                across - _map(np.kron(each, np.ones((n, n)) / n), across) - self._spread(ones / n, at_root + at_tip)
            )
        # d = r / 2 + mean slope of both nodes, and the slope of a node is that of the root minus q of all elements before.
        beyond = np.kron(each, np.triu(np.ones((n, n)), 1) + np.eye(n) / 2)
        soft = self.l**3 / self.EJ
        bent = soft * (forces.q - _map(beyond, across) - self._spread(ones, at_tip))
        return Bend(0 * bent, bent, soft / 3 * (forces.r + across / 2))

    def _heights(self, e: Bend) -> Any:
        """Heights of all nodes in m above the chord, or the tangent at the root, or at the tip if only the tip is clamped."""
        k = np.arange(self.count + 1)
        y = _cumulative((e.r - e.q) / 2 - _cumulative(e.q)[:-1])
        if self.beam.reference == "pinned":
            return y - k / self.count * y[self.count]
        turned = self.hinged[0] * (1 - self.hinged[1])
        return y - turned * (np.ones(k.size) * y[self.count] - (k - self.count) * _total(e.q))

    def deflection(self, e: Bend) -> Any:
        """Maximum height of a node, in m, approximated by the smooth 8-norm."""
        return sqrt(sqrt(sqrt(_total(_power(self._heights(e), 8)))))

    def amplification(self, e: Bend) -> Any:
        """Amplification of the bending of a rotating beam, relative to its bending stiffness alone: B / (B - C + H).

        B is the work of bending in the shape, C that of the transverse centrifugal forces, w^2 int rho A v^2, and H that of
        axial forces on the slopes included in the frames.
        """
        y, beam, w = self._heights(e), self.beam, self.frames[0].ref.R.w
        # A beam between two hinges rotates until the transverse forces have no moment.
        k = np.arange(self.count + 1)
        y = y - k * (self.hinged[0] * self.hinged[1] * _total(k / np.sum(k * k) * y))
        a, b = y[:-1], y[1:]
        away = beam.rho * beam.A * self.l / 3 * (w[0] * w[0] + w[2] * w[2]) * _total(a * a + a * b + b * b)
        held = _total(self.tension * (b - a) * (b - a)) / self.l
        stiff, takes_up = self._stiffness(e), len(self.frames) > 1 or beam.geometric_stiffness
        return stiff / (stiff - away + held if takes_up else stiff - away)


def _across(frame: Any) -> tuple[list[Any], list[Any]]:
    """Displacements v and rotations l v' of all nodes, in m."""
    found = [as_expr(0.0)] * (3 * frame.elements + 3)
    for k, index in enumerate(frame.free):
        if index % 3:
            found[index] = as_expr(frame.q[k].sx)
    return found[1::3], [frame._l * slope for slope in found[2::3]]


def _at(sign: int, by_slope: Any, by_bent: Any) -> Bend:
    """Generalised forces on the element modes equivalent to forces on l v' and l^2 v'' at a Gauss point."""
    return Bend(by_slope, sign / root(12) * by_slope - by_bent, sign * root(3) * by_bent)


def _sum(bends: list[Bend]) -> Bend:
    return Bend(*(sum(modes[1:], modes[0]) for modes in zip(*bends, strict=True)))


def _power(x: Any, n: int) -> Any:
    return x if n == 1 else _power(x * x, n // 2) * (x if n % 2 else 1)


def _joined(parts: Iterable[list[Any]]) -> Any:
    """Vector of all entries, without units: displacements and rotations are mixed."""
    return as_expr([Expr(entry.sx) for part in parts for entry in part])


def _map(M: np.ndarray, x: Any) -> Any:
    """Numerical matrix times a vector, without units."""
    return Expr(as_expr(M).sx @ x.sx, shape=(len(M),))


def _cumulative(x: Any) -> Any:
    """Cumulative sums, starting with 0: one entry more than x."""
    return as_expr([as_expr(0), *(Expr(entry) for entry in accumulate(x.sx.elements()))])


def _total(x: Any) -> Any:
    return _map(np.ones((1, len(x))), x)[0]
