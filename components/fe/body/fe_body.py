"""FEBody: a solid body of any FE program, reduced to modes, in a floating frame."""

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
from components.moving_body import MovingBody, off_centre, past_centre
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
    """Body that deforms in a few modes, in a reference frame that moves freely; its frames have the names of its interfaces.

    Notes
    -----
    Vlasenko, Kasper, Generation of equations of motion in reference frame formulation for FE models (2008), in the axes of
    the reference frame: see `ModalInertia`. With U the displacement and theta the small rotation vector of a frame, the
    frame is at X + U(q), turned by `rodrigues_rotation(theta(q))`, and its force f and torque t do the work of
    U_q' f + theta_q' G' t on q. Deformations are small, and there is no geometric stiffening: the body may turn slowly against
    its first frequency only. A frame that the reference frame holds is that frame, without equations of its own.
    """

    ends = ("frame_a", "frame_b")
    without_soft = 'initial="free"'
    reduced: Any = structural(
        "the body", cls=ReducedBody, doc="What `reduce_body` returns, or the .npz file to which it was saved."
    )
    modes: int = structural(
        "number of modes",
        default=lambda s: s.reduced.n,
        cls=int,
        minimum=0,
        maximum=lambda s: s.reduced.n,
        refine=lambda s: s.adaptive,
        doc="The first ones of the body are taken, all if not given; 0 leaves a rigid body.",
    )
    adaptive: bool = structural(
        "whether accuracy chooses the number of modes",
        default=False,
        choices=(True, False),
        doc="simulate(accuracy=...) then chooses it.",
    )
    stiffness: Scalar = parameter("factor of the stiffness", unit="1", default=1, positive=True)
    damping_ratio: Scalar = parameter(
        "damping of every mode, as a part of the critical one",
        unit="1",
        default=0,
        minimum=0,
        doc="It comes on top of the damping that the reduced body has.",
    )
    initial: str = structural(
        "state at the start",
        default="undeformed",
        choices=("undeformed", "static", "free"),
        doc="undeformed: q = 0 and der(q) = 0; static: der(q) = 0 and der(der(q)) = 0; free: nothing. A start "
        "in steady state, where the flag `initial` is 0, takes the shape of rest instead of q = 0.",
    )
    check_range: bool = structural(
        "whether a run warns where a linear body is not valid",
        default=True,
        choices=(True, False),
        doc="False suppresses the warnings that the body turns too fast, and that it is welded by the average of its nodes.",
    )
    inertia: str = effect(
        "inertia of the deformed body",
        default="second_order",
        choices=("second_order", "first_order", "constant", "reconfigured"),
        tries=("second_order", "first_order", "constant"),
        doc="second_order: all that the displacements imply, as far as the body knows it; first_order: mass matrix to first "
        "order in q; constant: that of the undeformed body, in which energy is not conserved; reconfigured: the limit of short "
        "steps in reconfigured inertial frames, of a body with mean axes that nothing guides, in which energy is not conserved "
        "either.",
    )
    centrifugal: bool = effect(
        "centrifugal forces of the deformation",
        default=True,
        doc="They act on the deformation and because of it, with the square of the angular velocity; those of the undeformed "
        "body always act.",
    )
    coriolis: bool = effect(
        "Coriolis forces of the rates of deformation",
        default=True,
        doc="They go with the product of angular velocity and rate of deformation.",
    )
    damping: bool = effect("damping of the modes", default=True)
    weight: bool = effect("weight", default=True)
    world: World = outer(World)
    q: Any = variable(
        "amplitudes of the modes, which have a modal mass in kg",
        shape=lambda s: (s.modes,),
        unit="m",
        select=PREFER,
        nominal=lambda s: nominal(s._body)[0],
    )
    qd: Any = variable(
        "der(q)", shape=lambda s: (s.modes,), unit="m/s", select=PREFER, nominal=lambda s: nominal(s._body)[1]
    )
    qdd: Any = variable("der(qd)", shape=lambda s: (s.modes,), unit="m/s2")
    # Unknowns of their own, as otherwise every mode would meet every other one in the derivatives of their power.
    frame_force: Any = variable(
        "forces on the frames, resolved in the reference frame", shape=lambda s: (len(s._moving), 3), unit="N"
    )
    frame_torque: Any = variable(
        "torques on the frames, conjugate to their rotation vectors", shape=lambda s: (len(s._moving), 3), unit="N.m"
    )

    @port
    def ref(self) -> Frame | None:
        """Reference frame, where no interface is it."""
        return None if self._held else self.free_frame()

    @ports
    def frames(self) -> dict[str, Frame]:
        """Frames of the interfaces, by their names."""
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
                    'inertia="reconfigured" is of a body that nothing guides, and this one is held by what it is connected '
                    'to: take "second_order", "first_order" or "constant", or connect it by forces alone'
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
        yield from off_centre(self, self.world, self._centre())
        yield from (Moments(self._body).none(interface, frame) for interface, frame in self._points)

    def validity(self):
        yield from past_centre(self.world, self._inertia.mass, self._centre(), self._velocity())
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
        """The skin of its mesh, or the box of its inertia and its frames where it knows no mesh."""
        at = pose(self.reference)
        if found := mesh(self.reduced.nodal, at, self.q):  # `_body` may be an equal one without nodes
            yield found
        else:
            yield from (box_of_inertia(self._body, at), *(geometry.Sphere(pose(f)) for f in self.frames.values()))

    @property
    def _body(self) -> ReducedBody:
        return with_modes(self.reduced, self.modes)

    @property
    def _held(self) -> Interface | None:
        """The interface that is the reference frame, and has its axes."""
        return next((i for i in self._body.interfaces if i.still and not i.turned), None)

    @property
    def _moving(self) -> list[tuple[Interface, Any]]:
        """Interfaces beside the reference frame, and their frames."""
        return [(i, self.frames[i.name]) for i in self._body.interfaces if i is not self._held]

    @property
    def _points(self) -> list[tuple[Interface, Any]]:
        """Interfaces that hold not every rotation, and their frames."""
        return [(i, self.frames[i.name]) for i in self._body.interfaces if not i.turns]

    @property
    def _inertia(self) -> ModalInertia:
        motion = self.q, self.qd, self.qdd
        if self._in_steps:
            return ReconfiguredInertia(self._body, *motion, centrifugal=self.centrifugal, coriolis=self.coriolis)
        return ModalInertia(self._body, *motion, self.inertia, self.centrifugal, self.coriolis)

    @property
    def _in_steps(self) -> bool:
        """Whether the body moves as by short steps in inertial frames."""
        return self.inertia == "reconfigured"

    def _elastic(self) -> Any:
        return self.stiffness * (self._body.K @ self.q)

    def _drag(self) -> Any:
        if not self.damping:
            return as_expr(np.zeros(self.modes))
        rates, critical = self._rates(), self.damping_ratio * sqrt(self.stiffness)
        return self._body.D @ rates + critical * (critical_damping(self._body) @ rates)

    def _rates(self) -> Any:
        """Rates of the modes that damping resists."""
        return self._inertia.rates(self.reference.R.w)

    def _centre(self) -> Any:
        return self.reference.r_0 + resolve1(self.reference.R, self._inertia.first() / self._inertia.mass)

    def _velocity(self) -> Any:
        """Velocity of the centre of mass, resolved in the world."""
        ref, inertia = self.reference, self._inertia
        moved = cross(ref.R.w, inertia.first()) + inertia.relative_momentum()
        return resolve1(ref.R, ref.v + moved / inertia.mass)
