"""What is differentiated must not jump: refused at the instant, with the line of the law; what meets goes on."""

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    SimulationError,
    chain,
    der,
    discrete,
    fixed,
    output,
    parameter,
    piecewise,
    reinit,
    time,
    variable,
    when,
)
from components.rotational import Inertia, Position, Speed, Torque


class Driven(Model):
    drive = Position(phi_ref=0)
    wheel = Inertia(J=1.0)

    def connections(self):
        yield chain(self.drive.flange, self.wheel)


def refused(model, at, **options):
    with pytest.raises(
        SimulationError, match=rf"(?s)stopped at t = {at}.*test_jumps\.py:\d+.* jumps by .*piecewise"
    ) as error:
        ac.simulate(model, stop_time=2.0, **options)
    result = error.value.result
    assert result.time[-1] <= at + 1e-9
    return str(error.value)


STEP = piecewise((0, time < 1), 1)
KINK = piecewise((0, time < 1), time - 1)
BEND = piecewise((0, time < 1), (time - 1) ** 2)


@pytest.mark.parametrize("law", [STEP, KINK, piecewise((time, time <= 1), 2 * time)])
def test_angle_that_jumps_or_has_a_kink(law):
    assert "drive (Position)" in refused(Driven(drive=Position(phi_ref=law)), 1)


def test_angle_that_bends():
    result = ac.simulate(Driven(drive=Position(phi_ref=BEND)), stop_time=2.0)
    np.testing.assert_allclose(result["wheel.w"], 2 * np.maximum(result.time - 1, 0), atol=1e-9)


@pytest.mark.parametrize("size", [1e-9, 1e-3, 1e6])
def test_jumps_count_over_the_size_of_the_motion(size):
    assert f"jumps by {size:.4g}" in refused(Driven(drive=Position(phi_ref=piecewise((0, time < 1), size))), 1)
    result = ac.simulate(Driven(drive=Position(phi_ref=size * BEND)), stop_time=2.0)
    np.testing.assert_allclose(result["wheel.w"], 2 * size * np.maximum(result.time - 1, 0), atol=1e-9 * size)


def test_speed_that_jumps_and_speed_with_a_kink():
    wheel = Inertia(J=1.0, phi=fixed(0))
    refused(Driven(drive=Speed(w_ref=STEP), wheel=wheel), 1)
    result = ac.simulate(Driven(drive=Speed(w_ref=KINK), wheel=wheel), stop_time=2.0)
    assert result["wheel.phi"][-1] == pytest.approx(0.5, abs=1e-5)


def test_torque_may_jump():
    wheel = Inertia(J=1.0, phi=fixed(0), w=fixed(0))
    result = ac.simulate(Driven(drive=Torque(tau=STEP), wheel=wheel), stop_time=2.0)
    assert result["wheel.w"][-1] == pytest.approx(1.0, abs=1e-6)


class Differentiated(Model):
    """der() of a law that switches at x = 1, where its cases differ by `step`."""

    step: Scalar = parameter("step", default=1.0)
    x: Scalar = variable("ramp", start=0, fixed=True)
    y: Scalar = output("derivative of the law")

    def equations(self):
        yield der(self.x) == 1
        yield self.y == der(piecewise((self.x, self.x < 1), 3 * self.x - 2 + self.step))


def test_derivative_of_cases_that_do_not_meet():
    compiled = ac.compile(Differentiated())
    assert "jumps by 1" in refused(compiled, 1)
    assert "jumps by 0.25" in refused(compiled, 1, parameters={"step": 0.25})
    result = ac.simulate(compiled, stop_time=2.0, parameters={"step": 1e-12})
    np.testing.assert_allclose(result["y"][[0, -1]], [1, 3], atol=1e-9)


def test_derivative_of_what_a_discrete_variable_changes():
    class Counting(Differentiated):
        gain: Scalar = discrete("gain", start=1)

        def equations(self):
            yield der(self.x) == 1
            yield when(self.x > 1.5, reinit(self.gain, 2))
            yield self.y == der(self.gain * self.x)

    assert "jumps by 1.5" in refused(Counting(), 1.5)
