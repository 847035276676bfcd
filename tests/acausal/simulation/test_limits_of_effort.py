"""Runs that end at a limit of steps or seconds, or because they diverge: with an error that has the result so far."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, der, output, parameter, quantity, reinit, sin, variable, when
from components import BodyShape, Revolute, World
from components.rotational import Torque
from models import FourBar, SimplePendulum
from tests.shared import compiled


class Bouncing(Model):
    """A ball that loses nothing."""

    h: Scalar = variable("height", unit="m", start=1, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)

    def equations(self):
        yield der(self.h) == self.v
        yield der(self.v) == -9.81
        yield when(self.h < 0, reinit(self.v, -self.v))


class Balanced(Model):
    """A pole on a cart, held by a controller whose gain may have the wrong sign."""

    gain: Scalar = parameter("gain", unit="1/s2", default=-50.0)
    damping: Scalar = parameter("damping", unit="1/s", default=2.0)
    phi: Scalar = variable("angle", unit="rad", start=1e-6, fixed=True)
    w: Scalar = variable("its rate", unit="rad/s", start=0, fixed=True)
    y: Scalar = variable("place of the cart", unit="m", start=0, fixed=True)
    v: Scalar = variable("its speed", unit="m/s", start=0, fixed=True)

    def equations(self):
        yield der(self.phi) == self.w
        yield der(self.w) == self.gain * self.phi - self.damping * self.w - quantity(9.81, "1/s2") * sin(self.phi)
        yield der(self.y) == self.v
        yield der(self.v) == quantity(1, "m/s2") * sin(self.phi)


class Arm(Model):
    """The same of components: an arm on a hinge, the torque of a controller, and a slow sensor of the tip."""

    gain: Scalar = parameter("gain", unit="N.m/rad", default=-50.0)
    world = World()
    hinge = Revolute(n=(0, 0, 1), use_axis_flange=True, phi=ac.fixed(-np.pi / 2 + 1e-6), w=ac.fixed(0), d=1.0)
    arm = BodyShape(r=(1, 0, 0), r_CM=(0.5, 0, 0), m=1, I=np.diag([0.1, 0.1, 0.1]))
    controller = Torque()
    phi: Scalar = output("angle from the vertical", unit="rad")
    seen: Scalar = variable("what the sensor shows", unit="m", start=0, fixed=True)

    def connections(self):
        yield chain(self.world, self.hinge, self.arm)
        yield connect(self.controller.flange, self.hinge.axis)

    def equations(self):
        yield self.phi == self.hinge.phi + np.pi / 2
        yield self.controller.tau == self.gain * self.phi
        yield quantity(0.1, "s") * der(self.seen) == self.arm.frame_b.r_0[0] - self.seen


def stopped(model: type[Model], **how: Any) -> ac.Result:
    """Return what a run that ends early has computed."""
    with pytest.raises(ac.SimulationError) as caught:
        ac.simulate(compiled(model), **how)
    result = caught.value.result
    assert isinstance(result, ac.Result)
    assert result.stats.stopped
    assert result.stats.stopped in str(caught.value)
    return result


@pytest.mark.parametrize("method", ["auto", "idas", "rosenbrock"])
@pytest.mark.parametrize(("model", "most"), [(SimplePendulum, 200), (Bouncing, 40), (FourBar, 200)])
def test_a_run_ends_at_its_limit_of_steps(model: type[Model], most: int, method: str) -> None:
    """Steps of all segments count; the rows so far are those of a run without a limit."""
    how: dict[str, Any] = {"stop_time": 50.0, "intervals": 500, "method": method}
    result = stopped(model, max_steps=most, **how)
    assert "max_steps" in result.stats.stopped
    assert result.stats.steps <= most
    assert 0 < result.time[-1] < 50
    whole = ac.simulate(
        compiled(model), **how | {"stop_time": float(result.time[-1]), "intervals": len(result.time) - 1}
    )
    name = "h" if model is Bouncing else whole.outputs[0]
    np.testing.assert_allclose(result[name], whole[name], atol=1e-4)


def test_a_limit_that_is_not_reached_changes_nothing() -> None:
    how: dict[str, Any] = {"stop_time": 5.0}
    plain, limited = (
        ac.simulate(compiled(FourBar), **how, **more) for more in ({}, {"max_steps": 100_000, "max_seconds": 600})
    )
    np.testing.assert_array_equal(plain["j1_phi"], limited["j1_phi"])
    assert limited.stats.stopped is None
    assert limited.stats.steps == plain.stats.steps


@pytest.mark.parametrize("method", ["auto", "idas"])
def test_a_run_ends_at_its_limit_of_seconds(method: str) -> None:
    """It would take a minute."""
    result = stopped(SimplePendulum, stop_time=1e6, intervals=100_000, method=method, max_seconds=0.3)
    assert "max_seconds" in result.stats.stopped
    assert 0 < result.time[-1] < 1e6


@pytest.mark.parametrize("name", ["max_steps", "max_seconds"])
@pytest.mark.parametrize("value", [0, -1, float("nan"), "many"])
def test_a_limit_that_is_none_is_refused(name: str, value: object) -> None:
    with pytest.raises(ac.DeclarationError) as caught:
        ac.simulate(compiled(SimplePendulum), **{name: value})  # type: ignore[arg-type]
    assert f"{name} is {value!r}" in str(caught.value)


@pytest.mark.parametrize(("model", "gain"), [(Balanced, 50.0), (Arm, 20.0)])
def test_a_run_that_diverges_ends_early(model: type[Model], gain: float) -> None:
    """The angle grows from 1e-6 rad by a factor of hundreds in each second, and with it the rate at which its sine turns."""

    def few(_: float, steps: int) -> None:
        assert steps < 200_000

    result = stopped(model, stop_time=10.0, intervals=4000, parameters={"gain": gain}, progress=few)
    assert abs(result["phi"][-1]) > 1.0
    assert result.time[-1] < 6


@pytest.mark.parametrize("model", [Balanced, Arm])
def test_a_good_controller_is_followed_to_the_end(model: type[Model]) -> None:
    result = ac.simulate(compiled(model), stop_time=10.0)
    assert abs(result["phi"][-1]) < 1e-6
    assert result.stats.stopped is None
