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
    """Base of compliant contacts; a subclass defines the stiffness k and contact_geometry().

    Notes
    -----
    In contact, x > 0, the normal force is f = max(0, k x^n (1 + chi der(x))) (Hunt and Crossley 1975), with n = 1.5 for
    spheres and n = 1 for points and rims; there is no adhesion. The friction force mu f v_slip / sqrt(v_slip^2 + v_reg^2)
    opposes sliding. There is no stiction: under a load q mu f, q < 1, the contact creeps at v_reg q / sqrt(1 - q^2), for
    example at 0.6 v_reg under half of the largest friction force. No branch: other parts must hold both frames.
    """

    n: ClassVar[float] = 1.0
    k: Any
    dissipation: Scalar = parameter(
        "dissipation chi",
        unit="s/m",
        default=0,
        minimum=0,
        doc="The coefficient of restitution decreases with the impact speed v: about 1 - 2/3 chi v for small chi v.",
    )
    e: Scalar = parameter(
        "coefficient of restitution",
        unit="1",
        default=1,
        positive=True,
        doc="Separation speed over approach speed, at most 1; replaces dissipation. Exact if other forces are small compared "
        "with f and the approach is faster than v_e. Each impact sets the dissipation until the next one.",
    )
    v_e: Scalar = parameter(
        "smallest approach speed at which e holds",
        unit="m/s",
        default=1e-3,
        positive=True,
        doc="Slower impacts, and initial contacts, have the dissipation of this speed.",
    )
    mu: Scalar = parameter("coefficient of friction", unit="1", default=0, minimum=0)
    v_reg: Scalar = parameter(
        "speed of regularisation of friction",
        unit="m/s",
        default=1e-3,
        positive=True,
        doc="At this speed friction is 71 % of mu f; under a load q mu f, q < 1, the contact creeps at v_reg q / sqrt(1 - q^2).",
    )
    x: Scalar = variable("penetration, negative for a gap", unit="m")
    v: Scalar = variable("der(x)", unit="m/s")
    f: Scalar = variable("normal force, not negative", unit="N")
    v_slip: Vector3 = variable("sliding velocity of body b relative to body a, resolved in the world", unit="m/s")
    v_touch: Scalar = discrete("approach speed at the last impact", unit="m/s")

    def equations(self):
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        n, x, at = self.contact_geometry()
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

    def contact_geometry(self) -> tuple[Any, Any, Any]:
        """Return normal from body a to body b, penetration and point of contact, vectors resolved in the world."""
        raise NotImplementedError("returns normal, penetration and point of contact", "return n, x, at")

    def steepness(self) -> Any:
        """Return the length of the normal, which multiplies f."""
        return 1.0

    def requirements(self):
        name = self._path or type(self).__name__
        yield require(self.e <= 1, f"`e` of {name} is greater than 1: impacts would generate energy")
        yield require(
            self.dissipation * (1 - self.e) <= quantity(0.0, "s/m"),
            f"{name} has both `dissipation` and `e`, which determine the same property; give one of them",
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
        """Elastic force, 0 for a gap."""
        return self.k * ((self.x + abs(self.x)) / 2) ** self.n

    def _chi(self) -> Expr:
        slow = piecewise((self.v_touch, self.v_touch > self.v_e), self.v_e)
        return self.dissipation + impact_number(self.e) / slow

    def _friction(self) -> Expr:
        """Friction force over sliding velocity."""
        speed = sqrt(dot(self.v_slip, self.v_slip) + self.v_reg**2)
        return self.mu * self.f * self.steepness() / speed
