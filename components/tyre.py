"""Tyre: contact of a wheel with the ground, with slip and relaxation."""

from __future__ import annotations

from typing import Any

from acausal import (
    DeclarationError,
    Expr,
    Scalar,
    Vector3,
    as_expr,
    cross,
    der,
    dot,
    geometry,
    parameter,
    port,
    quantity,
    require,
    sqrt,
    structural,
    variable,
)
from components.flange import Flange
from components.frame import Frame, pose
from components.gradient import gradient
from components.orientation import parallel, resolve1, resolve2, two_axes_rotation, unit_vector
from components.thermal.heat_loss import HeatLoss
from components.world import require_direction

# Sliding speed in m/s that regularises the friction of an unloaded tyre, whose force would be 0 / 0 in the air: far below the
# creep speed at standstill.
V_SMALL = 1e-7
# Cosine of 60 degrees, the limit of the angle between wheel plane and ground normal: a tyre does not roll on its sidewall.
UPRIGHT = 0.5


class Tyre(HeatLoss):
    """Tyre on flat or uneven ground: radial spring and damper, slip forces within the friction ellipse.

    Notes
    -----
    All forces act at the contact point, the point of the ground in the wheel plane closest to the wheel centre, with the
    ground normal e_z, the rolling direction e_x = e_z x n / |e_z x n|, and e_y = e_z x e_x. The radial force in the wheel plane
    is f_z |e_z x n| = c_z delta + d_z der(delta), delta = R_0 - radius, with the damper limited to the spring, so that the tyre
    is never adhesive.

    A carcass (c_x = c_kappa / sigma_x, d_x) is in series with a contact patch of sliding velocity s [1, 7.2; 2, 3.4]:
    f_x = c_x u_x + d_x der(u_x), s_x = v_x + der(u_x), likewise for y, and with theoretical slips s / v_t [1, 4.3]

    (f_x, f_y) = -mu f_z (c_kappa s_x, c_alpha s_y) / sqrt((mu f_z v_t)^2 + (c_kappa s_x)^2 + (c_alpha s_y)^2),

    v_t^2 = (radius w)^2 + v_low^2. Small slip gives f_x = -c_kappa s_x / v_t with the relaxation length sigma_x; the force
    never exceeds mu f_z. At standstill the wheel creeps at v_low f / c_kappa. Camber thrust, pneumatic trail and rolling
    resistance are neglected. The radius of curvature of the ground must exceed that of the wheel.

    References
    ----------
    .. [1] H. B. Pacejka, Tyre and Vehicle Dynamics, 2nd ed., Elsevier, 2006.
    .. [2] G. Rill, Road Vehicle Dynamics, CRC Press, 2011.
    """

    ends = ("frame_a", "")
    n: Any = structural(
        "axis of the wheel, resolved in frame_a", default=(0, 0, 1), shape=(3,), doc="Any nonzero length."
    )
    up: Any = structural(
        "direction of the height of the ground, resolved in the world",
        default=(0, 1, 0),
        shape=(3,),
        doc="Not horizontal.",
    )
    n_x: Any = structural(
        "direction of x on the ground, resolved in the world",
        default=(1, 0, 0),
        shape=(3,),
        doc="Its component normal to up is used; y is along up x n_x.",
    )
    use_axis_flange: bool = structural(
        "whether the wheel rotates relative to frame_a",
        default=False,
        choices=(True, False),
        doc="True adds the shaft `axis`, to be connected to a Rotor1D, with frame_a fixed to the upright: at constant speed no "
        "variable then oscillates with the wheel rotation.",
    )
    height: Any = structural(
        "height of the ground in m as a function of the position",
        default=None,
        choices=(None, callable),
        doc="height(x, y) along up, from the origin of the world; smooth. None is the plane through the origin.",
    )
    R_0: Scalar = parameter("radius of the unloaded tyre", unit="m", positive=True)
    c_z: Scalar = parameter("radial stiffness", unit="N/m", positive=True)
    d_z: Scalar = parameter("radial damping constant", unit="N.s/m", positive=True)
    c_kappa: Scalar = parameter("longitudinal slip stiffness", unit="N", positive=True)
    c_alpha: Scalar = parameter("cornering stiffness", unit="N/rad", positive=True)
    mu: Scalar = parameter("coefficient of friction", unit="1", default=1, positive=True)
    sigma_x: Scalar = parameter("longitudinal relaxation length", unit="m", default=0.2, positive=True)
    sigma_y: Scalar = parameter("lateral relaxation length", unit="m", default=0.4, positive=True)
    d_x: Scalar = parameter(
        "longitudinal damping constant of the carcass",
        unit="N.s/m",
        default=lambda s: s.d_z / s.c_z * s.c_kappa / s.sigma_x,
        positive=True,
        doc="Default: the time constant d_z / c_z.",
    )
    d_y: Scalar = parameter(
        "lateral damping constant of the carcass",
        unit="N.s/m",
        default=lambda s: s.d_z / s.c_z * s.c_alpha / s.sigma_y,
        positive=True,
        doc="Default: the time constant d_z / c_z.",
    )
    v_low: Scalar = parameter(
        "rolling speed below which slip changes to creep", unit="m/s", default=0.05, positive=True
    )
    frame_a: Frame = port(Frame, "at the centre of the wheel, fixed to it or, with a shaft, to the upright")
    x: Scalar = variable("position of the contact point along n_x", unit="m")
    y: Scalar = variable("position of the contact point along up x n_x", unit="m")
    radius: Scalar = variable("distance of the contact point from the centre", unit="m")
    deflection: Scalar = variable("R_0 - radius, positive in contact", unit="m")
    e_z: Vector3 = variable("normal of the ground, resolved in the world", unit="1", start=up)
    arm: Vector3 = variable("from the centre to the contact point, resolved in the world", unit="m")
    v_x: Scalar = variable("velocity of the wheel at the contact point along e_x", unit="m/s")
    v_y: Scalar = variable("velocity of the wheel at the contact point along e_y", unit="m/s")
    v_z: Scalar = variable("-der(deflection)", unit="m/s")
    v_t: Scalar = variable("speed of the tread through the contact, at least v_low", unit="m/s")
    u_x: Scalar = variable("deflection of the carcass along e_x", unit="m", start=0, fixed=True, nominal=1e-2)
    u_y: Scalar = variable("deflection of the carcass along e_y", unit="m", start=0, fixed=True, nominal=1e-2)
    s_x: Scalar = variable("sliding velocity of the contact patch along e_x", unit="m/s")
    s_y: Scalar = variable("sliding velocity of the contact patch along e_y", unit="m/s")
    f_x: Scalar = variable("force on the wheel along e_x", unit="N")
    f_y: Scalar = variable("force on the wheel along e_y", unit="N")
    f_z: Scalar = variable("force on the wheel along e_z", unit="N")

    @port
    def axis(self) -> Flange | None:
        """Shaft of the wheel, with its angle relative to frame_a."""
        return Flange() if self.use_axis_flange else None

    def check(self) -> None:
        """Reject directions of length 0, and n_x parallel to up."""
        for name in ("n", "up", "n_x"):
            require_direction(self, getattr(self, name), name)
        if parallel(self.up, self.n_x):
            raise DeclarationError("`n_x` is parallel to `up`; give a horizontal direction, such as n_x=(0, 0, 1).")

    def requirements(self):
        name = self._path or type(self).__name__
        yield require(
            self._cos_camber() > UPRIGHT,
            f"the wheel of {name} starts inclined by more than 60 degrees; `n` is its axis, resolved in frame_a, and `up` the "
            "vertical, resolved in the world",
        )
        yield require(
            self.radius > 0,
            f"the centre of {name} starts below the ground; start it about R_0 above the height of the ground along `up`",
        )

    def equations(self):
        a, n, (e_x, e_y), slope = self.frame_a, unit_vector(self.n), self._directions(), self._cos_camber()
        w = a.R.w + n * der(self.axis.phi) if self.use_axis_flange else a.R.w
        v = resolve1(a.R, a.v + cross(w, resolve2(a.R, self.arm)))
        force = self.f_x * e_x + self.f_y * e_y + self.f_z * self.e_z
        torque = resolve2(a.R, cross(self.arm, force))
        yield from super().equations()
        yield from self._contact_point()
        yield self.v_x == dot(e_x, v)
        yield self.v_y == dot(e_y, v)
        yield self.v_z == dot(self.e_z, v) / slope
        yield self.v_t == sqrt((self.radius * dot(n, w)) ** 2 + self.v_low**2)
        yield self.f_z * slope == self._spring() + self._damper()
        yield from self._slip()
        yield a.f == -resolve2(a.R, force)
        if self.use_axis_flange:
            yield a.t == n * dot(n, torque) - torque
            yield self.axis.tau == -dot(n, torque)
        else:
            yield a.t == -torque

    def _contact_point(self) -> Any:
        """Yield the equations of the contact point: foot of the wheel centre, in the wheel plane, on the ground at (x, y)."""
        up, e_1, e_2 = two_axes_rotation(self.up, self.n_x)
        ground, slopes = self._ground()
        point = self.x * e_1 + self.y * e_2 + ground * up
        normal = up - slopes[0] * e_1 - slopes[1] * e_2
        axis = self._axis()
        down = axis * dot(self.e_z, axis) - self.e_z
        yield self.e_z == normal / sqrt(dot(normal, normal))
        yield self.radius == dot(self.e_z, self.frame_a.r_0 - point) / self._cos_camber()
        yield self.arm == self.radius / self._cos_camber() * down
        yield self.x == dot(e_1, self.frame_a.r_0 + self.arm)
        yield self.y == dot(e_2, self.frame_a.r_0 + self.arm)
        yield self.deflection == self.R_0 - self.radius

    def _slip(self) -> Any:
        """Yield the equations of the carcass in series with the contact patch."""
        limit = self.mu * self.f_z
        pull_x, pull_y = self.c_kappa * self.s_x, self.c_alpha * self.s_y
        small = self.c_kappa * quantity(V_SMALL, "m/s")
        size = sqrt((limit * self.v_t) ** 2 + pull_x**2 + pull_y**2 + small**2)
        yield self.f_x == self._c_x() * self.u_x + self.d_x * der(self.u_x)
        yield self.f_y == self._c_y() * self.u_y + self.d_y * der(self.u_y)
        yield self.s_x == self.v_x + der(self.u_x)
        yield self.s_y == self.v_y + der(self.u_y)
        yield self.f_x == -limit * pull_x / size
        yield self.f_y == -limit * pull_y / size

    def _spring(self) -> Expr:
        """Radial spring force, never adhesive."""
        free = self.c_z * self.deflection
        return (free + abs(free)) / 2

    def _damper(self) -> Expr:
        """Radial damper force, limited to the magnitude of the spring force."""
        most, free = self._spring(), -self.d_z * self.v_z
        return (abs(free + most) - abs(free - most)) / 2

    def _c_x(self) -> Expr:
        return self.c_kappa / self.sigma_x

    def _c_y(self) -> Expr:
        return self.c_alpha / self.sigma_y

    def _ground(self) -> tuple[Expr, Any]:
        """Height at (x, y), and its slopes along x and y."""
        if self.height is None:
            return quantity(0.0, "m"), (0.0, 0.0)
        ground = as_expr(self.height(self.x, self.y))
        return ground, (gradient(ground, self.x), gradient(ground, self.y))

    def _axis(self) -> Expr:
        return resolve1(self.frame_a.R, unit_vector(self.n))

    def _cos_camber(self) -> Expr:
        """Cosine of the inclination of the wheel from the normal of the ground."""
        across = cross(self.e_z, self._axis())
        return sqrt(dot(across, across))

    def _directions(self) -> tuple[Expr, Expr]:
        e_x = cross(self.e_z, self._axis()) / self._cos_camber()
        return e_x, cross(self.e_z, e_x)

    def stored_energy(self):
        """Elastic energy of the tyre and of its carcass."""
        springs = self._spring() * self.deflection + self._c_x() * self.u_x**2 + self._c_y() * self.u_y**2
        return springs / 2

    def loss(self):
        """Power of the dampers and of sliding."""
        carcass_x, carcass_y = self.f_x - self._c_x() * self.u_x, self.f_y - self._c_y() * self.u_y
        dampers = -self._damper() * self.v_z + carcass_x**2 / self.d_x + carcass_y**2 / self.d_y
        return dampers - self.f_x * self.s_x - self.f_y * self.s_y

    def shapes(self):
        """The wheel, and the force on it."""
        n, e_x, e_y = unit_vector(self.n), *self._directions()
        yield geometry.Cylinder(pose(self.frame_a), -n * self.R_0 / 4, n * self.R_0 / 4, 2 * self.R_0, "wheel")
        yield geometry.Arrow(self.frame_a.r_0 + self.arm, self.f_x * e_x + self.f_y * e_y + self.f_z * self.e_z)
