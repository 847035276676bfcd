"""FlexibleBeam: Euler-Bernoulli beam of finite elements in a floating frame."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import (
    PREFER,
    as_expr,
    branch,
    cross,
    der,
    dot,
    in_loop,
    initial,
    observed,
    outer,
    port,
    potential_root,
    soft,
    structural,
    variable,
)
from components.beams.beam import Beam
from components.beams.element import beam_matrices
from components.beams.inertia import Inertia
from components.beams.section_loads import section_loads
from components.beams.sections import Sections
from components.beams.strain import Strain, shifted
from components.frame import Frame, move
from components.orientation import null_rotation, planar_rotation, resolve1, resolve2
from components.world import World


class FlexibleBeam(Beam):
    """Straight beam along x of its reference frame, with axial deformation and bending in the xy plane of that frame.

    Notes
    -----
    Schiavo, Vigano, Ferretti, Object-oriented modelling of flexible beams, Multibody System Dynamics 15 (2006),
    equations 5 to 16. frame_a and frame_b are the material end sections, with finite rotation angles. Deformations are
    small; a beam that rotates faster than its first natural frequency needs geometric_stiffness.
    """

    without_soft = 'initial="free"'
    elements: int = structural("number of finite elements", default=1, minimum=1, refine=lambda s: s.adaptive)
    world: World = outer(World)
    q: Any = variable(
        "free nodal coordinates (u, v, theta) of all nodes, resolved in the reference frame",
        shape=lambda s: (len(s.free),),
        unit=lambda s: [("m", "m", "rad")[k % 3] for k in s.free],
        select=PREFER,
        nominal=1.0,  # m: the error test ignores vibrations much smaller than the machine
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
    tension: Any = variable(
        "axial force of each element, unless its stretch is a state",
        shape=lambda s: (s.elements * s._has_tension,),
        unit="N",
    )

    @port
    def chord(self) -> Frame | None:
        """Reference frame on the chord."""
        return Frame() if self.reference == "pinned" else None

    @property
    def free(self) -> list[int]:
        """Indices of the nodal coordinates that are states."""
        return [k for k in self._unfixed if (self.bending if k % 3 else self.axial == "dynamic")]

    @property
    def _unfixed(self) -> list[int]:
        """Indices of the nodal coordinates that the reference frame does not fix at zero (equation 13)."""
        last = 3 * self.elements
        fixed = (0, 1, 2) if self.reference == "tangent" else (0, 1, last + 1)
        return [k for k in range(last + 3) if k not in fixed]

    @property
    def _has_tension(self) -> bool:
        """Return whether axial forces are unknowns: they act, but the stretch is not a state."""
        return self.axial == "quasi_static" or (self.axial == "none" and self._strain.second_order)

    @property
    def ref(self) -> Any:
        """The reference frame."""
        return self.frame_a if self.reference == "tangent" else self.chord

    def connections(self):
        if self.reference == "pinned":
            yield branch(self.frame_a, self.chord)
        yield branch(self.ref, self.frame_b)
        yield potential_root(self.ref, priority=3)

    def equations(self):
        ref, b = self.ref, self.frame_b
        if self.free:
            yield from (self.qd == der(self.q), self.qdd == der(self.qd))
        motion = U, Ud, _ = self._motion()
        r_b, R_b = self._end(U), self._rotation(U[-1])
        R_a = self._rotation(U[2]) if self.reference == "pinned" else null_rotation()
        if self.reference == "pinned":
            yield from move(ref, self.frame_a, np.zeros(3), R_a)
        # The closure of a loop cannot depend on forces: in loops only the beam's own results show a quasi-static stretch.
        moves_tip = self.axial == "quasi_static" and not in_loop(self)
        yield from move(ref, b, r_b, R_b, as_expr((sum(self._stretches()), 0.0, 0.0)) if moves_tip else None)

        f_a, t_a = resolve1(R_a, self.frame_a.f), resolve1(R_a, self.frame_a.t)
        f_b, t_b = resolve1(R_b, b.f), resolve1(R_b, b.t)
        force, moment, nodal = self._inertia_forces(motion)
        elastic, drag = self._strain.forces(U, Ud, self._tensions(U, Ud)), self._drag(motion)
        balance, moment_b = nodal + elastic + drag, t_b + cross(r_b, f_b)
        load, balanced = self._load(U, t_a, f_b, t_b), self._balanced
        if balanced:
            yield as_expr([balance[k] for k in balanced]) == as_expr([load[k] for k in balanced])  # (43)
            if self.reference == "tangent":
                force, f_b, moment_b = self._without_tip_load(force, f_b, t_b, balance, drag, U)
        yield force == f_a + f_b  # (41)
        yield moment == t_a + moment_b  # (42)

    @property
    def _balanced(self) -> list[int]:
        """Indices of the nodal coordinates with an equilibrium equation."""
        return [k for k in self._unfixed if k in self.free or (self._has_tension and k % 3 == 0)]

    def _load(self, U: Any, t_a: Any, f_b: Any, t_b: Any) -> list[Any]:
        """Nodal forces of the loads on both ends, in N, conjugate to U."""
        load, strain = [as_expr(0.0)] * (3 * self.elements + 3), self._strain
        load[2] = t_a[2] / self._l * strain.angle_derivative(U[2])
        load[-3:] = [f_b[0], f_b[1], t_b[2] / self._l * strain.angle_derivative(U[-1])]
        return load

    def _without_tip_load(self, force: Any, f_b: Any, t_b: Any, balance: Any, drag: Any, U: Any) -> tuple[Any, ...]:
        """Inertia force, tip force, and moment of the tip load about the root in (41) and (42), reduced by (43).

        The tip force is the sum of the balances (43) of all nodes except the root, the tip moment the balance of the last
        node. This reduces the coupling of volumes in a chain: models/spin_up with 10 volumes has 990 instead of 1046
        nonzeros in its Jacobian, with the same 152 unknowns and 310 steps.
        """
        rest, far, f, t = ([x[k] for k in range(3)] for x in (force, f_b, f_b, t_b))
        for k in (0, 1):
            if 3 * self.elements + k in self._balanced:
                f[k], far[k] = balance[k - 3], as_expr(0.0)
                rest[k] = balance[k] - sum(drag[k::3], as_expr(0.0))
        if 3 * self.elements + 2 in self._balanced:
            t[2] = balance[-1] * (self._l / self._strain.angle_derivative(U[-1]))
        return as_expr(rest), as_expr(far), as_expr(t) + cross(self._end(U), as_expr(f))

    def initial_equations(self):
        if self.initial != "free" and self.free:
            for q in (self.qd, self.q * initial if self.initial == "undeformed" else self.qdd):
                yield soft(q == as_expr(np.zeros(len(self.free))))

    @property
    def _l(self) -> Any:
        return self.length / self.elements

    @property
    def _strain(self) -> Strain:
        beta = self.beta if self.damping else 0.0
        second_order = self.geometric_stiffness and self.bending
        return Strain(self.elements, self._l, self.E * self.A, self.E * self.J, beta, second_order)

    def _nodes(self, q: Any) -> Any:
        """Nodal coordinates in metres, (u, v, l theta) of every node, from the states."""
        full = [as_expr(0.0)] * (3 * self.elements + 3)
        for k, index in enumerate(self.free):
            full[index] = self._l * q[k] if index % 3 == 2 else q[k]
        return as_expr([as_expr(entry.sx) for entry in full])

    def _motion(self) -> tuple[Any, Any, Any]:
        """Nodal coordinates in metres and their first and second derivatives, without a quasi-static stretch."""
        U, Ud, Udd = self._nodes(self.q), self._nodes(self.qd), self._nodes(self.qdd)
        return (U, Ud, Udd) if self.axial == "dynamic" else self._strain.unstretched(U, Ud, Udd)

    def _tensions(self, U: Any, Ud: Any) -> list[Any]:
        """Axial force of every element, in N."""
        if self.axial == "dynamic":
            return self._strain.stretching(U, Ud)
        return [self.tension[j] if self._has_tension else as_expr(0.0) for j in range(self.elements)]

    def _stretches(self) -> list[Any]:
        """Quasi-static change of length of every element, in m."""
        return [self.tension[j] * self._l / (self.E * self.A) for j in range(self.elements)]

    def _shape(self) -> Any:
        """Nodal coordinates of the displayed shape in metres, including a quasi-static stretch."""
        U = self._motion()[0]
        return shifted(U, self._stretches()) if self.axial == "quasi_static" else U

    def _inertia(self, motion: tuple[Any, Any, Any]) -> Inertia:
        n, mu, strain = self.elements, self.rho * self.A * self._l, self._strain
        matrices = beam_matrices(n, strain.second_order)
        return Inertia(matrices, n, self._l, mu, *strain.with_bubbles(*motion), self.centrifugal, self.coriolis)

    def _inertia_forces(self, motion: tuple[Any, Any, Any]) -> tuple[Any, Any, Any]:
        """Force, moment and nodal forces of inertia (36) to (38), including rotary inertia."""
        inertia, sections, ref = self._inertia(motion), self._sections(motion), self.ref
        force, moment, nodal = inertia.forces(self._acceleration(inertia), ref.z, ref.R.w)
        nodal = self._strain.without_bubbles(nodal, motion[0]) + sections.nodal(ref.z)
        return force, moment + sections.moment(ref.z, ref.R.w), nodal

    def _sections(self, motion: tuple[Any, Any, Any]) -> Sections:
        about_z = self.rho * self.length * self.J if self.rotary_inertia else 0.0
        about_y = self.rho * self.length * self.J_y if self.rotary_inertia else 0.0
        I = as_expr([as_expr(i).sx for i in (self.torsional_inertia, about_y, about_z)])
        return Sections(self.elements, self._l, I, motion[1], motion[2], self.coriolis)

    def _rotation(self, turn: Any) -> Any:
        """Rotation of an end section with the nodal coordinate turn = l v'."""
        return planar_rotation(np.array([0.0, 0.0, 1.0]), self._strain.angle(turn)) if self.bending else null_rotation()

    def _end(self, U: Any) -> Any:
        return as_expr((self.length + U[-3], U[-2], 0.0))

    def _drag(self, motion: tuple[Any, Any, Any]) -> Any:
        inertia, alpha = self._inertia(motion), self.alpha if self.damping else 0.0
        return self._strain.without_bubbles(alpha * inertia.momentum(), motion[0])

    def _centre(self, inertia: Inertia) -> Any:
        return self.ref.r_0 + resolve1(self.ref.R, inertia.first() / inertia.mass)

    def _acceleration(self, inertia: Inertia) -> Any:
        """Acceleration of the reference frame minus gravity, resolved in it."""
        gravity = self.world.acceleration(self._centre(inertia)) if self.weight else np.zeros(3)
        return self.ref.a - resolve2(self.ref.R, gravity)

    def stored_energy(self):
        """Kinetic, elastic and potential energy; strain energy of stretch only if it is dynamic."""
        motion, ref = self._motion(), self.ref
        inertia = self._inertia(motion)
        kinetic = inertia.kinetic_energy(ref.v, ref.R.w) + self._sections(motion).kinetic_energy(ref.R.w)
        potential = inertia.mass * self.world.gravity_potential(self._centre(inertia)) if self.weight else 0.0
        return kinetic + potential + self._strain.energy(motion[0], stretches=self.axial == "dynamic")

    def dissipated_power(self):
        """Power of the Rayleigh damping."""
        motion = U, Ud, _ = self._motion()
        return dot(Ud, self._drag(motion)) + self._strain.dissipated(U, Ud, stretches=self.axial == "dynamic")

    @observed
    def node_deflection(self):
        """Nodal coordinates (u, v, theta), shape (nodes, 3), resolved in the reference frame."""
        U = self._shape()
        angle = self._strain.angle
        return as_expr([[U[3 * k], U[3 * k + 1], angle(U[3 * k + 2])] for k in range(self.elements + 1)])

    @observed
    def node_r_0(self):
        """Position of every node, shape (nodes, 3), resolved in the world, in m."""
        U, ref = self._shape(), self.ref
        local = as_expr([[k * self._l + U[3 * k], U[3 * k + 1], 0.0] for k in range(self.elements + 1)])
        origin = as_expr([[ref.r_0[i] for i in range(3)]] * (self.elements + 1))
        return origin + local @ ref.R.T

    @observed
    def middle_r_0(self):
        """Position of the material midpoint, resolved in the world, in m."""
        U, half = self._shape(), self.elements // 2
        at = self._strain.middle(U, half) if self.elements % 2 else (U[3 * half], U[3 * half + 1])
        return self.ref.r_0 + resolve1(self.ref.R, as_expr((self.length / 2 + at[0], at[1], 0.0)))

    @observed
    def node_force(self):
        """Section force on the side of frame_a at every node, shape (nodes, 3), resolved in the reference frame, in N."""
        return as_expr([[force[i] for i in range(3)] for force, _ in section_loads(self)])

    @observed
    def node_moment(self):
        """Section moment on the side of frame_a at every node, shape (nodes, 3), resolved in the reference frame, N.m."""
        return as_expr([[moment[i] for i in range(3)] for _, moment in section_loads(self)])
