"""Motion of a flexible beam, and the forces on its nodal coordinates."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from acausal import Expr, as_expr, cross
from components.beams.distributed import PointLoad, on_nodes, point_loads, resultant
from components.beams.elasticity import Elasticity
from components.beams.inertia import Inertia, Place
from components.beams.nodes import NODE, ROTATIONS, TRANSLATIONS, Nodes, first, last
from components.beams.pair import Symmetric, inverse
from components.beams.point_inertia import PointInertia
from components.beams.quadrature import GAUSS, POINTS, SIMPSON, WEIGHTS
from components.beams.rotary_inertia import Discs, Spin, micro_energy, micro_inertia
from components.beams.section_rotation import SectionRotation
from components.beams.section_values import section_at
from components.beams.sections import Section, joined
from components.beams.station import Station
from components.beams.stiffness import ZERO, Stiffness
from components.beams.strain import Strain, shifted
from components.orientation import resolve1, resolve2


class BeamMotion:
    """Strain, inertia and sections of a `FlexibleBeam` in its present motion.

    Parameters
    ----------
    beam : FlexibleBeam
        The beam.
    """

    def __init__(self, beam: Any) -> None:
        self.beam, self.n, self.l = beam, beam._elements, beam.length / beam._elements
        self.varies = callable(beam.section)

    def _section(self, s: float) -> Section:
        """Section at s of every element, -1 at its first node and 1 at its second one, if the section varies."""
        if not self.varies:
            return self._constant
        return joined([section_at(self.beam, (j + (1 + s) / 2) / self.n) for j in range(self.n)])

    @cached_property
    def _constant(self) -> Section:
        return section_at(self.beam, 0.5)

    @cached_property
    def strain(self) -> Strain:
        """Strain of the elements."""
        a, b = (self._section(s) for s in GAUSS)
        second_order = self.beam.geometric_stiffness and self.beam.bending != "none"
        return Strain(self.n, self.l, Stiffness.of((a, b), self.l, self.beam.shear), second_order)

    @cached_property
    def _elasticity(self) -> Elasticity:
        return Elasticity(self.strain, self.beam.beta if self.beam.damping else 0.0, self.beam.torsion)

    def _nodes(self, q: Any) -> Nodes:
        """Nodal coordinates in metres from the states."""
        full = [as_expr(0.0)] * (NODE * self.n + NODE)
        for index, entry in zip(self.beam.free, q, strict=True):
            full[index] = self.l * entry if index % NODE in ROTATIONS else entry
        if self.beam.reference == "pinned":  # the chord turns with the mean of both ends
            full[5] = -full[-1]
        return Nodes.of([as_expr(entry.sx) for entry in full])

    @cached_property
    def coordinates(self) -> tuple[Nodes, Nodes, Nodes]:
        """Nodal coordinates in metres and their first and second derivatives, without a quasi-static stretch."""
        beam = self.beam
        motion = self._nodes(beam.q), self._nodes(beam.qd), self._nodes(beam.qdd)
        inextensible = beam.axial != "dynamic" and self.strain.shortens
        return self.strain.unstretched(motion) if inextensible else motion

    @cached_property
    def bubbles(self) -> tuple[Any, Any, Any]:
        """Coefficients of the axial bubbles in m, and their derivatives; empty without second order."""
        return self.strain.bubbles(self.coordinates)

    def tensions(self) -> Any:
        """Axial force of every element, in N."""
        if self.beam.axial == "dynamic":
            return self._elasticity.tensions(*self.coordinates[:2])
        return Expr(self.beam.tension.sx, shape=(self.n,)) if self.beam._has_tension else as_expr(np.zeros(self.n))

    def stretches(self) -> Any:
        """Quasi-static change of length of every element, in m."""
        return self.l * inverse(self.strain.stiffness.EA) * self.beam.tension

    def stretch_before(self, node: int) -> Any:
        """Displacement of a node by the quasi-static stretch of the elements before it, in m."""
        return as_expr((sum(list(self.stretches())[:node]), 0.0, 0.0))

    @cached_property
    def shape(self) -> Nodes:
        """Nodal coordinates of the displayed shape in metres, including a quasi-static stretch."""
        U = self.coordinates[0]
        return shifted(U, self.stretches()) if self.beam.axial == "quasi_static" else U

    def rotation(self, node: int) -> SectionRotation:
        """Rotation of the section of a node."""
        U = self.coordinates[0]
        return SectionRotation(U.dv[node] / self.l, U.dw[node] / self.l, U.phi[node] / self.l, self.strain.second_order)

    def place(self, node: int, U: Nodes) -> Any:
        """Position of a node in the reference frame, in m."""
        return as_expr((node / self.n * self.beam.length + U.u[node], U.v[node], U.w[node]))

    def middle(self) -> Any:
        """Position of the material midpoint in the reference frame, in m."""
        half, odd = divmod(self.n, 2)
        at, k = (Station(self.strain, 0.0, ZERO), half) if odd else (Station(self.strain, 1.0, ZERO), half - 1)
        moved = at.displacement(self.shape, self.bubbles[0])
        return as_expr((self.beam.length / 2 + moved.x[k], moved.y[k], moved.z[k]))

    def tangents(self) -> list[Any]:
        """Tangents d/dxi of the deformed axis at every node in the reference frame, in m.

        At a node the mean of the stretches on both sides is used.
        """
        U, found = self.shape, []
        stretches = list(self.strain.extension(U, U)[0] if self.strain.second_order else last(U.u) - first(U.u))
        for k in range(self.n + 1):
            near, v, w = stretches[max(k - 1, 0) : k + 1], U.dv[k], U.dw[k]
            square = (v * v + w * w) / (self.l * self.l)
            shorter = self.l * (square / 2 + square * square / 8) if self.strain.second_order else 0.0
            found.append(as_expr((self.l - shorter + sum(near[1:], near[0]) / len(near), v, w)))
        return found

    @cached_property
    def inertia(self) -> Inertia | PointInertia:
        """Inertia of the masses."""
        beam = self.beam
        place, rate, acceleration = zip(self.coordinates, self.bubbles, strict=True)
        effects = beam.centrifugal, beam.coriolis
        if self.varies or beam.shear or not self.strain.stiffness.is_centred:
            return PointInertia(self._masses(), place, rate, acceleration, *effects)
        U, c = place
        straight = self.l * np.arange(self.n + 1)
        at = Place.of(U._replace(u=U.u + straight), c)
        mu = self._constant.mass * self.l
        return Inertia(self.n, self.l, mu, at, Place.of(*rate), Place.of(*acceleration), *effects)

    def _masses(self) -> list[tuple[Station, Any]]:
        found = []
        for s, weight in zip(POINTS, WEIGHTS, strict=True):
            section = self._section(s)
            found.append(
                (Station(self.strain, s, section.centroid()), self._each(section.mass * self.l * (weight / 2)))
            )
        return found

    def _each(self, x: Any) -> Any:
        """Return a vector with one entry per element."""
        return x if self.varies else x * as_expr(np.ones(self.n))

    @cached_property
    def _polar(self) -> Any:
        """Moment of inertia of every element about the axis, in kg.m2."""
        if not self.varies:
            return self._each(self.beam.torsional_inertia / self.n)
        a, b = (self._section(s) for s in GAUSS)
        return self.l / 2 * (a.I_y + a.I_z + b.I_y + b.I_z)

    @cached_property
    def sections(self) -> Spin | Discs:
        """Inertia of the sections."""
        beam, motion = self.beam, self.coordinates
        if not beam.rotary_inertia:
            return Spin(self._polar, self.l, *motion[1:], beam.coriolis)
        discs = []
        for s, weight in SIMPSON:
            second = self._section(s).inertia()
            second = Symmetric(*(x * self.l * weight for x in second))
            discs.append((Station(self.strain, s, ZERO), self._polar * weight, second))
        return Discs(discs, *motion, self.strain.second_order, beam.centrifugal, beam.coriolis, range(self.n))

    @cached_property
    def _elongating(self) -> tuple[Any, Any]:
        """Inertias in kg against rates of stretch and of torsion; 0 where these are no states.

        With second order u' contains the rate of shortening as well, which has no such inertia.
        """
        a, b = (self._section(s) for s in GAUSS)
        stretches = self.beam.axial == "dynamic" and not self.strain.second_order
        mass = (a.mass + b.mass) * self.l / 2 if stretches else as_expr(0.0)
        return mass, self._polar / (self.l * self.l) if self.beam.torsion else as_expr(0.0)

    def inertia_forces(self) -> tuple[Any, Any, Nodes]:
        """Force, moment and nodal forces of inertia (36) to (38), less those of distributed loads."""
        ref, (U, _, Udd), (mass, polar) = self.beam.ref, self.coordinates, self._elongating
        force, moment, (nodal, on_c) = self.inertia.forces(self.acceleration(), ref.z, ref.R.w)
        spinning, more = self.sections.forces(ref.z, ref.R.w)
        if self.distributed:
            pushed, turned = resultant(self.distributed)
            on_nodes_, on_bubbles = on_nodes(self.distributed, self.n)
            force, moment, nodal = force - pushed, moment - turned, nodal.plus(on_nodes_.times(-1.0))
            on_c = on_c - on_bubbles if len(on_c) else on_c
        nodal = self.strain.with_bubbles(nodal, on_c, U).plus(more)
        u, phi = nodal.u + micro_inertia(Udd.u, mass), nodal.phi + micro_inertia(Udd.phi, polar)
        return force, moment + spinning, nodal._replace(u=u, phi=phi)

    @cached_property
    def distributed(self) -> list[PointLoad]:
        """Distributed loads at their points of Gauss."""
        return list(point_loads(self))

    def elastic(self) -> Nodes:
        """Nodal forces of the strain, in N."""
        return self._elasticity.forces(*self.coordinates[:2], self.tensions())

    def drag(self) -> Nodes:
        """Nodal forces of the damping proportional to the mass, in N."""
        (U, Ud, _), (mass, polar) = self.coordinates, self._elongating
        if not self.beam.damping or self.beam.alpha.sx.is_zero():
            return Nodes.zero(self.n + 1)
        nodal = self.strain.with_bubbles(*self.inertia.momentum(), U).plus(self.sections.momentum()[1])
        nodal = nodal._replace(u=nodal.u + micro_inertia(Ud.u, mass), phi=nodal.phi + micro_inertia(Ud.phi, polar))
        return nodal.times(self.beam.alpha)

    @cached_property
    def _inner(self) -> list[tuple[int, Any]]:
        beam = self.beam
        return [(round(x * self.n), frame) for x, frame in zip(beam.frames_at, beam.frames_inner, strict=True)]

    def inner_frames(self) -> list[tuple[int, Any]]:
        """Numbers of the nodes with an inner frame, and these frames."""
        return self._inner

    def inner_load(self, node: int, frame: Any) -> tuple[Any, Any]:
        """Force and torque of an inner frame, resolved in the reference frame."""
        T = self.rotation(node).matrix()
        return T.T @ frame.f, T.T @ frame.t

    def resultant(self, f_b: Any, t_b: Any) -> tuple[Any, Any]:
        """Force and moment about the origin of the loads at frame_b, and at inner frames."""
        U = self.coordinates[0]
        force, moment = f_b, t_b + cross(self.place(self.n, U), f_b)
        for node, frame in self._inner:
            f, t = self.inner_load(node, frame)
            force, moment = force + f, moment + t + cross(self.place(node, U), f)
        return force, moment

    def loads(self, t_a: Any, f_b: Any, t_b: Any) -> list[Any]:
        """Nodal forces of the loads on all frames, resolved in the reference frame, in N, six of every node."""
        load = [as_expr(0.0)] * (NODE * self.n + NODE)
        nothing = as_expr(np.zeros(3))
        given = [(0, nothing, t_a), (self.n, f_b, t_b)]
        given += [(node, *self.inner_load(node, frame)) for node, frame in self._inner]
        for node, force, torque in given:
            for k, on in zip(ROTATIONS, self.rotation(node).forces(torque), strict=True):
                load[NODE * node + k] += on / self.l
            for k, on in zip(TRANSLATIONS, force, strict=True):
                load[NODE * node + k] += on
        return load

    def centre(self) -> Any:
        """Centre of mass, resolved in the world, in m."""
        ref = self.beam.ref
        return ref.r_0 + resolve1(ref.R, self.inertia.first_moment() / self.inertia.mass)

    def acceleration(self) -> Any:
        """Acceleration of the reference frame minus gravity, resolved in it."""
        ref, world = self.beam.ref, self.beam.world
        gravity = world.acceleration(self.centre()) if self.beam.weight else np.zeros(3)
        return ref.a - resolve2(ref.R, gravity)

    def stored_energy(self) -> Any:
        """Kinetic, elastic and potential energy in J."""
        beam, ref, (U, Ud, _) = self.beam, self.beam.ref, self.coordinates
        kinetic = self.inertia.kinetic_energy(ref.v, ref.R.w) + self.sections.kinetic_energy(ref.R.w)
        mass, polar = self._elongating
        kinetic += micro_energy(Ud.u, mass) + micro_energy(Ud.phi, polar)
        potential = self.inertia.mass * beam.world.gravity_potential(self.centre()) if beam.weight else 0.0
        return kinetic + potential + self._elasticity.energy(U, stretches=beam.axial == "dynamic")

    def dissipated_power(self) -> Any:
        """Power of the Rayleigh damping in W."""
        U, Ud, _ = self.coordinates
        elastic = self._elasticity.dissipated(U, Ud, stretches=self.beam.axial == "dynamic")
        return Ud.dot(self.drag()) + elastic
