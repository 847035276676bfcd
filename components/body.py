"""Body: a rigid body with mass and inertia tensor."""

from __future__ import annotations

import numpy as np

from acausal import Matrix33, Scalar, Vector3, cross, dot, effect, geometry, outer, parameter, port, require
from components.frame import Frame, pose
from components.moving_body import MovingBody, point_gravity_requirements, point_gravity_validity
from components.orientation import resolve1, resolve2
from components.rigid import unusual_inertia, wrong_inertia
from components.world import World


class Body(MovingBody):
    """Rigid body with mass, centre of mass and inertia tensor; it moves freely unless joints guide it.

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
        doc="Resolved in frame_a. No principal moment may be negative; moments about axes without rotation may "
        "remain 0.",
    )
    gyroscopic: bool = effect(
        "gyroscopic torque w x I w",
        default=True,
        doc="False is valid if w stays along a principal axis, or if this torque is small compared with the others. "
        "Other motions then lack precession and do not conserve energy.",
    )
    world: World = outer(World)

    @port
    def frame_a(self) -> Frame:
        """Coordinate system fixed to the body."""
        return self.free_frame()

    def connections(self):
        yield self.free_root(self.frame_a)

    def equations(self):
        frame, w, z = self.frame_a, self.frame_a.R.w, self.frame_a.z
        g = resolve2(frame.R, self.world.acceleration(self._centre()))
        acceleration = frame.a + cross(z, self.r_CM) + cross(w, cross(w, self.r_CM))
        yield frame.f == self.m * (acceleration - g)
        turning = self.I @ z + cross(w, self.I @ w) if self.gyroscopic else self.I @ z
        yield frame.t == turning + cross(self.r_CM, frame.f)
        yield from self.motion(frame)

    def requirements(self):
        yield require(self.I, wrong_inertia)
        yield require(self.I, unusual_inertia, warning=True)
        yield from point_gravity_requirements(self, self.world, self._centre())

    def validity(self):
        yield from point_gravity_validity(self.world, self.m, self._centre(), self._velocity())

    def initial_equations(self):
        yield from self.free_start(self.frame_a)

    def stored_energy(self):
        """Kinetic and potential energy."""
        frame, w = self.frame_a, self.frame_a.R.w
        v = frame.v + cross(w, self.r_CM)
        return self.m * (dot(v, v) / 2 + self.world.gravity_potential(self._centre())) + dot(w, self.I @ w) / 2

    def supplied_power(self):
        """Power of gravity without a potential."""
        return self.world.power(self.m, self._centre(), self._velocity())

    def shapes(self):
        """A sphere at the centre of mass, and a link to it."""
        if not self.r_CM.sx.is_zero():
            yield geometry.Cylinder(pose(self.frame_a), (0, 0, 0), self.r_CM, style="link")
        yield geometry.Sphere(pose(self.frame_a), self.r_CM)

    def _centre(self):
        return self.frame_a.r_0 + resolve1(self.frame_a.R, self.r_CM)

    def _velocity(self):
        return self.v_0 + resolve1(self.frame_a.R, cross(self.w_a, self.r_CM))
