"""PointMass: body without rotational inertia."""

from __future__ import annotations

from acausal import Component, Scalar, Vector3, dot, geometry, is_root, outer, parameter, port, potential_root, variable
from components.frame import Frame, pose
from components.moving_body import point_gravity_requirements, point_gravity_validity
from components.orientation import resolve1, resolve2
from components.world import World

LAST = 10  # priority as a root: any other potential root determines the orientation first


class PointMass(Component):
    """Mass at the origin of frame_a, whose axes are those of the world unless other parts determine its orientation.

    Notes
    -----
    f = m (a - g),  t = 0.
    """

    ends = ("frame_a", "")
    m: Scalar = parameter("mass", unit="kg", minimum=0)
    world: World = outer(World)
    frame_a: Frame = port(Frame(turns=False), "coordinate system at the mass")
    r_0: Vector3 = variable("position of the mass, resolved in the world", unit="m")
    v_0: Vector3 = variable("der(r_0), resolved in the world", unit="m/s")
    a_0: Vector3 = variable("der(v_0), resolved in the world", unit="m/s2")

    def connections(self):
        yield potential_root(self.frame_a, LAST)

    def equations(self):
        frame = self.frame_a
        yield frame.f == self.m * (frame.a - resolve2(frame.R, self.world.acceleration(frame.r_0)))
        if not is_root(frame):
            yield frame.t == (0, 0, 0)
        yield self.r_0 == frame.r_0
        yield self.v_0 == resolve1(frame.R, frame.v)
        yield self.a_0 == resolve1(frame.R, frame.a)

    def requirements(self):
        yield from point_gravity_requirements(self, self.world, self.frame_a.r_0)

    def validity(self):
        yield from point_gravity_validity(self.world, self.m, self.frame_a.r_0, self.v_0)

    def stored_energy(self):
        """Kinetic and potential energy."""
        v = self.frame_a.v
        return self.m * (dot(v, v) / 2 + self.world.gravity_potential(self.frame_a.r_0))

    def supplied_power(self):
        """Power of gravity without a potential."""
        return self.world.power(self.m, self.frame_a.r_0, self.v_0)

    def shapes(self):
        """A sphere."""
        yield geometry.Sphere(pose(self.frame_a))
