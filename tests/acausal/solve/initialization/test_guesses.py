"""Guesses reach what is solved for: through aliases, derivatives and orientations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, der, fixed, guess, parameter, structural, variable
from components import Body, BodyBox, FixedTranslation, Revolute, Spring, World


class TwoRoots(Model):
    """A rate with two possible values, 1 and -2."""

    z: Scalar = variable("integral")
    y: Scalar = variable("rate", start=-2.0)

    def equations(self):
        yield self.y**2 + self.y == 2
        yield der(self.z) == self.y


class Renamed(TwoRoots):
    """The guess stands at another name of the rate, in another measure."""

    y: Scalar = variable("rate")
    w: Scalar = variable("-2 y", start=5.0)

    def equations(self):
        yield from super().equations()
        yield self.w == -2 * self.y


class Told(Model):
    """What the instance says counts before what the class says."""

    inner = TwoRoots(y=guess(0.8))


class Twice(Model):
    """A second derivative with two possible values."""

    x: Scalar = variable("coordinate")
    a: Scalar = variable("der(der(x))", start=-2.5)

    def equations(self):
        yield der(der(self.x)) == self.a
        yield self.a**2 + self.a == 2


@pytest.mark.parametrize(
    ("model", "name", "value"), [(TwoRoots, "y", -2), (Renamed, "y", -2), (Told, "inner.y", 1), (Twice, "a", -2)]
)
def test_the_guess_chooses_the_root(model: type[Model], name: str, value: float) -> None:
    result = ac.simulate(model(), stop_time=1, initial="guesses")
    assert result[name] == pytest.approx(value)


ANGLES = (0.3, -0.4, 2.0)


class Tumbling(Model):
    angles: Any = structural("orientation at the start", default=ANGLES)
    sequence: Any = structural("axes", default=(1, 2, 3))
    given: bool = structural("whether it holds", default=False)
    world = World(gravity=None)
    body = Body(
        m=1,
        I=np.diag([1.0, 2.0, 3.0]),
        r_0=fixed((0, 0, 0)),
        v_0=fixed((0, 0, 0)),
        w_a=fixed((1, 2, 3)),
        angles_start=angles,
        sequence_start=sequence,
        angles_fixed=given,
    )


class Boxed(Model):
    """The same as a part of another one, with something welded to it."""

    world = World(gravity=None)
    box = BodyBox(r=(1, 0, 0), width=0.1, density=1000, angles_start=ANGLES)
    tip, mass = FixedTranslation(r=(0, 1, 0)), Body(m=1)

    def connections(self):
        yield connect(self.box.frame_b, self.tip.frame_a)
        yield connect(self.tip.frame_b, self.mass.frame_a)


@pytest.mark.parametrize("sequence", [(1, 2, 3), (3, 1, 2)])
@pytest.mark.parametrize("initial", ["guesses", "fixed"])
def test_the_angles_of_a_free_body_are_its_guess(sequence: tuple[int, ...], initial: str) -> None:
    model = Tumbling(sequence=sequence, given=initial == "fixed")
    result = ac.simulate(model, stop_time=0.01, intervals=1, initial=initial)
    same = ac.simulate(Tumbling(sequence=sequence, given=True), stop_time=0.01, intervals=1)
    assert result["body.frame_a.R.T"] == pytest.approx(same["body.frame_a.R.T"], abs=1e-9)
    assert not np.allclose(result["body.frame_a.R.T"][0], np.eye(3), atol=0.1)


def test_the_angles_of_a_box_are_its_guess() -> None:
    result = ac.simulate(Boxed(), stop_time=0.01, intervals=1, initial="guesses")
    same = ac.simulate(Tumbling(given=True), stop_time=0.01, intervals=1)
    assert result["box.frame_a.R.T"][0] == pytest.approx(same["body.frame_a.R.T"][0], abs=1e-9)


class Hinged(Model):
    world, hinge, body = World(g=9.81), Revolute(phi=fixed(0), w=fixed(0)), Body(m=1, angles_fixed=True)

    def connections(self):
        yield chain(self.world, self.hinge, self.body)


class HingedBox(Hinged):
    body = BodyBox(r=(1, 0, 0), width=0.1, angles_fixed=True, angles_start=(0, 0, 1))


class Welded(Model):
    world, far = World(g=9.81), FixedTranslation(r=(1, 0, 0))
    first, second = Body(m=1, I=np.eye(3)), Body(m=1, angles_fixed=True)

    def connections(self):
        yield connect(self.first.frame_a, self.far.frame_a)
        yield connect(self.far.frame_b, self.second.frame_a)


@pytest.mark.parametrize("model", [Hinged, HingedBox])
def test_fixed_angles_of_a_body_that_is_held_are_refused(model: type[Model]) -> None:
    with pytest.raises(ac.DeclarationError, match=r"angles_fixed=True has no effect.*joint"):
        ac.compile(model())


def test_of_bodies_that_move_together_the_one_with_fixed_angles_tells_them():
    second = Body(m=1, angles_fixed=True, angles_start=(0.3, 0, 0))
    result = ac.simulate(Welded(second=second), stop_time=0.1, initial="guesses")
    turned = [[1, 0, 0], [0, np.cos(0.3), np.sin(0.3)], [0, -np.sin(0.3), np.cos(0.3)]]
    np.testing.assert_allclose(result["first.frame_a.R.T"][0], turned, atol=1e-12)


class Weighted(Model):
    """One condition for two states."""

    a: Scalar = parameter("weight of x", default=1.0)
    b: Scalar = parameter("weight of y", default=1e-3)
    x: Scalar = variable("first", start=3.0)
    y: Scalar = variable("second", start=5.0)

    def equations(self):
        yield der(self.x) == -self.x
        yield der(self.y) == -self.y

    def initial_equations(self):
        yield self.a * self.x + self.b * self.y == 1


def test_which_guess_is_kept_depends_on_no_start_before() -> None:
    model = ac.compile(Weighted())
    first = ac.simulate(model, stop_time=0.1, initial="guesses")
    assert first["x"][0] == pytest.approx(0.995)
    assert first["y"][0] == 5.0
    second = ac.simulate(model, stop_time=0.1, initial="guesses", parameters={"a": 1e-3, "b": 1.0})
    assert second["x"][0] == 3.0
    assert second["y"][0] == pytest.approx(0.997)


class Nothing(Model):
    """No unknown is left."""

    y: Scalar = variable("known", start=1.0)

    def equations(self):
        yield self.y == 2.0


@pytest.mark.parametrize("initial", ["fixed", "guesses", "steady"])
def test_a_model_without_unknowns_starts(initial: str) -> None:
    assert ac.simulate(Nothing(), stop_time=1.0, initial=initial, intervals=2)["y"] == pytest.approx([2.0] * 3)


def test_free_bodies_whose_start_is_given_start_whatever_joins_them():
    """Nothing is left to guess, but ends of the spring coincide at the guesses of the frames, where its force is steep."""
    inertia = ((0.007, -0.0004, -0.001), (-0.0004, 0.0105, 0.0013), (-0.001, 0.0013, 0.0054))

    def free(I: Any, x: float, w: tuple[float, float, float] = (0, 0, 0)) -> Body:
        start = {"r_0": fixed((x, 0, 0)), "v_0": fixed((0, 0, 0)), "w_a": fixed(w)}
        return Body(m=1, I=I, angles_fixed=True, angles_start=(0, 0, 0), **start)

    class Joined(Model):
        world = World(gravity=None)
        a, b = free(inertia, 0, (1, 0, -2)), free(((1, 0, 0), (0, 1, 0), (0, 0, 1)), 1)
        up, down = FixedTranslation(r=(0, 0.2, 0)), FixedTranslation(r=(0, 0, -0.1))
        spring = Spring(c=1, s_unstretched=1)

        def connections(self):
            yield chain(self.a.frame_a, self.up, self.spring, self.down.frame_b)
            yield connect(self.down.frame_a, self.b.frame_a)

    result = ac.simulate(Joined(), stop_time=1e-3, intervals=1)
    arms = np.array([0, 0.2, 0]), np.array([1, 0, -0.1])
    pull = (arms[1] - arms[0]) * (1 - 1 / np.linalg.norm(arms[1] - arms[0]))
    np.testing.assert_allclose(result["a.frame_a.a"][0], pull, atol=1e-12)
    w = np.array([1, 0, -2])
    np.testing.assert_allclose(
        result["a.frame_a.z"][0],
        np.linalg.solve(inertia, np.cross(arms[0], pull) - np.cross(w, inertia @ w)),
        atol=1e-9,
    )
