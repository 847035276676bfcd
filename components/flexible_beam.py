"""FlexibleBeam: an Euler-Bernoulli beam of finite elements in a floating frame."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import (
    PREFER,
    as_expr,
    branch,
    cos,
    cross,
    der,
    dot,
    observed,
    outer,
    port,
    potential_root,
    sin,
    structural,
    variable,
)
from components.beam import Beam
from components.beam_element import beam_matrices
from components.beam_inertia import Inertia
from components.frame import Frame, move
from components.orientation import null_rotation, planar_rotation, resolve1, resolve2
from components.world import World

Z = np.array([0.0, 0.0, 1.0])


class FlexibleBeam(Beam):
    """Straight beam along x of its reference frame that bends in the xy plane of that frame and stretches.

    Parameters
    ----------
    length, E, rho, A, J : float
        Length in m, modulus of elasticity in Pa, density in kg/m3, area in m2 and second moment of area for bending in
        the xy plane in m4 of the section.
    J_y : float
        Second moment of area about y, only for the inertia about the beam's own axis; default J.
    torsional_inertia : float
        Moment of inertia about the beam's own axis in kg.m2; default rho (J + J_y) length.
    elements : int
        Number of finite elements.
    reference : "tangent" or "pinned"
        The reference frame is frame_a (tangent to the root), or the chord from the first to the last point.
    alpha, beta : float
        Rayleigh damping in 1/s and s: D = alpha M + beta K.
    initial : "undeformed", "static" or "free"
        At the start: q = 0 and der(q) = 0; der(q) = 0 and der(der(q)) = 0; or nothing.

    Notes
    -----
    Schiavo, Vigano, Ferretti, Object-oriented modelling of flexible beams, Multibody System Dynamics 15 (2006),
    equations 5 to 16. Sections keep a finite angle: frame_a and frame_b are the material end sections. Deformations are
    small against the length; a beam that turns faster than its first natural frequency needs SubstructuredBeam.
    """

    elements: int = structural("number of finite elements", default=1, minimum=1, refine=lambda s: s.adaptive)
    world: World = outer(World)
    q: Any = variable(
        "free nodal coordinates (u, v, theta) of all nodes, resolved in the reference frame",
        shape=lambda s: (len(s.free),),
        unit=lambda s: [("m", "m", "rad")[k % 3] for k in s.free],
        select=PREFER,
    )
    qd: Any = variable(
        "der(q)",
        shape=lambda s: (len(s.free),),
        unit=lambda s: [("m/s", "m/s", "rad/s")[k % 3] for k in s.free],
        select=PREFER,
        nominal=lambda s: s.nominal_rate,
    )
    qdd: Any = variable(
        "der(qd)",
        shape=lambda s: (len(s.free),),
        unit=lambda s: [("m/s2", "m/s2", "rad/s2")[k % 3] for k in s.free],
    )

    @port
    def chord(self):
        """Reference frame on the chord."""
        return Frame() if self.reference == "pinned" else None

    @property
    def free(self) -> list[int]:
        """Nodal coordinates that are not zero by the choice of the reference frame (equation 13)."""
        last = 3 * self.elements
        fixed = (0, 1, 2) if self.reference == "tangent" else (0, 1, last + 1)
        return [k for k in range(last + 3) if k not in fixed]

    @property
    def ref(self) -> Any:
        """The reference frame."""
        return self.frame_a if self.reference == "tangent" else self.chord

    def connections(self):
        if self.reference == "pinned":
            yield branch(self.frame_a, self.chord)
        yield branch(self.ref, self.frame_b)
        yield potential_root(self.ref, priority=1)

    def equations(self):
        ref, b = self.ref, self.frame_b
        yield self.qd == der(self.q)
        yield self.qdd == der(self.qd)
        U, inertia = self._nodes(self.q), self._inertia()
        r_b, R_b = self._end(U), planar_rotation(Z, U[-1] / self._l)
        if self.reference == "pinned":
            R_a = planar_rotation(Z, U[2] / self._l)
            yield from move(ref, self.frame_a, np.zeros(3), R_a)
        else:
            R_a = null_rotation()
        yield from move(ref, b, r_b, R_b)

        f_a, t_a = resolve1(R_a, self.frame_a.f), resolve1(R_a, self.frame_a.t)
        f_b, t_b = resolve1(R_b, b.f), resolve1(R_b, b.t)
        a = ref.a - resolve2(ref.R, self.world.acceleration(self._centre(inertia)))
        force, moment, nodal = inertia.forces(a, ref.z, ref.R.w)
        spin = self.torsional_inertia * ref.R.w[0]
        twist = as_expr((self.torsional_inertia * ref.z[0], ref.R.w[2] * spin, -ref.R.w[1] * spin))
        rates = self._nodes(self.qd)
        elastic, drag = self._stiffness(U) + self.beta * self._stiffness(rates), self._drag(rates)
        balance = nodal + elastic + drag

        load = [as_expr(0.0)] * (3 * self.elements + 3)
        load[2] = t_a[2] / self._l
        load[-3:] = [f_b[0], f_b[1], t_b[2] / self._l]
        yield as_expr([balance[k] for k in self.free]) == as_expr([load[k] for k in self.free])
        if self.reference == "tangent":
            # The balances of the nodes, subtracted from those of the whole beam, leave the load on the tip out of them.
            root = [nodal[k] + elastic[k] - sum(drag[3 + k :: 3], as_expr(0.0)) for k in (0, 1)]
            yield as_expr((*root, force[2])) == as_expr((f_a[0], f_a[1], f_a[2] + f_b[2]))
            f_b = as_expr((balance[-3], balance[-2], f_b[2]))
            t_b = as_expr((t_b[0], t_b[1], self._l * balance[-1]))
        else:
            yield force == f_a + f_b
        yield moment + twist == t_a + t_b + cross(r_b, f_b)

    def initial_equations(self):
        zero = np.zeros(len(self.free))
        if self.initial != "free":
            yield self.qd == as_expr(zero)
            yield (self.q if self.initial == "undeformed" else self.qdd) == as_expr(zero)

    @property
    def _l(self) -> Any:
        return self.length / self.elements

    def _nodes(self, q: Any) -> Any:
        """Nodal coordinates in metres, (u, v, l theta) of every node, from the free ones."""
        full = [as_expr(0.0)] * (3 * self.elements + 3)
        for k, index in enumerate(self.free):
            full[index] = self._l * q[k] if index % 3 == 2 else q[k]
        return as_expr([as_expr(entry.sx) for entry in full])

    def _inertia(self) -> Inertia:
        U, Ud, Udd = (self._nodes(q) for q in (self.q, self.qd, self.qdd))
        return Inertia(beam_matrices(self.elements), self.elements, self._l, self.rho * self.A * self._l, U, Ud, Udd)

    def _end(self, U: Any) -> Any:
        return as_expr((self.length + U[-3], U[-2], 0.0))

    def _stiffness(self, U: Any) -> Any:
        b, l = beam_matrices(self.elements), self._l
        return self.E * self.A / l * (b.K_axial @ U) + self.E * self.J / l**3 * (b.K_bending @ U)

    def _drag(self, Ud: Any) -> Any:
        b = beam_matrices(self.elements)
        return self.alpha * self.rho * self.A * self._l * ((b.M11 + b.M22) @ Ud)

    def _centre(self, inertia: Inertia) -> Any:
        return self.ref.r_0 + resolve1(self.ref.R, inertia.first() / inertia.mass)

    def stored_energy(self):
        """Kinetic, elastic and potential energy."""
        inertia, ref = self._inertia(), self.ref
        U, w = self._nodes(self.q), ref.R.w
        kinetic = inertia.kinetic_energy(ref.v, w) + self.torsional_inertia * w[0] ** 2 / 2
        potential = inertia.mass * self.world.potential(self._centre(inertia))
        return kinetic + dot(U, self._stiffness(U)) / 2 + potential

    def dissipated_power(self):
        """Power of the Rayleigh damping."""
        Ud = self._nodes(self.qd)
        return dot(Ud, self._drag(Ud) + self.beta * self._stiffness(Ud))

    @observed
    def node_deflection(self):
        """Nodal coordinates (u, v, theta), shape (nodes, 3), resolved in the reference frame."""
        U = self._nodes(self.q)
        return as_expr([[U[3 * k], U[3 * k + 1], U[3 * k + 2] / self._l] for k in range(self.elements + 1)])

    @observed
    def node_r_0(self):
        """Position of every node, shape (nodes, 3), resolved in the world, in m."""
        U, ref = self._nodes(self.q), self.ref
        local = as_expr([[k * self._l + U[3 * k], U[3 * k + 1], 0.0] for k in range(self.elements + 1)])
        origin = as_expr([[ref.r_0[i] for i in range(3)]] * (self.elements + 1))
        return origin + local @ ref.R.T

    @observed
    def middle_r_0(self):
        """Position of the material middle point, resolved in the world, in m."""
        U, half = self._nodes(self.q), self.elements // 2
        left = U[3 * half : 3 * half + 3]
        if self.elements % 2:
            right = U[3 * half + 3 : 3 * half + 6]
            at = ((left[0] + right[0]) / 2, (left[1] + right[1]) / 2 + (left[2] - right[2]) / 8)
        else:
            at = (left[0], left[1])
        return self.ref.r_0 + resolve1(self.ref.R, as_expr((self.length / 2 + at[0], at[1], 0.0)))

    @observed
    def node_force(self):
        """Force on the part towards frame_a at every node, shape (nodes, 3), resolved in the reference frame, in N."""
        return as_expr([[force[i] for i in range(3)] for force, _ in self._cuts()])

    @observed
    def node_moment(self):
        """Moment on the part towards frame_a at every node, shape (nodes, 3), resolved in the reference frame, N.m."""
        return as_expr([[moment[i] for i in range(3)] for _, moment in self._cuts()])

    def _cuts(self) -> list[tuple[Any, Any]]:
        """Force and moment at every node: what is applied at the tip, less the inertia forces beyond the node."""
        U, ref, b = self._nodes(self.q), self.ref, self.frame_b
        inertia = self._inertia()
        R_b, r_b = planar_rotation_without_rate(U[-1] / self._l), self._end(U)
        a = ref.a - resolve2(ref.R, self.world.acceleration(self._centre(inertia)))
        force, moment = R_b.T @ b.f, R_b.T @ b.t + cross(r_b, R_b.T @ b.f)
        cuts = []
        for k in range(self.elements, -1, -1):
            at = as_expr((k * self._l + U[3 * k], U[3 * k + 1], 0.0))
            cuts.append((force, moment - cross(at, force)))
            if k:
                part, about = inertia.element_forces(k - 1, a, ref.z, ref.R.w)
                spin = self.torsional_inertia / self.elements * ref.R.w[0]
                alpha = self.torsional_inertia / self.elements * ref.z[0]
                twist = as_expr((alpha, ref.R.w[2] * spin, -ref.R.w[1] * spin))
                force, moment = force - part, moment - about - twist
        return cuts[::-1]


def planar_rotation_without_rate(angle: Any) -> Any:
    """Rotation matrix about z, turning coordinates of the reference frame into those of the section."""
    c, s = cos(angle), sin(angle)
    return as_expr([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
