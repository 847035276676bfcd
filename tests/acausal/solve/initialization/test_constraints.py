"""How constraints are kept: states chosen by pivots, projection, and equations of one's own."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, der, fixed, guess, output, parts, reinit, variable, when
from components import BodyRod, FixedTranslation, Prismatic, Revolute, World
from models import Bricard, FourBar, NFourBar
from tests.reference import bricard, n_four_bar


@pytest.mark.parametrize(
    "constraints", [*(pytest.param(way, marks=pytest.mark.slow) for way in ("states", "projection")), "auto"]
)
def test_bricard_by_every_way(constraints: str) -> None:
    result = ac.simulate(Bricard(), stop_time=4, tolerance=1e-8, intervals=100, constraints=constraints)
    expected = bricard.point(result.time)
    found = np.column_stack([result[name] for name in "xyz"])
    assert np.abs(found - expected).max() < 1e-5
    kept = "projection" if constraints == "auto" else constraints
    assert result.stats["constraints"] == kept


def test_new_choices_of_states_leave_results_continuous() -> None:
    result = ac.simulate(Bricard(), stop_time=8, tolerance=1e-8, intervals=800, constraints="states")
    assert 1 < result.stats["choices"] <= result.stats["calls"]
    angles = result["joint[0].phi"]
    rates = result["joint[0].w"]
    trapezium = np.diff(result.time) * (rates[1:] + rates[:-1]) / 2
    assert np.abs(np.diff(angles) - trapezium).max() < 1e-5


def test_where_states_last_one_call_is_enough() -> None:
    stats = ac.simulate(FourBar(), stop_time=5, tolerance=1e-8, method="idas").stats
    assert (stats["constraints"], stats["calls"], stats["choices"]) == ("states", 1, 1)


class Pendulum(Model):
    """Point mass on a bar, in Cartesian coordinates with the length as an equation: index 3."""

    x: Scalar = variable("horizontal position", unit="m", start=1.0)
    y: Scalar = variable("vertical position", unit="m", start=0.0, fixed=True)
    u: Scalar = variable("der(x)", unit="m/s")
    v: Scalar = variable("der(y)", unit="m/s", start=0.0, fixed=True)
    pull: Scalar = variable("force of the bar over its length and the mass", unit="1/s2")
    y_out: Scalar = output("vertical position", unit="m")

    def equations(self):
        yield der(self.x) == self.u
        yield der(self.y) == self.v
        yield der(self.u) == -self.pull * self.x
        yield der(self.v) == -self.pull * self.y - 9.81
        yield self.x**2 + self.y**2 == 1
        yield self.y_out == self.y


@pytest.mark.parametrize("constraints", ["states", "projection", "auto"])
def test_pendulum_in_cartesian_coordinates(constraints: str) -> None:
    """No choice of x or y as state lasts for a swing; after two periods the mass is back."""
    period = 2.367841947576237
    result = ac.simulate(Pendulum(), stop_time=2 * period, tolerance=1e-9, intervals=200, constraints=constraints)
    assert np.abs(result["x"] ** 2 + result["y"] ** 2 - 1).max() < 1e-12
    assert result["x"][-1] == pytest.approx(1, abs=1e-5)
    assert result["y"][[0, 50, 100]] == pytest.approx([0, 0, 0], abs=1e-5)
    assert result["y"].min() == pytest.approx(-1, abs=1e-6)
    assert result["x"][50] == pytest.approx(-1, abs=1e-5)
    assert result["x"][100] == pytest.approx(1, abs=1e-5)


def test_length_that_changes_in_time() -> None:
    """A constraint that moves: the mass at the end of a bar that is pulled in keeps its angular momentum."""

    class Pulled(Model):
        x: Scalar = variable("position", start=1.0)
        y: Scalar = variable("position", start=0.0, fixed=True)
        u: Scalar = variable("der(x)")
        v: Scalar = variable("der(y)", start=2.0, fixed=True)
        pull: Scalar = variable("force over length")

        def equations(self):
            yield der(self.x) == self.u
            yield der(self.y) == self.v
            yield der(self.u) == -self.pull * self.x
            yield der(self.v) == -self.pull * self.y
            yield self.x**2 + self.y**2 == (1 - 0.3 * ac.time) ** 2

    result = ac.simulate(Pulled(), stop_time=2, tolerance=1e-9)
    momentum = result["x"] * result["v"] - result["y"] * result["u"]
    assert momentum == pytest.approx(2, abs=1e-6)
    assert np.hypot(result["x"], result["y"]) == pytest.approx(1 - 0.3 * result.time, abs=1e-12)


class Tilted(Model):
    """Parallelogram in an inclined plane: nothing folds away, three constraints are redundant by rank."""

    world = World(g=9.81)
    n = np.array([1.0, 1.0, 1.0]) / np.sqrt(3)
    e = np.array([1.0, -1.0, 0.0]) / np.sqrt(2)
    f = np.cross(n, e)
    j1 = Revolute(n=n, phi=fixed(-2.0), w=fixed(1.5))
    j2 = Revolute(n=(1, 1, 1), phi=guess(2.0))
    j3, j4 = Revolute(n=(1, 1, 1), phi=guess(-2.0)), Revolute(n=(1, 1, 1), phi=guess(-2.0))
    left, right = BodyRod(r=f, m=1), BodyRod(r=f, m=1)
    top, ground = BodyRod(r=2 * e, m=2), FixedTranslation(r=2 * e)

    def connections(self):
        yield chain(self.world, self.j1, self.left, self.j2, self.top, self.j3, self.right.frame_b)
        yield chain(self.world, self.ground, self.j4, self.right)


def test_planar_loop_in_an_inclined_plane() -> None:
    compiled = ac.compile(Tilted())
    result = ac.simulate(compiled, stop_time=3, tolerance=1e-9)
    (loop,) = result.stats["loops"]
    assert (loop["constraints"], loop["redundant"], loop["redundant_by_rank"]) == (6, 3, 3)
    # Two bars turn, the coupler moves with their ends.
    n, e = Tilted.n, Tilted.e
    phi, w = result["j1.phi"], result["j1.w"]
    up = np.array([0, 1.0, 0])
    along, across = up @ np.cross(n, e), up @ e
    height = np.cos(phi) * along - np.sin(phi) * across
    energy = (2 / 3 + 2) * w**2 / 2 + (1 + 2) * 9.81 * height
    assert energy == pytest.approx(energy[0], abs=1e-5)
    assert np.ptp(phi) > 0.5


def test_redundant_slider_beside_a_slider() -> None:
    """Two parallel guides hold one body: five of six constraints are redundant."""

    class Guided(Model):
        world = World(g=9.81, n=(1, 0, 0))
        first, second = Prismatic(s=fixed(0), v=fixed(0)), Prismatic()
        body = BodyRod(r=(0, 1, 0), m=2)
        base = FixedTranslation(r=(0, 1, 0))

        def connections(self):
            yield chain(self.world, self.first, self.body, self.second.frame_b)
            yield chain(self.world, self.base, self.second)

    result = ac.simulate(Guided(), stop_time=1, tolerance=1e-9)
    assert result["first.s"] == pytest.approx(9.81 * result.time**2 / 2, abs=1e-7)
    assert result["second.s"] == pytest.approx(result["first.s"], abs=1e-12)


def test_flat_parallelogram_keeps_all_constraints_and_goes_where_the_velocity_points() -> None:
    class Flat(Model):
        world = World(gravity=None)
        j1 = Revolute(phi=fixed(0), w=fixed(1.0))
        j2, j3 = Revolute(w=guess(-1.0)), Revolute(w=guess(1.0))
        j4 = Revolute(w=guess(1.0))
        left, top, right = BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(2, 0, 0), m=1), BodyRod(r=(1, 0, 0), m=1)
        ground = FixedTranslation(r=(2, 0, 0))

        def connections(self):
            yield chain(self.world, self.j1, self.left, self.j2, self.top, self.j3, self.right.frame_b)
            yield chain(self.world, self.ground, self.j4)
            yield connect(self.j4.frame_b, self.right.frame_a)

    compiled = ac.compile(Flat())
    result = ac.simulate(compiled, stop_time=2, tolerance=1e-8, initial="guesses")
    (loop,) = result.stats["loops"]
    assert loop["singular_start"]
    assert loop["redundant_by_rank"] == 0
    assert result["j1.phi"] == pytest.approx(result.time, abs=1e-3)
    assert result["j4.phi"] == pytest.approx(result.time, abs=1e-3)


class Hanging(NFourBar):
    """The parallelograms, hanging down."""

    @parts
    def foot(self):
        """Joints on the ground, near the lower equilibrium."""
        return [Revolute(phi=guess(np.pi + 0.1)) for _ in range(self.N + 1)]

    @parts
    def pin(self):
        """Joints of the couplers, near it too."""
        return [Revolute(phi=guess((-1) ** (k + 1) * np.pi)) for k in range(2 * self.N)]


@pytest.mark.parametrize("N", [1, 3])
def test_frequency_about_the_equilibrium_of_loops(N: int) -> None:
    linear = ac.linearize(Hanging(N=N), initial="steady")
    inertia, moment = n_four_bar.inertia_and_moment(N)
    assert linear.frequencies_hz == pytest.approx([np.sqrt(moment * 9.81 / inertia) / (2 * np.pi)], rel=1e-6)
    assert len(linear.states) == 2
    assert linear.states[1] == linear.states[0].replace(".phi", ".w")


def test_impact_in_a_loop_takes_all_its_joints_along() -> None:
    """The crank bounces back with half of its speed where the slider is at 0.41 m, and so do slider and rod."""

    class Bouncing(Model):
        world = World(gravity=None)
        bearing = Revolute(phi=fixed(1.5), w=fixed(-5))
        pin, wrist = Revolute(phi=guess(-2)), Revolute()
        crank, rod = BodyRod(r=(0.15, 0, 0), m=1), BodyRod(r=(0.3, 0, 0), m=1)
        guide = Prismatic(s=guess(0.3))

        def connections(self):
            yield chain(self.world, self.bearing, self.crank, self.pin, self.rod, self.wrist, self.guide.frame_b)
            yield connect(self.world.frame_b, self.guide.frame_a)

        def equations(self):
            yield when(self.guide.s > 0.41, reinit(self.bearing.w, -0.5 * self.bearing.w))

    result = ac.simulate(Bouncing(), stop_time=0.5, tolerance=1e-9, intervals=500, energy=True)
    (event,) = result.stats["event_times"]
    before, after = np.searchsorted(result.time, event) + np.array([-1, 0])
    assert result["bearing.w"][after] == pytest.approx(-0.5 * result["bearing.w"][before], rel=5e-2)
    assert result["guide.v"][after] == pytest.approx(-0.5 * result["guide.v"][before], rel=5e-2)
    assert np.abs(result["rod.frame_a.r_0"] - result["pin.frame_b.r_0"]).max() < 1e-12
    phi, w = result["bearing.phi"], result["bearing.w"]
    slope = -0.15 * np.sin(phi) - 0.15**2 * np.sin(phi) * np.cos(phi) / np.sqrt(0.3**2 - (0.15 * np.sin(phi)) ** 2)
    assert result["guide.v"] == pytest.approx(slope * w, abs=1e-9)
    # Three quarters of the energy are gone.
    assert result.stats["energy_dissipated"] == pytest.approx(-result.stats["energy_stored_change"], rel=1e-6)
