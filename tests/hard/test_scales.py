"""Parameters far apart, parameters of exactly zero, and tolerances from coarse to fine."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

import acausal as ac
from acausal import Model, Scalar, chain, fixed, parameter, structural
from components import Body, BodyRod, FixedTranslation, Prismatic, Revolute, Spring, SpringDamperParallel, World
from components.rotational import Fixed, Inertia, SpringDamper
from models import FourBar, SimplePendulum, SliderCrank
from tests.hard.measure import within
from tests.reference import double_pendulum, four_bar, pendulum


class Chain(Model):
    """Two uniform rods in a chain, the first horizontal and the second hanging at the start."""

    masses: tuple[float, float] = structural("masses of the rods", default=(1.0, 1.0), shape=(2,))
    world = World(g=9.81)
    upper, lower = Revolute(phi=fixed(0), w=fixed(0)), Revolute(phi=fixed(-1.0), w=fixed(0))

    @ac.parts
    def rod(self):
        """The rods, of 1 m."""
        return [BodyRod(r=(1, 0, 0), m=m) for m in self.masses]

    def connections(self):
        yield chain(self.world, self.upper, self.rod[0], self.lower, self.rod[1])


@pytest.mark.parametrize("masses", [(1e-9, 1.0), (1.0, 1e-9), (1e-12, 1e3)])
def test_light_and_heavy_rod(masses):
    result = ac.simulate(Chain(masses=masses), stop_time=1.5, tolerance=1e-9, intervals=30)
    rods = [double_pendulum.Rod.uniform(m, 1.0) for m in masses]
    expected = double_pendulum.simulate(*rods, [0.0, -1.0], [0.0, 0.0], result.time)
    within("upper rod, rad", np.abs(result["upper.phi"] - expected[:, 0]).max(), 1e-4)
    within("lower rod, rad", np.abs(result["upper.phi"] + result["lower.phi"] - expected[:, 1]).max(), 1e-4)


class Beads(Model):
    """Point masses at equal distances on massless bars in a straight line, horizontal at the start."""

    masses: tuple[float, ...] = structural("the masses", default=(1e-9, 1.0))
    world = World(g=9.81)

    @ac.parts
    def hinge(self):
        """Joints before each bar."""
        return [Revolute(phi=fixed(0), w=fixed(0)) for _ in self.masses]

    @ac.parts
    def bar(self):
        """Bars of 1 m."""
        return [FixedTranslation(r=(1, 0, 0)) for _ in self.masses]

    @ac.parts
    def bead(self):
        """Masses at the ends of the bars."""
        return [Body(m=m) for m in self.masses]

    def connections(self):
        before: Any = self.world.frame_b
        for hinge, bar, bead in zip(self.hinge, self.bar, self.bead, strict=True):
            yield chain(before, hinge, bar, bead)
            before = bar.frame_b


@pytest.mark.slow
def test_light_bead_inside_a_heavy_pendulum():
    """The tension moves a bead of 1e-9 kg at 1e5 rad/s; the heavy one swings on 2 m, as closed forms say.

    The light bead falls with g until the tension holds it, within 1e-5 s: the chain stays straight up to about g / w^2.
    """
    result = ac.simulate(Beads(), stop_time=1.5, tolerance=1e-6, intervals=30)
    x, y = pendulum.position(result.time, length=2.0)
    found = result["bead[1].r_0"]
    within("heavy bead, m", np.hypot(found[:, 0] - x, found[:, 1] - y).max(), 1e-3)
    within("angle of the chain, rad", np.abs(result["hinge[1].phi"]).max(), 1e-3)


class StiffPair(Model):
    """Two rotors joined by c = d = 1e9, and tied to the wall by a soft spring."""

    stiff: Scalar = parameter("stiffness between the rotors", unit="N.m/rad", default=1e9)
    drag: Scalar = parameter("damping between the rotors", unit="N.m.s/rad", default=1e9)
    wall, soft, join = Fixed(), SpringDamper(c=10, d=0.1), SpringDamper(c=stiff, d=drag)
    one, two = Inertia(J=1, phi=fixed(1), w=fixed(0)), Inertia(J=2, phi=fixed(1), w=fixed(0))

    def connections(self):
        yield chain(self.wall.flange, self.soft, self.one, self.join, self.two)


STIFF = ((1e9, 1e9), (0.0, 1e9))


def reduced(times: np.ndarray) -> np.ndarray:
    """Angle of both rotors when they are one: J = 3."""
    A = np.array([[0, 1], [-10 / 3, -0.1 / 3]])
    return np.array([expm(A * t)[0, 0] for t in times])


@pytest.mark.parametrize(("c", "d"), STIFF)
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
def test_stiff_and_damped_beside_soft(c, d, tolerance):
    result = ac.simulate(StiffPair(stiff=c, drag=d), stop_time=10.0, tolerance=tolerance, intervals=50)
    # The joint yields by at most the torque of the soft spring over 1e9.
    within("first rotor, rad", np.abs(result["one.phi"] - reduced(result.time)).max(), 1000 * tolerance + 1e-8)
    within("second less first, rad", np.abs(result["two.phi"] - result["one.phi"]).max(), tolerance + 1e-8)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8, 1e-9])
def test_stiff_and_undamped_beside_soft(tolerance):
    """Vibrations at 4e4 rad/s allow no order above 2, which turns the phase by (w h)^2 / 3 with (w h)^3 = 9 / 2 tolerance."""
    result = ac.simulate(StiffPair(stiff=1e9, drag=0.0), stop_time=10.0, tolerance=tolerance, intervals=50)
    bound = np.sqrt(10 / 3) * 10 / 3 * (4.5 * tolerance) ** (2 / 3)
    within("first rotor, rad", np.abs(result["one.phi"] - reduced(result.time)).max(), bound)


class StiffLine(Model):
    """Masses on a guide: soft spring to the wall, spring-damper of 1e9 between them."""

    world = World(gravity=None)
    near, far = Prismatic(s=fixed(2), v=fixed(0)), Prismatic(s=fixed(1), v=fixed(0))
    one, two = Body(m=1), Body(m=2)
    soft, join = Spring(c=10, s_unstretched=1), SpringDamperParallel(c=1e9, d=1e9, s_unstretched=1)

    def connections(self):
        yield chain(self.world, self.near, self.one)
        yield chain(self.near, self.far, self.two)
        yield chain(self.world, self.soft, self.one.frame_a)
        yield chain(self.one.frame_a, self.join, self.two.frame_a)


def test_stiff_line_beside_soft():
    result = ac.simulate(StiffLine(), stop_time=10.0, tolerance=1e-8, intervals=50)
    expected = 1 + np.cos(np.sqrt(10 / 3) * result.time)
    within("first mass, m", np.abs(result["near.s"] - expected).max(), 1e-5)
    within("distance less 1, m", np.abs(result["far.s"] - 1).max(), 1e-5)


TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)


@cache
def finest_crank() -> ac.Result:
    return elastic_crank(1e-11, "idas")


def elastic_crank(tolerance: float, method: str | None = None) -> ac.Result:
    model = SliderCrank(crank_elements=1, rod_elements=1)
    damped = {"crank_bar.beta": 1e-4, "rod_bar.beta": 1e-4}
    return ac.simulate(model, stop_time=0.3, tolerance=tolerance, intervals=30, parameters=damped, method=method)


def simple(tolerance: float) -> tuple[float, int]:
    result = ac.simulate(SimplePendulum(), stop_time=10.0, tolerance=tolerance, intervals=50)
    x, y = pendulum.position(result.time)
    return float(np.hypot(result["x"] - x, result["y"] - y).max()), result.stats["steps"]


def loop(tolerance: float) -> tuple[float, int]:
    result = ac.simulate(FourBar(), stop_time=3.0, tolerance=tolerance, intervals=30)
    expected = four_bar.FourBar().simulate(result.time)[:, 0]
    return float(np.abs(result["j1_phi"] - expected).max()), result.stats["steps"]


def elastic(tolerance: float) -> tuple[float, int]:
    """Against the same equations at the finest tolerance: what is asked here is the integration alone."""
    found, exact = elastic_crank(tolerance), finest_crank()
    return float(np.abs(found["crank_angle"] - exact["crank_angle"]).max()), found.stats["steps"]


@pytest.mark.parametrize("case", [simple, loop, elastic], ids=lambda case: case.__name__)
@pytest.mark.slow
def test_error_falls_with_tolerance(case):
    """What a step may lose is the tolerance; of a few steps each loses more, as they are long."""
    found = [case(tolerance) for tolerance in TOLERANCES]
    for tolerance, (error, steps) in zip(TOLERANCES, found, strict=True):
        within(f"{case.__name__} at {tolerance:g}", error, max(max(1000, steps) * tolerance, 1e-8))
    for (coarse, _), (fine, _) in pairwise(found[1:]):
        assert fine < coarse / 3 or fine < 1e-8


def test_zero_gravity_damping_and_mass():
    """Zeros leave the equations: the four-bar keeps its energy, the slider-crank its motion with a massless slider."""

    class Free(FourBar):
        world = World(g=0)
        j1 = Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(2.0))

    result = ac.simulate(Free(), stop_time=5.0, tolerance=1e-9, intervals=50, parameters={"damper.d": 0.0})
    reference = four_bar.FourBar(damping=0.0, gravity=0.0)
    energy = [reference.energy(a, b) for a, b in zip(result["j1_phi"], result["j1_w"], strict=True)]
    within("energy, relative", np.abs(np.array(energy) / energy[0] - 1).max(), 1e-6)
    expected = reference.simulate(result.time, rate=2.0)
    within("crank, rad", np.abs(result["j1_phi"] - expected[:, 0]).max(), 1e-4)


class MasslessRod(Model):
    """A pendulum on a rod without mass, with a body without mass and a spring without stiffness beside the bob."""

    world = World(g=9.81)
    hinge = Revolute(phi=fixed(0), w=fixed(0), use_axis_flange=True)
    rod, bob, nothing = BodyRod(r=(1, 0, 0), m=0), Body(m=1), Body(m=0)
    free = SpringDamper(c=0, d=0)

    def connections(self):
        yield chain(self.world, self.hinge, self.rod, self.bob)
        yield chain(self.rod, self.nothing)
        yield chain(self.hinge.support, self.free, self.hinge.axis)


def test_zero_mass_stiffness_and_damping():
    result = ac.simulate(MasslessRod(), stop_time=10.0, tolerance=1e-9, intervals=50)
    x, y = pendulum.position(result.time)
    found = result["bob.r_0"]
    within("bob, m", np.hypot(found[:, 0] - x, found[:, 1] - y).max(), 1e-5)


def test_mass_of_zero_that_must_move_is_refused():
    """A free hinge with nothing behind it has no equation of motion; the message names it."""

    class Empty(Model):
        world = World()
        hinge, body = Revolute(phi=fixed(0), w=fixed(0)), Body(m=0)

        def connections(self):
            yield chain(self.world, self.hinge, self.body)

    with pytest.raises(ac.AcausalError, match=r"hinge|body"):
        ac.simulate(Empty(), stop_time=1.0)


@pytest.mark.parametrize("stop_time", [1e-300, 1e-150, 1e-9])
def test_the_shortest_runs_of_a_loop(stop_time):
    result = ac.simulate(FourBar(), stop_time=stop_time, intervals=10)
    assert np.all(np.isfinite(result["j1_phi"]))
    assert abs(result["j1_phi"][-1] - result["j1_phi"][0]) <= 1e-8
