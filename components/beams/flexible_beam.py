"""FlexibleBeam: beam of finite elements in a floating frame."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import (
    PREFER,
    as_expr,
    branch,
    der,
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
from components.beams.beam_motion import BeamMotion
from components.beams.nodes import NODE, ROTATIONS, TRANSLATIONS
from components.beams.section_loads import section_loads
from components.frame import Frame, move
from components.orientation import null_rotation, resolve1
from components.world import World

UNITS = ("m", "m", "rad", "m", "rad", "rad")


def _units(beam: Any, per: str) -> list[str]:
    return [UNITS[k % NODE] + per for k in beam.free]


class FlexibleBeam(Beam):
    """Straight beam along x of its reference frame, with bending in both planes, torsion and stretch.

    Notes
    -----
    Schiavo, Vigano, Ferretti, Object-oriented modelling of flexible beams, Multibody System Dynamics 15 (2006),
    equations 5 to 16, in space. frame_a and frame_b are the material end sections, with finite rotations. Deformations
    are small; a beam that rotates faster than its first natural frequency needs geometric_stiffness.
    """

    without_soft = 'initial="free"'
    elements: int = structural("number of finite elements", default=1, minimum=1, refine=lambda s: s.adaptive)
    world: World = outer(World)
    q: Any = variable(
        "free nodal coordinates (u, v, v', w, w', phi) of all nodes, resolved in the reference frame",
        shape=lambda s: (len(s.free),),
        unit=lambda s: _units(s, ""),
        select=PREFER,
        nominal=1.0,  # m: the error test ignores vibrations much smaller than the machine
    )
    qd: Any = variable(
        "der(q)",
        shape=lambda s: (len(s.free),),
        unit=lambda s: _units(s, "/s"),
        select=PREFER,
        nominal=lambda s: s.nominal_rate,
    )
    qdd: Any = variable("der(qd)", shape=lambda s: (len(s.free),), unit=lambda s: _units(s, "/s2"))
    tension: Any = variable(
        "axial force of each element, unless its stretch is a state",
        shape=lambda s: (s._elements * s._has_tension,),
        unit="N",
    )

    @port
    def chord(self) -> Frame | None:
        """Reference frame on the chord."""
        return Frame() if self.reference == "pinned" else None

    @property
    def _elements(self) -> int:
        """Number of elements, with nodes at inner frames."""
        return self._with_nodes(self.elements)

    @property
    def free(self) -> list[int]:
        """Indices of the nodal coordinates that are states, six of each node."""
        return [k for k in self._unfixed if self._deforms(k)]

    def _deforms(self, k: int) -> bool:
        """Return whether the effects leave the nodal coordinate k free."""
        k = k % NODE
        if k in (0, 5):
            return self.torsion if k else self.axial == "dynamic"
        return self.bending in ("both", "xy" if k < 3 else "xz")

    @property
    def _unfixed(self) -> list[int]:
        """Indices of the nodal coordinates that the reference frame does not fix at zero (equation 13).

        The chord turns about its axis with the mean of both ends: phi of the first node is the opposite of that of the last.
        """
        last = NODE * self._elements
        fixed = range(NODE) if self.reference == "tangent" else (0, 1, 3, 5, last + 1, last + 3)
        return [k for k in range(last + NODE) if k not in fixed]

    @property
    def _has_tension(self) -> bool:
        """Return whether axial forces are unknowns: they act, but the stretch is not a state."""
        return self.axial == "quasi_static" or (self.axial == "none" and BeamMotion(self).strain.shortens)

    @property
    def ref(self) -> Any:
        """The reference frame."""
        return self.frame_a if self.reference == "tangent" else self.chord

    def connections(self):
        if self.reference == "pinned":
            yield branch(self.frame_a, self.chord)
        for frame in (self.frame_b, *self.frames_inner):
            yield branch(self.ref, frame)
        yield potential_root(self.ref, priority=3)

    def equations(self):
        ref, b, motion = self.ref, self.frame_b, BeamMotion(self)
        if self.free:
            yield from (self.qd == der(self.q), self.qdd == der(self.qd))
        R_a = motion.rotation(0).orientation() if self.reference == "pinned" else null_rotation()
        if self.reference == "pinned":
            yield from move(ref, self.frame_a, np.zeros(3), R_a)
        # The closure of a loop cannot depend on forces: in loops only the beam's own results show a quasi-static stretch.
        stretches = self.axial == "quasi_static" and not in_loop(self)
        for node, frame in [(self._elements, b), *motion.inner_frames()]:
            r, R = motion.place(node, motion.coordinates[0]), motion.rotation(node).orientation()
            yield from move(ref, frame, r, R, motion.stretch_before(node) if stretches else None)

        f_a, t_a = resolve1(R_a, self.frame_a.f), resolve1(R_a, self.frame_a.t)
        R_b = motion.rotation(-1).orientation()
        f_b, t_b = resolve1(R_b, b.f), resolve1(R_b, b.t)
        force, moment, inertia = motion.inertia_forces()
        drag = motion.drag()
        balance = inertia.plus(motion.elastic()).plus(drag).entries()
        load, balanced = motion.loads(t_a, f_b, t_b), self._balanced
        if self.reference == "pinned":  # phi of both ends is one coordinate
            balance[-1], load[-1] = balance[-1] - balance[5], load[-1] - load[5]
        if balanced:
            yield as_expr([balance[k] for k in balanced]) == as_expr([load[k] for k in balanced])  # (43)
        beyond, turning = motion.resultant(f_b, t_b)
        if balanced and self.reference == "tangent":
            force, beyond, turning = self._without_tip_load(force, f_b, t_b, balance, drag.entries(), motion)
        yield force == f_a + beyond  # (41)
        yield moment == t_a + turning  # (42)

    @property
    def _balanced(self) -> list[int]:
        """Indices of the nodal coordinates with an equilibrium equation."""
        free, stretches = self.free, self._has_tension
        return [k for k in self._unfixed if k in free or (stretches and k % NODE == 0)]

    def _without_tip_load(
        self, force: Any, f_b: Any, t_b: Any, balance: list[Any], drag: list[Any], motion: BeamMotion
    ) -> tuple[Any, ...]:
        """Inertia force, force beyond the root, and its moment about the root in (41) and (42), reduced by (43).

        The force beyond the root is the sum of the balances (43) of all other nodes, the tip moment the balance of the
        last node. This reduces the coupling of volumes in a chain.
        """
        beyond, _ = motion.resultant(f_b, t_b)
        rest, far, tip = ([x[k] for k in range(3)] for x in (force, beyond, f_b))
        balanced, last = self._balanced, NODE * self._elements
        for axis, k in enumerate(TRANSLATIONS):
            if last + k in balanced:
                far[axis] = as_expr(0.0)
                rest[axis] = balance[k] - sum(drag[k::NODE], as_expr(0.0))
                if not motion.inner_frames():
                    tip[axis] = balance[last + k]
        known = [last + k in balanced for k in ROTATIONS]
        if all(known) or known == [True, False, False]:
            on = [
                balance[last + k] * motion.l if found else as_expr(0.0)
                for k, found in zip(ROTATIONS, known, strict=True)
            ]
            torque = motion.rotation(-1).torque(on)
            t_b = torque if all(known) else as_expr((t_b[0], t_b[1], torque[2]))
        return as_expr(rest), as_expr(far), motion.resultant(as_expr(tip), t_b)[1]

    def initial_equations(self):
        if self.initial != "free" and self.free:
            for q in (self.qd, self.q * initial if self.initial == "undeformed" else self.qdd):
                yield soft(q == as_expr(np.zeros(len(self.free))))

    @property
    def _l(self) -> Any:
        return self.length / self._elements

    def stored_energy(self):
        """Kinetic, elastic and potential energy; strain energy of stretch only if it is dynamic."""
        return BeamMotion(self).stored_energy()

    def dissipated_power(self):
        """Power of the Rayleigh damping."""
        return BeamMotion(self).dissipated_power()

    def supplied_power(self):
        """Power of the distributed loads."""
        loads = BeamMotion(self).distributed
        return sum((load.power for load in loads[1:]), loads[0].power) if loads else 0.0

    @observed
    def node_deflection(self):
        """Displacement (u, v, w) and rotation vector (phi, -w', v') of every node, shape (nodes, 6), in the reference frame."""
        motion, rows = BeamMotion(self), []
        U = motion.shape
        for k in range(self._elements + 1):
            rows.append([U.u[k], U.v[k], U.w[k], *motion.rotation(k).vector()])
        return as_expr(rows)

    @observed
    def node_r_0(self):
        """Position of every node, shape (nodes, 3), resolved in the world, in m."""
        motion, ref = BeamMotion(self), self.ref
        nodes = range(self._elements + 1)
        local = as_expr([[*motion.place(k, motion.shape)] for k in nodes])
        origin = as_expr([[ref.r_0[i] for i in range(3)] for _ in nodes])
        return origin + local @ ref.R.T

    @observed
    def middle_r_0(self):
        """Position of the material midpoint, resolved in the world, in m."""
        return self.ref.r_0 + resolve1(self.ref.R, BeamMotion(self).middle())

    @observed
    def node_force(self):
        """Section force on the side of frame_a at every node, shape (nodes, 3), resolved in the reference frame, in N."""
        return as_expr([[force[i] for i in range(3)] for force, _ in section_loads(self)])

    @observed
    def node_moment(self):
        """Section moment on the side of frame_a at every node, shape (nodes, 3), resolved in the reference frame, N.m."""
        return as_expr([[moment[i] for i in range(3)] for _, moment in section_loads(self)])
