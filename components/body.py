"""Body: a rigid body with mass and inertia tensor."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import (
    Component,
    DeclarationError,
    Matrix33,
    Scalar,
    Vector3,
    apart,
    cross,
    dot,
    effect,
    guess,
    is_root,
    outer,
    parameter,
    port,
    potential_root,
    require,
    sqrt,
    structural,
    variable,
)
from components.frame import Frame
from components.orientation import axes_rotations, quaternion_of, resolve1, resolve2
from components.rigid import wrong_inertia
from components.world import World


class Body(Component):
    """Rigid body with mass, centre of mass and inertia; a body that nothing else guides moves freely.

    Notes
    -----
    f = m (a + z x r_CM + w x (w x r_CM) - g),  t = I z + w x I w + r_CM x f: Newton and Euler in body axes.
    """

    ends = ("frame_a", "")
    m: Scalar = parameter("mass", unit="kg", minimum=0)
    r_CM: Vector3 = parameter("centre of mass, resolved in frame_a", unit="m", default=(0, 0, 0))
    I: Matrix33 = parameter(
        "inertia tensor about the centre of mass",
        unit="kg.m2",
        default=np.zeros((3, 3)),
        doc="Resolved in frame_a. It must be physically possible, but moments about axes that the body does not "
        "turn about may be left 0.",
    )
    angles_start: Any = structural(
        "angles at the start",
        default=(0, 0, 0),
        shape=(3,),
        doc="In rad; the orientation of a freely moving body, a guess unless angles_fixed. Joints that hold the "
        "body have start values of their own.",
    )
    sequence_start: Any = structural("axes of these angles", default=(1, 2, 3), shape=(3,))
    angles_fixed: bool = structural("whether the angles hold at the start", default=False, choices=(True, False))
    gyroscopic: bool = effect(
        "gyroscopic torque w x I w",
        default=True,
        doc="False is valid where w stays along a principal axis, or where that torque is small compared with the "
        "others; in other motions energy is not conserved, as a turning body does not precess.",
    )
    world: World = outer(World)
    r_0: Vector3 = variable("position of frame_a, resolved in the world", unit="m")
    v_0: Vector3 = variable("der(r_0), resolved in the world", unit="m/s")
    a_0: Vector3 = variable("der(v_0), resolved in the world", unit="m/s2")
    w_a: Vector3 = variable("angular velocity, resolved in frame_a", unit="rad/s")
    z_a: Vector3 = variable("angular acceleration, resolved in frame_a", unit="rad/s2")

    @port
    def frame_a(self):
        """Coordinate system fixed to the body."""
        return Frame(Q=guess(self._orientation())) if np.any(self.angles_start) else Frame()

    def connections(self):
        # Of bodies that move together, the one whose orientation is given tells it.
        yield potential_root(self.frame_a, 0 if self.angles_fixed else 1 if np.any(self.angles_start) else 2)

    def equations(self):
        frame, w, z = self.frame_a, self.frame_a.R.w, self.frame_a.z
        g = resolve2(frame.R, self.world.acceleration(self._centre()))
        acceleration = frame.a + cross(z, self.r_CM) + cross(w, cross(w, self.r_CM))
        yield frame.f == self.m * (acceleration - g)
        turning = self.I @ z + cross(w, self.I @ w) if self.gyroscopic else self.I @ z
        yield frame.t == turning + cross(self.r_CM, frame.f)
        yield self.r_0 == frame.r_0
        yield self.v_0 == resolve1(frame.R, frame.v)
        yield self.a_0 == resolve1(frame.R, frame.a)
        yield self.w_a == w
        yield self.z_a == z

    def requirements(self):
        yield require(self.I, wrong_inertia)
        if self.world.gravity == "point":
            centre, name = self._centre(), self._path or type(self).__name__
            yield require(
                dot(centre, centre) > 0,
                f"{name} starts at the origin of the world, where gravity of a point is infinite; start it elsewhere, "
                "for instance r_0=fixed((7e6, 0, 0)), or take World(gravity=None)",
            )

    def validity(self):
        if self.world.gravity == "point":
            centre, velocity = self._centre(), self.v_0 + resolve1(self.frame_a.R, cross(self.w_a, self.r_CM))
            distance = sqrt(dot(centre, centre))
            yield apart(
                centre,
                dot(centre, velocity) / distance,
                self.m * self.world.mu / dot(centre, centre),
                "it reaches the origin of the world, where point gravity is infinite. End the run before that, stop_time=..., "
                "or let the body pass beside it: v_0=fixed(...) at right angles to the line to the origin",
            )

    def initial_equations(self):
        if is_root(self.frame_a):
            Q = self.frame_a.Q
            if self.angles_fixed:
                yield self._orientation() == Q
            else:
                yield Q @ Q == 1
        elif self.angles_fixed:
            raise DeclarationError(
                "angles_fixed=True has no effect here: the orientation follows from what the body is connected to. Leave it "
                "out, and fix the start there: phi=fixed(...) of a joint, angles_fixed=True of a Spherical or a free body."
            )

    def stored_energy(self):
        """Kinetic and potential energy."""
        frame, w = self.frame_a, self.frame_a.R.w
        v = frame.v + cross(w, self.r_CM)
        return self.m * (dot(v, v) / 2 + self.world.potential(self._centre())) + dot(w, self.I @ w) / 2

    def _orientation(self) -> Any:
        return quaternion_of(axes_rotations(self.sequence_start, self.angles_start))

    def _centre(self):
        return self.frame_a.r_0 + resolve1(self.frame_a.R, self.r_CM)
