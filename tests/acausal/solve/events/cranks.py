"""Machines of one freedom with dry friction in their joints, and the same by hand: I a + h w^2 = Q - sum of J_k tau_k."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from acausal import (
    Component,
    Model,
    Scalar,
    chain,
    connect,
    der,
    discrete,
    fixed,
    guess,
    parameter,
    piecewise,
    port,
    quantity,
    reinit,
    set_valued,
    sign,
    variable,
    when,
)
from components import Body, BodyShape, FixedTranslation, Prismatic, Revolute, TranslationalFlange, World, rotational

CRANK, ROD, G = 0.3, 1.0, 9.81
Motion = tuple[float, float, float]


class GuideFriction(Component):
    """Coulomb friction of a slide: a set-valued law by its own statements."""

    flange = port(TranslationalFlange, "what slides")
    f_sliding: Scalar = parameter("force against sliding", unit="N", default=0)
    v: Scalar = variable("speed", unit="m/s")
    f: Scalar = variable("force", unit="N")
    mode: Scalar = discrete("sense of the speed, 0 at rest", start=sign(v))
    v_stuck: Scalar = discrete("v at the last decision", unit="m/s")
    shared: Scalar = discrete("1 where others keep it at rest")
    share: Scalar = discrete("force over f_sliding there")
    v_slip: Scalar = discrete("change of v at which it no longer rests there", unit="m/s")

    def equations(self):
        rests = (self.mode > -0.5) & (self.mode < 0.5)
        sticks, shares = rests & (self.shared < 0.5), rests & (self.shared > 0.5)
        yield self.v == der(self.flange.s)
        yield self.f == self.flange.f
        given = (self.mode + self.share) * self.f_sliding
        yield piecewise((quantity(1.0, "kg") * der(self.v), sticks), self.f - given) == 0
        own = {
            "mode": self.mode,
            "offset": self.v_stuck,
            "shared": self.shared,
            "share": self.share,
            "slip": self.v_slip,
        }
        yield set_valued(self.v, limit=self.f_sliding, **own)
        for sense in (1, -1):
            moves = sense * (self.v - self.v_stuck)
            slides = reinit(self.mode, sense), reinit(self.shared, 0), reinit(self.share, 0)
            yield when(sticks & (sense * self.f > self.f_sliding), *slides, reinit(self.v_stuck, self.v), at_start=True)
            yield when(shares & (moves > self.v_slip), *slides)
            yield when((sense * self.mode > 0.5) & (moves < 0), reinit(self.mode, 0), reinit(self.v_slip, 0))

    def dissipated_power(self):
        return self.f * self.v


def joint(phi: Any) -> Revolute:
    return Revolute(phi=phi, use_axis_flange=True)


class SliderCrank(Model):
    """An engine of one cylinder; friction in crank, pin, wrist and slide."""

    world = World(gravity=None)
    j1, b1 = joint(fixed(1.0)), BodyShape(r=(CRANK, 0, 0), m=5, r_CM=(CRANK / 2, 0, 0))
    j2, b2 = joint(guess(-1.255)), BodyShape(r=(ROD, 0, 0), m=1, r_CM=(ROD / 2, 0, 0))
    j3, slide, piston = joint(guess(0.255)), Prismatic(s=guess(1.13), use_axis_flange=True), Body(m=1)
    f1, f2, f3 = (rotational.Friction(tau_sliding=0) for _ in range(3))
    f4 = GuideFriction()

    def connections(self):
        yield chain(self.world, self.j1, self.b1, self.j2, self.b2, self.j3, self.piston)
        yield chain(self.world, self.slide, self.piston)
        for own, friction in ((self.j1, self.f1), (self.j2, self.f2), (self.j3, self.f3)):
            yield chain(own.support, friction, own.axis)
        yield connect(self.f4.flange, self.slide.axis)


def slider_crank(
    phi: float = 1.0, w: float | None = 20.0, g: float = 0.0, kind: type[SliderCrank] = SliderCrank
) -> SliderCrank:
    """Return one that starts at an angle, with a speed of the crank, or none where a drive gives both."""
    rod = -np.arcsin(CRANK * np.sin(phi) / ROD)
    crank = Revolute(phi=guess(phi), use_axis_flange=True)
    if w is not None:
        crank = Revolute(phi=fixed(phi), w=fixed(w), use_axis_flange=True)
    return kind(
        world=World(g=g) if g else World(gravity=None),
        j1=crank,
        j2=joint(guess(rod - phi)),
        j3=joint(guess(-rod)),
        slide=Prismatic(s=guess(CRANK * np.cos(phi) + ROD * np.cos(rod)), use_axis_flange=True),
    )


def friction(tau: dict[int, float], peak: float = 1.0) -> dict[str, float]:
    """Return the parameters of friction by the number of the joint; 4 is the slide."""
    found = {
        f"f{k}.tau_{kind}": tau.get(k, 0.0) * by for k in (1, 2, 3) for kind, by in (("sliding", 1), ("static", peak))
    }
    return found | {"f4.f_sliding": tau.get(4, 0.0)}


def rates_of_joints(phi: float) -> dict[int, float]:
    """Return the speeds of the joints over that of the crank."""
    s, c = -CRANK * np.sin(phi) / ROD, np.sqrt(1 - (CRANK * np.sin(phi) / ROD) ** 2)
    rod = -CRANK * np.cos(phi) / (ROD * c)
    return {1: 1.0, 2: rod - 1, 3: -rod, 4: -CRANK * np.sin(phi) - ROD * s * rod}


def by_hand(stop: float, phi: float, w: float, tau: dict[int, float], g: float = 0.0, slow: float = 1e-6) -> Motion:
    """Angle and speed of the crank, and what friction took, with tanh(w / slow) for the sign of each speed."""

    def law(_: float, y: np.ndarray) -> list[float]:
        p, s = y[0], -CRANK * np.sin(y[0]) / ROD
        c, J = np.sqrt(1 - s * s), rates_of_joints(y[0])
        d1 = J[2] + 1
        d2 = (CRANK * np.sin(p) / ROD + s * d1**2) / c
        speeds = [
            np.array([-CRANK / 2 * np.sin(p), CRANK / 2 * np.cos(p)]),
            np.array([-CRANK * np.sin(p) - ROD / 2 * s * d1, CRANK * np.cos(p) + ROD / 2 * c * d1]),
            np.array([J[4], 0]),
        ]
        bends = [
            np.array([-CRANK / 2 * np.cos(p), -CRANK / 2 * np.sin(p)]),
            np.array([-CRANK * np.cos(p), -CRANK * np.sin(p)])
            + ROD / 2 * np.array([-c * d1**2 - s * d2, -s * d1**2 + c * d2]),
            np.array([-CRANK * np.cos(p) - ROD * (c * d1**2 + s * d2), 0]),
        ]
        masses = (5.0, 1.0, 1.0)
        inertia = sum(m * v @ v for m, v in zip(masses, speeds, strict=True))
        bend = sum(m * v @ a for m, v, a in zip(masses, speeds, bends, strict=True))
        force, power = -g * sum(m * v[1] for m, v in zip(masses, speeds, strict=True)), 0.0
        for k, t in tau.items():
            against = t * np.tanh(J[k] * y[1] / slow)
            force, power = force - J[k] * against, power + against * J[k] * y[1]
        return [y[1], (force - bend * y[1] ** 2) / inertia, power]

    return solved(law, stop, phi, w)


class Parallelogram(Model):
    """A bar on two equal levers, friction in its four pins."""

    world, base = World(g=G), FixedTranslation(r=(1, 0, 0))
    a, b = Revolute(phi=fixed(-1.0), w=fixed(0), use_axis_flange=True), joint(guess(-1.0))
    c, d = joint(guess(1.0)), joint(guess(-1.0))
    left, right = (BodyShape(r=(0.5, 0, 0), m=1, r_CM=(0.25, 0, 0)) for _ in range(2))
    bar = BodyShape(r=(1, 0, 0), m=2, r_CM=(0.5, 0, 0))
    fa, fb, fc, fd = (rotational.Friction(tau_sliding=0.5) for _ in range(4))
    push = rotational.Torque(tau=0)

    def connections(self):
        yield chain(self.world, self.a, self.left, self.c, self.bar, self.d.frame_a)
        yield chain(self.world, self.base, self.b, self.right, self.d.frame_b)
        for own, pin in ((self.a, self.fa), (self.b, self.fb), (self.c, self.fc), (self.d, self.fd)):
            yield chain(own.support, pin, own.axis)
        yield connect(self.push.flange, self.a.axis)


def parallelogram_by_hand(
    stop: float, phi: float, tau: float, push: Callable[[float], float] = lambda t: 0.0, slow: float = 1e-7
) -> Motion:
    """Angle and speed of a lever, and what the friction of all pins took."""

    def law(t: float, y: np.ndarray) -> list[float]:
        against = 4 * tau * np.tanh(y[1] / slow)
        return [y[1], (push(t) - 1.5 * G * np.cos(y[0]) - against) / 0.625, against * y[1]]

    return solved(law, stop, phi, 0.0)


def solved(law: Callable[[float, np.ndarray], list[float]], stop: float, phi: float, w: float) -> Motion:
    run = solve_ivp(law, (0, stop), [phi, w, 0.0], method="Radau", rtol=1e-9, atol=1e-11)
    found = run.y[:, -1]
    return float(found[0]), float(found[1]), float(found[2])
