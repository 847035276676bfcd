"""RollingWheelJoint: massless wheel rolling on the road without slip."""

from __future__ import annotations

from typing import Any

from acausal import (
    NEVER,
    Component,
    Expr,
    Scalar,
    Vector3,
    apart,
    as_expr,
    atan2,
    cos,
    cross,
    der,
    dot,
    expect,
    geometry,
    parameter,
    port,
    require,
    sin,
    sqrt,
    structural,
    variable,
)
from components.frame import Frame, pose

# Tensile road force over the largest compressive one: smaller values are integration errors.
HELD_DOWN = 1e-3


def wheel_angles(T: Any) -> Expr:
    """Angles of three successive rotations about z, y and x, each about the rotated axis.

    Of the two solutions, the third angle is within 90 degrees: for an upright wheel, the first angle is the heading, the
    second the rolling angle, and the third is 0.
    """
    about_x = atan2(T[1, 2] * T[2, 2], T[2, 2] * T[2, 2])
    s, c = sin(about_x), cos(about_x)
    e_y = c * T[1] - s * T[2]  # the axes y and z before the third rotation, resolved in the world
    e_z = s * T[1] + c * T[2]
    return as_expr((atan2(-e_y[0], e_y[1]), atan2(-T[0, 2], e_z[2]), about_x))


class RollingWheelJoint(Component):
    """Massless wheel rolling on the plane z = 0 of the world without slip.

    Notes
    -----
    With the normal u of the road and the axis e of the wheel, l = u x e / |u x e| lies in both planes. The contact point is
    radius (e x l) from the centre; its velocity is 0 along l and along s = l x u (two nonholonomic constraints). No branch:
    the body of the wheel moves freely, or joints guide it. The contact is bilateral: a tensile road force gives a warning.
    """

    ends = ("frame_a", "frame_a")
    radius: Scalar = parameter("radius of the wheel", unit="m", positive=True)
    carries: bool = structural(
        "whether the road carries the wheel",
        default=True,
        choices=(True, False),
        doc="False if other parts keep the wheel upright, with its centre at the height of its radius.",
    )
    guides: bool = structural(
        "whether the road guides the wheel sideways",
        default=True,
        choices=(True, False),
        doc="False for the second wheel of an axle.",
    )
    frame_a: Frame = port(Frame, "centre of the wheel, with y along its axis")
    x: Scalar = variable("x-coordinate of the centre, resolved in the world", unit="m")
    y: Scalar = variable("y-coordinate of the centre, resolved in the world", unit="m")
    angles: Vector3 = variable(
        "angles from the world to frame_a about z, y and x, each about the rotated axis; that about x within 90 degrees",
        unit="rad",
        select=NEVER,
    )
    der_angles: Vector3 = variable("der(angles)", unit="rad/s", select=NEVER)
    f_n: Scalar = variable("force of the road on the wheel, upwards", unit="N")
    f_lat: Scalar = variable("force of the road on the wheel along s, to the left", unit="N")
    f_long: Scalar = variable("force of the road on the wheel along l, backwards", unit="N")

    def equations(self):
        a = self.frame_a
        u, l, s, r = self.contact()
        slip, force = a.v + cross(a.R.w, r), u * self.f_n + s * self.f_lat + l * self.f_long
        yield self.x == a.r_0[0]
        yield self.y == a.r_0[1]
        yield self.angles == wheel_angles(a.R.T)
        yield self.der_angles == der(self.angles)
        yield dot(l, slip) == 0
        yield dot(s, slip) == 0 if self.guides else self.f_lat == 0
        yield a.r_0[2] + dot(u, r) == 0 if self.carries else self.f_n == 0
        yield a.f == -force
        yield a.t == -cross(r, force)

    def contact(self) -> tuple[Expr, Expr, Expr, Expr]:
        """Directions u, l and s, and the position of the point of contact from the centre, resolved in frame_a."""
        u, upright = self.frame_a.R.T[:, 2], self._cos_camber()
        l = as_expr((-u[2], 0, u[0])) / upright
        return u, l, cross(l, u), as_expr((-u[0], 0, -u[2])) / upright * self.radius

    def requirements(self):
        name = self._path or type(self).__name__
        yield require(
            self._cos_camber() > 0.02,
            f"{name} lies flat at the start, where its rim has no lowest point; start it upright, for instance "
            "angles=fixed((0, 0, 0)), with y of its frame along the axis of the wheel, and z of the world upwards",
        )

    def validity(self):
        u, w = self.frame_a.R.T[:, 2], self.frame_a.R.w
        yield apart(
            as_expr((u[0], u[2])),
            u[1] * (w[2] * u[0] - w[0] * u[2]) / self._cos_camber(),
            self.f_n,
            "the wheel falls flat, where its rim has no lowest point. End the run before that, stop_time=..., or start at a "
            "higher speed",
        )
        yield expect(
            (abs(self.f_n) - self.f_n) / 2,
            self.f_n,
            HELD_DOWN,
            "the wheel would lift off, but the bilateral contact pulls it down. Use a tyre, or a unilateral contact",
        )

    def shapes(self):
        """The wheel, with a width of a quarter of its radius."""
        half = self.radius / 8
        yield geometry.Cylinder(pose(self.frame_a), (0, -half, 0), (0, half, 0), 2 * self.radius, "wheel")

    def _cos_camber(self) -> Expr:
        """|u x e|, the cosine of the camber angle."""
        u = self.frame_a.R.T[:, 2]
        return sqrt(u[0] * u[0] + u[2] * u[2])
