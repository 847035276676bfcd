"""Loops with constraints to spare, loops in inclined planes, and loops that cannot close."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Component, Model, chain, connect, fixed, guess, port, structural, time
from components import BodyBox, BodyRod, Fixed, FixedTranslation, Frame, Revolute, World
from components.rotational import Damper, Position
from models import FourBar
from tests.hard.measure import within
from tests.reference import four_bar

TILT = Rotation.align_vectors([np.ones(3) / np.sqrt(3)], [[0, 0, 1]])[0].as_matrix()


def gap(result: ac.Result, second: str = "") -> float:
    """How far the planar loop gapes, from the angles of its joints; `second` marks the joints of the second coupler."""
    first, crank = result["j1.phi"], 0.4 * np.exp(1j * result["j1.phi"])
    coupler = (0.1 + 1.1j) * np.exp(1j * (first + result[f"j2{second}.phi"]))
    return float(np.abs(crank + coupler + 0.15 - 1j - (0.65 + 0.1j) * np.exp(1j * result["j3.phi"])).max())


@dataclass(frozen=True)
class TwoCouplers(four_bar.FourBar):
    """The four-bar with a coupler of double mass."""

    def masses(self):
        m, I = super().masses()
        return m * [1, 2, 1], I * [1, 2, 1]


class Askew(FourBar):
    """Axes that are off by as much as rounding, or data of ten digits, leaves."""

    off: float = structural("largest component of an axis in the plane")
    j2 = Revolute(n=(0.3 * off, -0.7 * off, 1.0))
    j3 = Revolute(n=(-1.0 * off, 0.4 * off, 1.0))
    j4 = Revolute(n=(0.6 * off, 0.9 * off, 1.0))


@pytest.mark.parametrize("method", ["auto", "idas"])
@pytest.mark.parametrize("off", [1e-17, 1e-13, 1e-10])
def test_axes_that_are_not_quite_parallel(off, method):
    """A constraint out of the plane that is nearly 0 = 0 neither holds the crank nor bears a load of its own."""
    how = {"stop_time": 1.5, "tolerance": 1e-7, "intervals": 30, "method": method}
    exact, found = ac.simulate(FourBar(), **how), ac.simulate(Askew(off=off), **how)
    assert found.stats.loops[0]["redundant"] == 3
    within("crank, rad", np.abs(found["j1_phi"] - exact["j1_phi"]).max(), 1e-5)
    force, expected = found["j3.frame_b.f"], exact["j3.frame_b.f"]
    within("force on j3, relative", np.abs(force - expected).max() / np.abs(expected).max(), 1e-4)


@pytest.mark.parametrize("off", [1e-7, 1e-4])
def test_a_loop_that_hardly_locks_is_named(off):
    compiled = ac.compile(Askew(off=off))
    for _ in range(2):  # the second run takes the start of the first
        with pytest.warns(ac.AcausalWarning, match=r"through j2, j1, j3, j4 .* has no mobility, but nearly"):
            result = ac.simulate(compiled, stop_time=0.5)
        assert len(result.stats.doubts) == 1
    assert np.abs(result["j1_phi"]).max() < 1e-9


class Driven(Askew):
    """What has no freedom, as its crank is driven, moves all the same."""

    turn = Position(phi_ref=time**2)

    def connections(self):
        yield super().connections()
        yield connect(self.turn.flange, self.j1.axis)


@pytest.mark.filterwarnings("error::acausal.AcausalWarning")
def test_a_crank_that_is_driven():
    j1 = Revolute(use_axis_flange=True)
    assert ac.simulate(Driven(off=1e-12, j1=j1), stop_time=1.0)["j1_phi"][-1] == pytest.approx(1.0)


class Parallel(FourBar):
    """A second, identical coupler, 0.2 m away along z: the loop is closed twice."""

    up, down = FixedTranslation(r=(0, 0, 0.2)), FixedTranslation(r=(0, 0, 0.2))
    j2_b, j4_b = Revolute(), Revolute()
    b2_b = BodyBox(r=(0.1, 1.1, 0), width=0.05)

    def connections(self):
        yield super().connections()
        yield connect(self.b4.frame_b, self.down.frame_a)
        yield chain(self.b1, self.up, self.j2_b, self.b2_b, self.j4_b, self.down.frame_b)


@pytest.mark.slow
def test_two_identical_loops_in_parallel():
    result = ac.simulate(Parallel(), stop_time=2.0, tolerance=1e-8, intervals=40)
    expected = TwoCouplers().simulate(result.time)
    within("crank, rad", np.abs(result["j1_phi"] - expected[:, 0]).max(), 1e-4)
    within("closing gap of both loops, m", max(gap(result), gap(result, "_b")), 1e-7)


@pytest.mark.slow
def test_bearing_force_of_two_loops_in_parallel():
    """How the couplers share their load is open, but the bearings bear what they bear with one coupler of double mass."""
    how = {"stop_time": 0.5, "tolerance": 1e-8, "intervals": 10}
    two, one = (
        ac.simulate(Parallel(), **how),
        ac.simulate(FourBar(b2=BodyBox(r=(0.1, 1.1, 0), width=0.05, density=15400)), **how),
    )
    for joint in ("j1", "j3"):
        force, expected = (result[f"{joint}.frame_b.f"][:, :2] for result in (two, one))
        within(
            f"force on {joint} in the plane, relative", np.abs(force - expected).max() / np.abs(expected).max(), 1e-5
        )


class Dyad(Component):
    """Two rods in a row that close a loop between two frames."""

    frame_a: Frame = port(Frame, "first end")
    frame_b: Frame = port(Frame, "second end")
    first, second = BodyRod(r=(2, 0, 0), m=1), BodyRod(r=(2, 1, 0), m=1)
    start, middle, end = Revolute(phi=guess(1)), Revolute(phi=guess(2)), Revolute(phi=guess(-1))

    def connections(self):
        yield chain(self.frame_a, self.start, self.first, self.middle, self.second)
        yield chain(self.frame_b, self.end, self.second.frame_b)


class Shared(Model):
    """Three loops that are closed at one point; `turned` writes their connections the other way round."""

    turned: bool = structural("whether each loop comes first in its connection")
    world, bearing = World(), Revolute(phi=fixed(0.3), w=fixed(1))
    crank = BodyRod(r=(1, 0, 0), m=1)
    dyads = (Dyad(), Dyad(), Dyad())

    def connections(self):
        yield chain(self.world, self.bearing, self.crank)
        for dyad in self.dyads:
            for ends in ((self.crank.frame_b, dyad.frame_a), (self.world.frame_b, dyad.frame_b)):
                yield connect(*(reversed(ends) if self.turned else ends))


def test_loops_closed_at_one_point_whichever_end_comes_first():
    straight, turned = (ac.simulate(Shared(turned=turned), stop_time=0.5, intervals=5) for turned in (False, True))
    for name in ("bearing.phi", "bearing.frame_b.f", "dyads[0].frame_a.f", "dyads[1].frame_a.f", "dyads[2].end.phi"):
        np.testing.assert_allclose(straight[name], turned[name], atol=1e-4)
    for result in (straight, turned):
        assert [loop["kind"] for loop in result.stats["loops"]] == ["planar loop"] * 3


class Inclined(Model):
    """The four-bar in the plane across n = (1, 1, 1), with everything turned into it."""

    across: tuple[float, float, float] = structural(
        "direction of gravity", default=tuple(TILT @ [0, -1, 0]), shape=(3,)
    )
    world = World(g=9.80665, n=across)
    j1 = Revolute(n=(1, 1, 1), use_axis_flange=True, phi=fixed(0), w=fixed(0))
    j2, j3, j4 = Revolute(n=(1, 1, 1)), Revolute(n=(1, 1, 1)), Revolute(n=(1, 1, 1))
    b1, b2, b3, b4 = (
        BodyBox(r=tuple(TILT @ r), width=0.05, width_direction=(1, 1, 1))
        for r in ((0.4, 0, 0), (0.1, 1.1, 0), (-0.15, 1, 0), (0.65, 0.1, 0))
    )
    damper = Damper(d=0.1)

    def connections(self):
        yield chain(self.world, self.j1, self.b1, self.j2, self.b2, self.j4, self.b4.frame_b)
        yield chain(self.world, self.b3, self.j3, self.b4)
        yield chain(self.j1.support, self.damper, self.j1.axis)


@pytest.mark.slow
@pytest.mark.parametrize("constraints", ["auto", "states", "projection"])
def test_planar_loop_in_an_inclined_plane(constraints):
    """Three constraints are redundant up to rounding only."""
    result = ac.simulate(Inclined(), stop_time=5.0, tolerance=1e-8, intervals=50, constraints=constraints)
    expected = four_bar.FourBar().simulate(result.time)
    within("crank, rad", np.abs(result["j1.phi"] - expected[:, 0]).max(), 1e-4)
    within("closing gap, m", gap(result), 1e-7)


def test_inclined_by_hardly_more_than_rounding_is_no_planar_loop():
    """Axes apart by 1e-3 rad: the loop is spatial and has no freedom left; speeds of 1 and 0 contradict it."""

    class Warped(FourBar):
        j3 = Revolute(n=(1e-3, 0, 1), w=fixed(0.0))
        j1 = Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(1.0))

    with pytest.raises(ac.AcausalError):
        ac.simulate(Warped(), stop_time=1.0)


def test_loop_that_cannot_close():
    class Long(FourBar):
        b2 = BodyBox(r=(0.1, 5.1, 0), width=0.05)

    # Longest reach of the other three: 0.4 + |b4| + |b3| = 0.4 + 0.6576 + 1.0112 against 5.1010.
    missing = np.hypot(0.1, 5.1) - 0.4 - np.hypot(0.65, 0.1) - np.hypot(0.15, 1)
    with pytest.raises(ac.InitializationError, match=r"does not close|loop closes") as caught:
        ac.simulate(Long(), stop_time=1.0)
    said = str(caught.value)
    print(said)
    # j1 is held by its start at phi = 0.
    for joint in ("j2", "j3", "j4"):
        assert joint in said
    figure = float(said.split("by ")[1].split()[0])
    assert 0.3 * missing < figure < 3 * missing


class Triangle(Model):
    """Two rods and the ground, hinged: no freedom; statics gives all forces."""

    world, far = World(g=9.81), Fixed(r=(2, 0, 0))
    foot1, top, foot2 = Revolute(), Revolute(), Revolute()
    left, right = BodyRod(r=(1, 1, 0), m=1), BodyRod(r=(1, -1, 0), m=1)

    def connections(self):
        yield chain(self.world, self.foot1, self.left, self.top, self.right, self.foot2, self.far.frame_b)


def test_rigid_triangle_closes():
    """Three-hinged arch under its weight: half of each rod's weight at the foot and half at the top, thrust W / 2."""
    result = ac.simulate(Triangle(), stop_time=1.0, intervals=4)
    force = result["foot1.frame_b.f"]
    np.testing.assert_allclose(result["left.frame_b.r_0"], [[1, 1, 0]] * 5, atol=1e-9)
    within("force on the foot, N", np.abs(np.abs(force) - [9.81 / 2, 9.81, 0]).max(), 1e-6)


class Rigid(Model):
    """A loop of rigid bars without any joint."""

    gap: float = structural("how far the bars miss each other in m", default=0.0)
    world = World(g=9.81)
    one, two, three = FixedTranslation(r=(1, 0, 0)), FixedTranslation(r=(0, 1, 0)), FixedTranslation(r=(1, 1, 0))

    @ac.part
    def last(self):
        """Bar that closes the loop, or misses."""
        return BodyRod(r=(1, self.gap, 0), m=1)

    def connections(self):
        yield chain(self.world, self.one, self.two, self.last)
        yield connect(self.world.frame_b, self.three.frame_a)
        yield connect(self.three.frame_b, self.last.frame_a)


def test_loop_without_joints():
    result = ac.simulate(Rigid(), stop_time=1.0, intervals=2)
    # Both ways bear the weight of the rod at the point where they meet.
    total = result["two.frame_b.f"] + result["three.frame_b.f"]
    within("force on both bars, N", np.abs(np.abs(total) - [0, 9.81, 0]).max(), 1e-8)


def test_loop_without_joints_that_misses():
    class Missing(Rigid):
        three = FixedTranslation(r=(1, 1.5, 0))

    with pytest.raises(ac.InitializationError, match=r"0\.5 m[\s\S]*no joint is in the loop"):
        ac.simulate(Missing(), stop_time=1.0)
