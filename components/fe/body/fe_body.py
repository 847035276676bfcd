"""FEBody: a solid body from any FE program, reduced to modes, in a floating frame of reference."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import (
    PREFER,
    DeclarationError,
    Scalar,
    as_expr,
    branch,
    connected,
    cross,
    der,
    dot,
    effect,
    geometry,
    initial,
    is_root,
    outer,
    parameter,
    port,
    ports,
    quantity,
    soft,
    sqrt,
    structural,
    variable,
)
from components.fe.body.free_body import check_free
from components.fe.body.modal_inertia import ModalInertia
from components.fe.body.modal_properties import critical_damping, nominal, with_modes
from components.fe.body.reconfigured_inertia import ReconfiguredInertia
from components.fe.body.skin import box_of_inertia, mesh
from components.fe.body.validity_range import Moments, spinning, welded
from components.fe.reduction.interface import Interface
from components.fe.reduction.reduced_body import ReducedBody
from components.frame import Frame, move, pose
from components.moving_body import MovingBody, point_gravity_requirements, point_gravity_validity
from components.orientation import (
    absolute_rotation,
    fixed_rotation,
    null_rotation,
    resolve1,
    resolve2,
    rodrigues_rate,
    rodrigues_rotation,
)
from components.world import World


class FEBody(MovingBody):
    """Flexible body with modal deformation in a floating reference frame; its frames are named after the interfaces.

    Notes
    -----
    Vlasenko, Kasper, Generation of equations of motion in reference frame formulation for FE models (2008), in the axes
    of the reference frame: see `ModalInertia`. With the displacement U and the small rotation vector theta of a frame,
    the frame is at X + U(q), rotated by `rodrigues_rotation(theta(q))`, and its force f and torque t give the modal
    force U_q' f + theta_q' G' t. Deformations are small, without geometric stiffening, so the angular velocity must
    stay well below the first frequency. An interface to which the reference frame is fixed is that frame, without
    equations.
    """

    ends = ("frame_a", "frame_b")
    without_soft = 'initial="free"'
    reduced: Any = structural(
        "reduced body", cls=ReducedBody, doc="Result of `reduce_body`, or the .npz file to which it was saved."
    )
    modes: int = structural(
        "number of modes",
        default=lambda s: s.reduced.n,
        cls=int,
        minimum=0,
        maximum=lambda s: s.reduced.n,
        refine=lambda s: s.adaptive,
        doc="The first modes of the body, by default all; with 0 the body is rigid.",
    )
    adaptive: bool = structural(
        "whether accuracy chooses the number of modes",
        default=False,
        choices=(True, False),
        doc="If True, simulate(accuracy=...) chooses the number.",
    )
    stiffness: Scalar = parameter("factor of the stiffness", unit="1", default=1, positive=True)
    damping_ratio: Scalar = parameter(
        "damping ratio of every mode",
        unit="1",
        default=0,
        minimum=0,
        doc="Added to the damping of the reduced body.",
    )
    initial: str = structural(
        "state at the start",
        default="undeformed",
        choices=("undeformed", "static", "free"),
        doc="undeformed: q = 0 and der(q) = 0; static: der(q) = 0 and der(der(q)) = 0; free: no condition. A steady-state "
        "start, with the flag `initial` at 0, replaces q = 0 by equilibrium.",
    )
    check_range: bool = structural(
        "whether a run warns outside the range of a linear body",
        default=True,
        choices=(True, False),
        doc="False suppresses the warnings of fast rotation and of welded frames that average their nodes.",
    )
    inertia: str = effect(
        "inertia of the deformed body",
        default="second_order",
        choices=("second_order", "first_order", "constant", "reconfigured"),
        tries=("second_order", "first_order", "constant"),
        doc="second_order: all terms of the displacements, if the body has their integrals; first_order: mass matrix to first "
        "order in q; constant: that of the undeformed body, which does not conserve energy; reconfigured: the limit of short "
        "steps in reconfigured inertial frames, for a free body with mean axes, which does not conserve energy either.",
    )
    centrifugal: bool = effect(
        "centrifugal forces of the deformation",
        default=True,
        doc="The terms in the square of the angular velocity that depend on the deformation; those of the undeformed body are "
        "always included.",
    )
    coriolis: bool = effect(
        "Coriolis forces of the deformation rates",
        default=True,
        doc="The terms in the product of angular velocity and deformation rate.",
    )
    damping: bool = effect("damping of the modes", default=True)
    weight: bool = effect("weight", default=True)
    world: World = outer(World)
    q: Any = variable(
        "modal coordinates, with modal masses in kg",
        shape=lambda s: (s.modes,),
        unit="m",
        select=PREFER,
        nominal=lambda s: nominal(s._body)[0],
    )
    qd: Any = variable(
        "der(q)", shape=lambda s: (s.modes,), unit="m/s", select=PREFER, nominal=lambda s: nominal(s._body)[1]
    )
    qdd: Any = variable("der(qd)", shape=lambda s: (s.modes,), unit="m/s2")
    # Separate unknowns: otherwise the Jacobian of the modal forces would couple every mode with every other one.
    frame_force: Any = variable(
        "forces on the frames, resolved in the reference frame", shape=lambda s: (len(s._moving), 3), unit="N"
    )
    frame_torque: Any = variable(
        "torques on the frames, conjugate to their rotation vectors", shape=lambda s: (len(s._moving), 3), unit="N.m"
    )

    @port
    def ref(self) -> Frame | None:
        """Reference frame, if it is not an interface."""
        return None if self._held else self.free_frame()

    @ports
    def frames(self) -> dict[str, Frame]:
        """Frames of the interfaces by name."""
        return {i.name: self.free_frame() if i is self._held else Frame() for i in self._body.interfaces}

    @property
    def reference(self) -> Any:
        """The reference frame."""
        return self.frames[self._held.name] if self._held else self.ref

    def connections(self):
        yield self.free_root(self.reference)
        for _, frame in self._moving:
            yield branch(self.reference, frame)

    def equations(self):
        ref, inertia = self.reference, self._inertia
        if self._in_steps:
            if not is_root(ref):
                raise DeclarationError(
                    'inertia="reconfigured" needs a free body, but the connections constrain this one. Do this: use '
                    '"second_order", "first_order" or "constant", or connect the body by forces only'
                )
            check_free(self._body, 'inertia="reconfigured" needs')
        gravity = self.world.acceleration(self._centre()) if self.weight else np.zeros(3)
        force, moment, modal = inertia.forces(ref.a - resolve2(ref.R, gravity), ref.z, ref.R.w)
        f, t, load = ref.f, ref.t, as_expr(np.zeros(self.modes))
        for k, (interface, frame) in enumerate(self._moving):
            r, theta = quantity(interface.place, "m") + interface.displacement @ self.q, interface.rotation @ self.q
            R, G = null_rotation(), np.eye(3)
            if np.any(interface.rotation):
                R, G = rodrigues_rotation(theta), rodrigues_rate(theta)
            if interface.turned:
                R, G = absolute_rotation(R, fixed_rotation(interface.axes)), interface.axes @ G
            yield from move(ref, frame, r, R)
            f_k, t_k = self.frame_force[k], self.frame_torque[k]
            yield f_k == resolve1(R, frame.f)
            yield t_k == (resolve1(R, frame.t) if self._in_steps else G.T @ frame.t)
            arm = quantity(interface.place, "m") if self._in_steps else r
            f, t = f + f_k, t + resolve1(R, frame.t) + cross(arm, f_k)
            load += interface.displacement.T @ f_k + interface.rotation.T @ t_k
        yield force == f
        yield moment == t
        if self.modes:
            yield from (self.qd == der(self.q), self.qdd == der(self.qd))
            yield modal + self._elastic() + self._drag() == load
        yield from self.motion(ref)

    def initial_equations(self):
        yield from self.free_start(self.reference)
        if self.initial != "free" and self.modes:
            for q in (self.qd, self.q * initial if self.initial == "undeformed" else self.qdd):
                yield soft(q == as_expr(np.zeros(self.modes)))

    def requirements(self):
        yield from point_gravity_requirements(self, self.world, self._centre())
        yield from (Moments(self._body).none(interface, frame) for interface, frame in self._points)

    def validity(self):
        yield from point_gravity_validity(self.world, self._inertia.mass, self._centre(), self._velocity())
        yield from (Moments(self._body).stays_none(interface, frame) for interface, frame in self._points)
        if self.check_range:
            if np.any(self._body.frequencies > 0):
                yield spinning(self._body, self.reference.R.w, self.stiffness)
            for interface, frame in ((i, self.frames[i.name]) for i in self._body.interfaces if i.averages):
                if any(isinstance(other, FEBody) for other in connected(frame)):
                    yield welded(interface, frame)

    def stored_energy(self):
        """Kinetic, elastic and potential energy."""
        kinetic = self._inertia.kinetic_energy(self.reference.v, self.reference.R.w)
        potential = self._inertia.mass * self.world.gravity_potential(self._centre()) if self.weight else 0.0
        return kinetic + potential + dot(self.q, self._elastic()) / 2

    def dissipated_power(self):
        """Power of the damping of the modes."""
        return dot(self._rates(), self._drag())

    def shapes(self):
        """Surface of the mesh, or without a mesh the box of equal inertia and the frames."""
        at = pose(self.reference)
        if found := mesh(self.reduced.nodal, at, self.q):  # the cached `_body` may be an equal body without nodes
            yield found
        else:
            yield from (box_of_inertia(self._body, at), *(geometry.Sphere(pose(f)) for f in self.frames.values()))

    @property
    def _body(self) -> ReducedBody:
        return with_modes(self.reduced, self.modes)

    @property
    def _held(self) -> Interface | None:
        """Interface that coincides with the reference frame, axes included."""
        return next((i for i in self._body.interfaces if i.still and not i.turned), None)

    @property
    def _moving(self) -> list[tuple[Interface, Any]]:
        """Interfaces other than the reference frame, with their frames."""
        return [(i, self.frames[i.name]) for i in self._body.interfaces if i is not self._held]

    @property
    def _points(self) -> list[tuple[Interface, Any]]:
        """Interfaces that do not define all rotations, with their frames."""
        return [(i, self.frames[i.name]) for i in self._body.interfaces if not i.turns]

    @property
    def _inertia(self) -> ModalInertia:
        motion = self.q, self.qd, self.qdd
        if self._in_steps:
            return ReconfiguredInertia(self._body, *motion, centrifugal=self.centrifugal, coriolis=self.coriolis)
        return ModalInertia(self._body, *motion, self.inertia, self.centrifugal, self.coriolis)

    @property
    def _in_steps(self) -> bool:
        """True if the inertia is that of short steps in inertial frames."""
        return self.inertia == "reconfigured"

    def _elastic(self) -> Any:
        return self.stiffness * (self._body.K @ self.q)

    def _drag(self) -> Any:
        if not self.damping:
            return as_expr(np.zeros(self.modes))
        rates, critical = self._rates(), self.damping_ratio * sqrt(self.stiffness)
        return self._body.D @ rates + critical * (critical_damping(self._body) @ rates)

    def _rates(self) -> Any:
        """Modal rates on which damping acts."""
        return self._inertia.rates(self.reference.R.w)

    def _centre(self) -> Any:
        return self.reference.r_0 + resolve1(self.reference.R, self._inertia.first() / self._inertia.mass)

    def _velocity(self) -> Any:
        """Velocity of the centre of mass, resolved in the world."""
        ref, inertia = self.reference, self._inertia
        moved = cross(ref.R.w, inertia.first()) + inertia.relative_momentum()
        return resolve1(ref.R, ref.v + moved / inertia.mass)
