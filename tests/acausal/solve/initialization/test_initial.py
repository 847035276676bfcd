"""Starts from partial data, in equilibrium, and of loops."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal import (
    Model,
    Scalar,
    chain,
    connect,
    cos,
    der,
    fixed,
    guess,
    input,
    output,
    piecewise,
    structural,
    time,
    variable,
)
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    BodyRod,
    FixedTranslation,
    FlexibleBeam,
    Prismatic,
    Revolute,
    Spherical,
    Spring,
    SubstructuredBeam,
    World,
)


class DoublePendulum(Model):
    """Two rods, of which only the motion of the tip is given."""

    world = World(g=9.81)
    first, second = Revolute(phi=guess(-0.5)), Revolute(phi=guess(-1))
    upper, lower = BodyBox(r=(0.5, 0, 0), width=0.06, height=0.06), BodyBox(r=(0.4, 0, 0), width=0.06, height=0.06)
    tip = Body(m=0.1, r_0=fixed((0.7, -0.3, 0)), v_0=fixed((0.2, -0.1, 0)))

    def connections(self):
        yield chain(self.world, self.first, self.upper, self.second, self.lower, self.tip)


def test_joints_follow_from_the_tip() -> None:
    result = ac.simulate(DoublePendulum(), stop_time=0.01, intervals=1)
    phi, psi = result["first.phi"][0], result["second.phi"][0]
    knee = 0.5 * np.array([np.cos(phi), np.sin(phi)])
    tip = knee + 0.4 * np.array([np.cos(phi + psi), np.sin(phi + psi)])
    assert tip == pytest.approx([0.7, -0.3], abs=1e-9)
    w, u = result["first.w"][0], result["first.w"][0] + result["second.w"][0]
    across = np.array([-(tip - knee)[1], (tip - knee)[0]])
    assert w * np.array([-knee[1], knee[0]]) + u * across == pytest.approx([0.2, -0.1], abs=1e-9)


@pytest.mark.parametrize("bend", [-1.0, 1.0])
def test_guesses_choose_among_several_positions(bend: float) -> None:
    make: Any = DoublePendulum
    model = make(first=Revolute(phi=guess(-0.4 - 0.8 * bend)), second=Revolute(phi=guess(1.6 * bend)))
    result = ac.simulate(model, stop_time=0.01, intervals=1)
    assert np.sign(result["second.phi"][0]) == bend


class SliderCrank(Model):
    """Rigid slider-crank of which the slider's position and velocity are given."""

    world = World(gravity=None)
    bearing, pin, wrist = Revolute(phi=guess(1.0)), Revolute(phi=guess(-1.3)), Revolute()
    crank, rod = BodyRod(r=(0.15, 0, 0), m=1), BodyRod(r=(0.3, 0, 0), m=1)
    slider = Prismatic(s=fixed(0.35), v=fixed(-0.4))

    def connections(self):
        yield chain(self.world, self.bearing, self.crank, self.pin, self.rod, self.wrist, self.slider.frame_b)
        yield connect(self.world.frame_b, self.slider.frame_a)


Crank: Any = SliderCrank


def test_loop_follows_from_the_slider() -> None:
    result = ac.simulate(Crank(), stop_time=0.01, intervals=1)

    def position(phi: float) -> float:
        return 0.15 * np.cos(phi) + np.sqrt(0.3**2 - (0.15 * np.sin(phi)) ** 2)

    phi: Any = brentq(lambda phi: position(phi) - 0.35, 0.1, 3.0)
    assert result["bearing.phi"][0] == pytest.approx(phi, abs=1e-9)
    slope = (position(phi + 1e-6) - position(phi - 1e-6)) / 2e-6
    assert result["bearing.w"][0] == pytest.approx(-0.4 / slope, rel=1e-8)


def test_too_far_a_slider_is_refused_with_the_mismatch_and_the_joints() -> None:
    model = Crank(slider=Prismatic(s=fixed(0.5), v=fixed(0)))
    with pytest.raises(
        ac.InitializationError, match=r"miss each other by 0\.0\d+ m or rad; the loop goes through"
    ) as error:
        ac.simulate(model, stop_time=0.1)
    assert all(name in str(error.value) for name in ("bearing", "pin", "wrist", "slider"))


def test_one_start_value_too_many_is_told_with_what_could_be_freed() -> None:
    with pytest.raises(ac.InitializationError, match="miss each other") as error:
        ac.simulate(Crank(bearing=Revolute(phi=fixed(1.0))), stop_time=0.1)
    assert "`bearing.phi`, `slider.s`" in str(error.value)
    with pytest.raises(ac.InitializationError, match=r"move apart at [\d.]+ m/s or rad/s"):
        ac.simulate(Crank(bearing=Revolute(w=fixed(1.0))), stop_time=0.1)


def test_velocity_that_nobody_gives_is_asked_for() -> None:
    with pytest.raises(ac.InitializationError, match=r"1 start value is missing.*\n  \w+: Revolute\(w=fixed"):
        ac.simulate(Crank(slider=Prismatic(s=fixed(0.35))), stop_time=0.1)


class Linkage(Model):
    """Spatial four-bar with two sphericals: a crank, a rocker, and a coupler that can spin about itself."""

    world = World()
    r1 = Revolute(phi=fixed(0.3), w=fixed(2.0))
    r2 = Revolute(n=(1, 0, 0))
    s1, s2 = Spherical(), Spherical()
    crank, rocker = BodyRod(r=(0.3, 0, 0), m=1), BodyRod(r=(0, 0.4, 0.3), m=1)
    coupler = BodyCylinder(r=(1.0, 0.2, 0.3), diameter=0.05)
    base = FixedTranslation(r=(1.2, 0.2, -0.3))

    def connections(self):
        yield chain(self.world, self.r1, self.crank, self.s1, self.coupler, self.s2, self.rocker.frame_b)
        yield chain(self.world, self.base, self.r2, self.rocker)


def test_loop_with_sphericals_starts_and_moves() -> None:
    compiled = ac.compile(Linkage())
    with pytest.raises(ac.InitializationError, match="2 start values are missing"):
        ac.simulate(compiled, stop_time=0.1)
    energies, ends = [], []
    for tolerance in (1e-6, 1e-8):
        result = ac.simulate(compiled, stop_time=2, tolerance=tolerance, initial="guesses", energy=True)
        for joint in ("s1", "s2"):
            length = np.linalg.norm(result[f"{joint}.Q"], axis=1)
            assert length[0] == pytest.approx(1, abs=1e-12)
            assert length == pytest.approx(1, abs=100 * tolerance)
        assert np.abs(result["coupler.frame_b.r_0"] - result["s2.frame_a.r_0"]).max() < 1e-12
        energies.append(abs(result.stats["energy_method"]))
        ends.append(result["r1.phi"][-1])
    # Tens of joules go to and fro between the parts.
    assert energies[0] < 1e-1
    assert energies[1] < energies[0] / 10
    assert ends[0] == pytest.approx(ends[1], abs=1e-3)


class Hanging(Model):
    """Cantilever that gravity bends far down."""

    world = World(g=9.81)
    beam = SubstructuredBeam(length=1, E=5e7, rho=1000, A=1e-4, J=1e-9, volumes=20, initial="free")

    def connections(self):
        yield chain(self.world, self.beam)


@pytest.mark.slow
def test_static_equilibrium_of_a_beam_that_bends_far() -> None:
    """Against the elastica: EJ theta'' = -w (L - s) cos theta, clamped at the root, free at the tip."""
    from scipy.integrate import solve_bvp

    EJ, w = 5e7 * 1e-9, 1000 * 1e-4 * 9.81

    def bending(s, y):
        return np.array([y[1], w * (1 - s) * np.cos(y[0]) / EJ, np.cos(y[0]), np.sin(y[0])])

    s = np.linspace(0, 1, 201)
    guessed = np.array([-1.2 * np.sin(np.pi * s / 2), 0 * s, s, -s])
    exact = solve_bvp(lambda s, y: bending(s, y), lambda a, b: np.array([a[0], b[1], a[2], a[3]]), s, guessed, tol=1e-8)
    result = ac.simulate(Hanging(), stop_time=0.01, intervals=1, initial="steady")
    r = result["beam.frame_b.r_0"]
    assert r[0, :2] == pytest.approx(exact.y[2:, -1], abs=5e-3)
    assert r[1] == pytest.approx(r[0], abs=1e-6)


def test_hinged_beam_on_a_spring_starts_in_equilibrium() -> None:
    class Hinged(Model):
        world = World(g=9.81)
        hinge = Revolute(phi=guess(-0.1))
        beam = FlexibleBeam(length=1, E=2e9, rho=1000, A=1e-4, J=1e-9, elements=4, initial="free")
        hook = FixedTranslation(r=(1, 0.5, 0))
        spring = Spring(c=20, s_unstretched=0.4)

        def connections(self):
            yield chain(self.world, self.hinge, self.beam, self.spring, self.hook.frame_b)
            yield connect(self.world.frame_b, self.hook.frame_a)

    result = ac.simulate(Hinged(), stop_time=0.2, initial="steady", tolerance=1e-9)
    # Moment of the spring about the hinge balances that of the weight.
    tip, f = result["beam.frame_b.r_0"][0], result["spring.f"][0]
    pull = f * (np.array([1, 0.5, 0]) - tip) / np.linalg.norm(np.array([1, 0.5, 0]) - tip)
    weight = 1000 * 1e-4 * 9.81
    nodes = result["beam.node_r_0"][0]
    centre = np.mean([(a[0] + b[0]) / 2 for a, b in pairwise(nodes)])
    assert tip[0] * pull[1] - tip[1] * pull[0] == pytest.approx(weight * centre, rel=1e-3)
    assert np.ptp(result["hinge.phi"]) < 1e-8


def test_steady_start_of_a_heated_tank() -> None:
    """First-order system under a constant input, with one state that cannot be steady left at its guess."""

    class Tank(Model):
        heat: Scalar = input("heating power", unit="W")
        T: Scalar = variable("temperature above ambient", unit="K")
        E: Scalar = variable("heat spent", unit="J", start=7.0)
        y: Scalar = output("the temperature", unit="K")

        def equations(self):
            yield ac.quantity(50, "J/K") * der(self.T) == self.heat - ac.quantity(4, "W/K") * self.T
            yield der(self.E) == self.heat
            yield self.y == self.T

    result = ac.simulate(Tank(heat=100), stop_time=10, initial="steady")
    assert result["T"] == pytest.approx(25, abs=1e-9)
    assert result["E"][0] == 7.0


def test_cosine_law_that_cannot_rest_is_told() -> None:
    class NoEquilibrium(Model):
        x: Scalar = variable("state")

        def equations(self):
            yield der(self.x) == 2 + cos(self.x)

    with pytest.raises(ac.InitializationError, match=r"der\(x\) = 0: off by"):
        ac.simulate(NoEquilibrium(), stop_time=1, initial="steady")


class Turned(Model):
    """A variable whose sign changes it, by little or much, against itself."""

    size: float = structural("half of the change")
    x: Scalar = variable("its integral", start=0.0, fixed=True)
    y: Scalar = variable("time, but for what its own sign adds")

    def equations(self):
        yield der(self.x) == self.y
        yield self.y == time + piecewise((self.size, self.y < 0), -self.size)


def test_a_condition_that_rounding_turns_over():
    assert ac.simulate(Turned(size=5e-17), stop_time=1.0)["x"][-1] == pytest.approx(0.5, abs=1e-6)
    with pytest.raises(ac.InitializationError, match="contradicts its own consequence"):
        ac.simulate(Turned(size=5e-3), stop_time=1.0)
