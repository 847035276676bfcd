"""Start values of single entries of vectors: fixed((1, None, guess(3)))."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Component,
    DeclarationError,
    InitializationError,
    Model,
    Scalar,
    Vector3,
    chain,
    der,
    fixed,
    guess,
    parameter,
    variable,
)
from components import Body, FreeMotion, Spring, World

INERTIA = np.diag([0.1, 0.2, 0.3])


class Falling(Model):
    world, body = World(gravity=None), Body(m=1, I=INERTIA, w_a=fixed((0, 0, 0)), angles_fixed=True)


def start(**values):
    return Falling(body=Body(m=1, I=INERTIA, w_a=fixed((0, 0, 0)), angles_fixed=True, **values))


def test_open_entries_keep_their_guesses():
    model = start(r_0=fixed((1, None, guess(3))), v_0=fixed((None, 2, None)))
    result = ac.simulate(model, stop_time=1, initial="guesses")
    np.testing.assert_allclose(result["body.r_0"][0], [1, 0, 3], atol=1e-12)
    np.testing.assert_allclose(result["body.r_0"][-1], [1, 2, 3], atol=1e-9)


def test_open_entries_are_missing():
    with pytest.raises(InitializationError, match="4 start values are missing"):
        ac.simulate(start(r_0=fixed((1, None, guess(3))), v_0=fixed((None, 2, None))), stop_time=1)
    with pytest.raises(InitializationError, match="3 start values are missing"):
        ac.simulate(start(r_0=fixed((1, 2, 3)), v_0=fixed((None, None, None))), stop_time=1)


class Hanging(Model):
    """A body on a spring: two coordinates and the acceleration along the third are given."""

    world, spring, body = World(), Spring(c=100), Body(m=1, I=INERTIA)
    joint = FreeMotion(
        r_rel_a=fixed((0, guess(-0.5), 0)),
        v_rel_a=fixed((0, 0, 0)),
        a_rel_a=fixed((None, 0, None)),
        w_rel_a=fixed((0, 0, 0)),
        angles_fixed=True,
    )

    def connections(self):
        yield chain(self.world, self.joint, self.body)
        yield chain(self.world, self.spring, self.body)


def test_what_is_left_open_follows_from_the_acceleration():
    result = ac.simulate(Hanging(), stop_time=1)
    np.testing.assert_allclose(result["body.r_0"], np.tile([0, -9.80665 / 100, 0], (len(result.time), 1)), atol=1e-8)


class Told(Component):
    x: Vector3 = variable("three values, of which the class knows one", unit="m", start=(0, 5, 0), fixed=True)

    def equations(self):
        yield der(self.x) == (1, 1, 1)


class Sized(Model):
    length: Scalar = parameter("length", unit="m", default=2)
    told = Told(x=fixed((length, None, guess(3))))


def test_parameters_and_start_values_of_the_class():
    result = ac.simulate(Sized(), stop_time=1, initial="guesses", parameters={"length": 7})
    np.testing.assert_allclose(result["told.x"][0], [7, 5, 3], atol=1e-9)


def test_entries_of_a_wrong_number_are_refused():
    with pytest.raises(DeclarationError, match=r"start of `body.r_0` has shape \(2,\); it must have shape \(3,\)"):
        ac.compile(start(r_0=fixed((1, None))))
