"""FEBody: a body reduced from the matrices of an FE program, in a floating frame."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from acausal import (
    PREFER,
    Scalar,
    as_expr,
    branch,
    cross,
    der,
    dot,
    effect,
    expect,
    initial,
    outer,
    parameter,
    parts,
    port,
    quantity,
    sqrt,
    structural,
    variable,
)
from components.fe.modal_inertia import ModalInertia
from components.fe.reduced_body import Interface, ReducedBody
from components.frame import Frame, move
from components.moving_body import MovingBody
from components.orientation import null_rotation, resolve1, resolve2, rodrigues_rate, rodrigues_rotation
from components.world import World


class FEBody(MovingBody):
    """Body that deforms by a combination of modes, small against it, in a reference frame that moves freely.

    Notes
    -----
    Vlasenko, Kasper, Generation of equations of motion in reference frame formulation for FE models (2008), in the axes of
    the reference frame; see `ModalInertia`. There is no geometric stiffening.
    """

    reduced: Any = structural("the body, or the .npz file in which it is")
    modes: int = structural("number of modes", default=lambda s: loaded(s.reduced).n, minimum=0)
    stiffness: Scalar = parameter("factor of the stiffness", unit="1", default=1, positive=True)
    damping_ratio: Scalar = parameter("damping ratio of all modes", unit="1", default=0, minimum=0)
    initial: str = structural(
        "state at the start",
        default="undeformed",
        choices=("undeformed", "static", "free"),
    )
    inertia: str = effect(
        "inertia of the deformed body",
        default="second_order",
        choices=("second_order", "first_order", "constant"),
    )
    centrifugal: bool = effect("centrifugal forces of the deformation", default=True)
    coriolis: bool = effect("Coriolis forces of the rates of deformation", default=True)
    damping: bool = effect("damping", default=True)
    weight: bool = effect("weight", default=True)
    world: World = outer(World)
    q: Any = variable("amplitudes of the modes", shape=lambda s: (s.modes,), unit="m", select=PREFER)
    qd: Any = variable("der(q)", shape=lambda s: (s.modes,), unit="m/s", select=PREFER)
    qdd: Any = variable("der(qd)", shape=lambda s: (s.modes,), unit="m/s2")
    force: Any = variable("forces at the frames", shape=lambda s: (3*len(s._body.interfaces), ), unit="N")
    torque: Any = variable("torque at the frames", shape=lambda s: (3*len(s._body.interfaces), ), unit="N.m")

    @port
    def floating(self):
        """Reference frame."""
        return self.free_frame()

    @parts
    def frames(self):
        return [Frame() for _ in self._body.interfaces]

    @property
    def _body(self) -> ReducedBody:
        return loaded(self.reduced).first(self.modes)

    @property
    def ref(self):
        return self.floating

    def connections(self):
        yield self.free_root(self.ref)
        for frame in self.frames:
            yield branch(self.ref, frame)

    def equations(self):
        if self.modes:
            yield from (self.qd == der(self.q), self.qdd == der(self.qd))
        ref, body, inertia = self.ref, self._body, self._inertia
        gravity = self.world.acceleration(self._centre()) if self.weight else np.zeros(3)
        force, moment, modal = inertia.forces(ref.a - resolve2(ref.R, gravity), ref.z, ref.R.w)
        f, t, load = ref.f, ref.t, as_expr(np.zeros(self.modes))
        for k, (interface, frame) in enumerate(zip(body.interfaces, self.frames, strict=True)):
            r = quantity(interface.place, "m") + interface.displacement @ self.q
            theta = interface.rotation @ self.q
            R = rodrigues_rotation(theta) if np.any(interface.rotation) else null_rotation()
            yield from move(ref, frame, r, R)
            f_i, t_i = resolve1(R, frame.f), resolve1(R, frame.t)
            f, t = f + f_i, t + t_i + cross(r, f_i)
            F,M = (x[3*k:3*k+3] for x in (self.force, self.torque))
            yield F == f_i
            yield M == rodrigues_rate(theta).T @ frame.t
            load += interface.displacement.T @ F + interface.rotation.T @ M
        yield force == f
        yield moment == t
        if self.modes:
            yield modal + self._elastic() + self._drag() == load
        yield from self.motion(ref)

    def initial_equations(self):
        yield from self.free_start(self.ref)
        if self.initial != "free" and self.modes:
            for q in (self.qd, self.q * initial if self.initial == "undeformed" else self.qdd):
                yield q == as_expr(np.zeros(self.modes))

    @property
    def _inertia(self) -> ModalInertia:
        motion = self.q, self.qd, self.qdd
        return ModalInertia(self._body, *motion, self.inertia, self.centrifugal, self.coriolis)

    def _elastic(self):
        return self.stiffness * (self._body.K @ self.q)

    def _drag(self):
        if not self.damping:
            return as_expr(np.zeros(self.modes))
        return (self._body.D + 0 ) @ self.qd

    def _centre(self):
        return self.ref.r_0 + resolve1(self.ref.R, self._inertia.first() / self._body.mass)

    def stored_energy(self):
        """Kinetic, elastic and potential energy."""
        potential = self._body.mass * self.world.potential(self._centre()) if self.weight else 0.0
        kinetic = self._inertia.kinetic_energy(self.ref.v, self.ref.R.w)
        return kinetic + potential + dot(self.q, self._elastic()) / 2

    def dissipated_power(self):
        return dot(self.qd, self._drag())


@lru_cache(maxsize=16)
def _read(path: str, changed: int, size: int) -> ReducedBody:
    return ReducedBody.load(path)


def loaded(given: Any) -> ReducedBody:
    """Return a reduced body, read from its file if it is one; a file that did not change is read once."""
    if isinstance(given, ReducedBody):
        return given
    return _read(str(given), 0, 0)
