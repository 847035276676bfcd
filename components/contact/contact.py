"""Contact: base of compliant contacts with friction."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import (
    Expr,
    Scalar,
    Vector3,
    cross,
    discrete,
    dot,
    parameter,
    piecewise,
    quantity,
    reinit,
    require,
    sqrt,
    variable,
    when,
)
from components.contact.restitution import impact_number
from components.frame import TwoFrames, force_arrow
from components.orientation import resolve1, resolve2
from components.thermal.heat_loss import HeatLoss


class Contact(HeatLoss, TwoFrames):
    """Base of contacts; a subclass states its stiffness k and its place().

    Notes
    -----
    In contact, x > 0, the normal force is f = max(0, k x^n (1 + chi der(x))) (Hunt and Crossley 1975), with n = 1.5 for
    spheres and n = 1 for points and rims; it never pulls. Friction is mu f v_slip / sqrt(v_slip^2 + v_reg^2) against the
    sliding. It does not stick: under a load of q mu f, q < 1, the contact creeps at v_reg q / sqrt(1 - q^2), for
    example at 0.6 v_reg where half of the greatest friction acts. No branch: each frame must be held by something else.
    """

    n: ClassVar[float] = 1.0
    k: Any
    dissipation: Scalar = parameter(
        "dissipation chi",
        unit="s/m",
        default=0,
        minimum=0,
        doc="Restitution falls with the speed of impact: e is about 1 - 2/3 chi v for small chi v.",
    )
    e: Scalar = parameter(
        "coefficient of restitution",
        unit="1",
        default=1,
        positive=True,
        doc="Speed of separation over speed of approach, at most 1, in place of dissipation; exact where other forces are small "
        "against f, and the approach is faster than v_e. Its dissipation lasts until the next touch.",
    )
    v_e: Scalar = parameter(
        "least speed of approach at which e holds",
        unit="m/s",
        default=1e-3,
        positive=True,
        doc="Slower impacts, and a contact at the start, have the dissipation of this speed.",
    )
    mu: Scalar = parameter("coefficient of friction", unit="1", default=0, minimum=0)
    v_reg: Scalar = parameter(
        "speed that regularises friction",
        unit="m/s",
        default=1e-3,
        positive=True,
        doc="At this speed 71 % of mu f act; a load of q mu f, q < 1, does not stick but creeps at v_reg q / sqrt(1 - q^2).",
    )
    x: Scalar = variable("penetration, negative where there is a gap", unit="m")
    v: Scalar = variable("der(x)", unit="m/s")
    f: Scalar = variable("normal force, not negative", unit="N")
    v_slip: Vector3 = variable("sliding velocity of frame_b's part on frame_a's, resolved in the world", unit="m/s")
    v_touch: Scalar = discrete("speed of approach at the last touch", unit="m/s")

    def equations(self):
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        n, x, at = self.place()
        arm_a, arm_b = at - a.r_0, at - b.r_0
        v_a, v_b = (
            resolve1(end.R, end.v + cross(end.R.w, resolve2(end.R, arm))) for end, arm in ((a, arm_a), (b, arm_b))
        )
        chi = self._chi()
        yield self.x == x
        yield self.v == -dot(n, v_b - v_a)
        yield self.f == piecewise((self._spring() * (1 + chi * self.v), (self.x > 0) & (1 + chi * self.v > 0)), 0)
        yield self.v_slip == v_b - v_a + n * (self.v / self.steepness() ** 2)
        yield when(self.x > 0, reinit(self.v_touch, self.v))
        force = n * self.f - self._friction() * self.v_slip
        yield b.f == -resolve2(b.R, force)
        yield b.t == -resolve2(b.R, cross(arm_b, force))
        yield a.f == resolve2(a.R, force)
        yield a.t == resolve2(a.R, cross(arm_a, force))

    def place(self) -> tuple[Any, Any, Any]:
        """Normal from frame_a's part to frame_b's, penetration and point of contact, both vectors resolved in the world."""
        raise NotImplementedError("returns its normal, penetration and point of contact", "return n, x, at")

    def steepness(self) -> Any:
        """Length of the normal, along which f acts."""
        return 1.0

    def requirements(self):
        name = self._path or type(self).__name__
        yield require(self.e <= 1, f"`e` of {name} is greater than 1, so that impacts would supply energy")
        yield require(
            self.dissipation * (1 - self.e) <= quantity(0.0, "s/m"),
            f"{name} has both `dissipation` and `e`, which determine the same; give one of them",
        )

    def shapes(self):
        """The force."""
        yield force_arrow(self.frame_b)

    def stored_energy(self):
        """Elastic energy."""
        return self._spring() * self.x / (self.n + 1)

    def loss(self):
        """Power of dissipation and friction."""
        return (self.f - self._spring()) * self.v + self._friction() * dot(self.v_slip, self.v_slip)

    def _spring(self) -> Expr:
        """Elastic force, 0 where there is a gap."""
        return self.k * ((self.x + abs(self.x)) / 2) ** self.n

    def _chi(self) -> Expr:
        slow = piecewise((self.v_touch, self.v_touch > self.v_e), self.v_e)
        return self.dissipation + impact_number(self.e) / slow

    def _friction(self) -> Expr:
        """Friction over sliding velocity."""
        speed = sqrt(dot(self.v_slip, self.v_slip) + self.v_reg**2)
        return self.mu * self.f * self.steepness() / speed
