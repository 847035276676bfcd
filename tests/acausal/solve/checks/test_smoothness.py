"""Laws that are declared smooth: one that jumps where a run switches it is told, one that does not is believed."""

from __future__ import annotations

import pickle
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, der, fixed, piecewise, sin, sqrt, structural, time, variable
from components import Body, LineForce, Prismatic, World
from models import SpinUp
from tests.shared import pairwise

Law = Callable[[Any], Any]


class Driven(Model):
    """x rises from -1 by 1 in a second; y integrates the law."""

    law: Any = structural("function of x")
    x: Scalar = variable("x", start=-1, fixed=True)
    y: Scalar = variable("y", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == 1
        yield der(self.y) == self.law(self.x)


BROKEN: dict[str, tuple[Law, float, str]] = {
    "step": (lambda x: piecewise((5, x > 0.123), 0, smooth=True), 1.123, "5"),
    "of time": (lambda x: piecewise((1, time < 1.234), 2, smooth=True), 1.234, "1"),
    "second of two": (lambda x: piecewise((x, x < 0.5), (0.5, x < 0.8), 1, smooth=True), 1.8, "0.5"),
    "root": (lambda x: piecewise((sqrt(x) + 0.1, x > 0), 0, smooth=True), 1.0, "0.1"),
    "on an output, inclusive": (lambda x: piecewise((x, x <= 0.5), 1, smooth=True), 1.5, "0.5"),
    "tiny": (lambda x: piecewise((1e-9 * x, x > 0), 1e-9, smooth=True), 1.0, "1e-09"),
}
SMOOTH: dict[str, Law] = {
    "power": lambda x: piecewise((x**4, x > 0), 0, smooth=True),
    "odd": lambda x: piecewise((x**2, x > 0), -(x**2), smooth=True),
    "root": lambda x: piecewise((sqrt(x), x > 0), 0, smooth=True),
    "hidden case": lambda x: piecewise((0, x < -0.5), (3, x < -0.5), 0, smooth=True),
    "last case never": lambda x: piecewise((x, x < 0.5), (0.5, x >= 0.5), 100, smooth=True),
    "steep": lambda x: piecewise((1e6 * (x - 0.3), x < 0.3), 1e6 * (x - 0.3) ** 3, smooth=True),
    "of time": lambda x: piecewise((sin(time), time < np.pi), np.pi - time, smooth=True),
    "never reached": lambda x: piecewise((0, x < 50), 1, smooth=True),
}


def _step(x: Any) -> Any:
    return piecewise((5, x > 0.123), 0, smooth=True)


def warned(model: Any, **values: Any) -> list[str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        ac.simulate(model, **values)
    return [str(w.message) for w in caught]


@pytest.mark.parametrize(("intervals", "method", "name"), pairwise([1, 7, 1000], ["idas", "rosenbrock"], BROKEN))
def test_a_jump_is_told_once_with_place_and_mend(name, method, intervals):
    law, at, jump = BROKEN[name]
    (text,) = warned(Driven(law=law), stop_time=3, method=method, intervals=intervals)
    assert text.startswith("Driven, ")
    assert "test_smoothness.py:" in text
    assert f"near t = {at:.4g} s it jumps by {jump};" in text
    assert "Leave `smooth=True` out" in text


@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("intervals", [1, 7, 1000])
def test_what_meets_is_believed(name, intervals):
    assert warned(Driven(law=SMOOTH[name]), stop_time=5, intervals=intervals) == []


class Buffer(LineForce):
    """Pushes back below 0.5 m, at once by a force of its own."""

    def law(self):
        yield self.f == piecewise((-50 - 1000 * (0.5 - self.s), self.s < 0.5), 0, smooth=True)


class Bumper(Model):
    world, rail, buffer = World(gravity=None), Prismatic(n=(1, 0, 0), s=fixed(1), v=fixed(-1)), Buffer()
    body = Body(m=1)

    def connections(self):
        yield chain(self.world, self.rail, self.body)
        yield connect(self.world.frame_b, self.buffer.frame_a)
        yield connect(self.rail.frame_b, self.buffer.frame_b)


def test_the_path_of_the_part_is_named():
    (text,) = warned(Bumper(), stop_time=0.7)
    assert text.startswith("buffer (Buffer), ")
    assert "near t = 0.5 s it jumps by 50" in text


def test_other_parameters_and_pickles():
    compiled = pickle.loads(pickle.dumps(ac.compile(Driven(law=_step))))
    assert len(warned(compiled, stop_time=3)) == 1
    assert warned(compiled, stop_time=1) == []


def test_a_smooth_scene_is_silent():
    assert not [text for text in warned(SpinUp(volumes=1, ramp=1.0), stop_time=2, tolerance=1e-4) if "smooth" in text]
