"""Implicit laws that bend within a hair's breadth: the states alone do not tell a step that unknowns stayed behind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import acausal as ac
from acausal import Model, Scalar, atan2, der, parameter, sin, sqrt, tanh, time, variable

LAWS: dict[str, Callable[[Any, Any], Any]] = {
    "stop": lambda o, z: o.atan2(1e4 * z, 1),
    "friction": lambda o, z: 2 * o.tanh(1e3 * z),
    "saturation": lambda o, z: 2 * o.tanh(1e5 * z),
    "root": lambda o, z: z / o.sqrt(o.sqrt(z * z + 1e-8)),
}


class Symbolic:
    """Functions of the language."""

    atan2, tanh, sqrt, sin = atan2, tanh, sqrt, sin


class Numeric:
    """Functions of numbers."""

    atan2, tanh, sqrt, sin = np.arctan2, np.tanh, np.sqrt, np.sin


def drive(o: Any, t: Any) -> Any:
    """What pulls to both sides."""
    return 3 * o.sin(0.7 * t) + o.sin(2.3 * t)


class Kinked(Model):
    """A state that an unknown pulls, which a bent law ties to both."""

    law = "stop"
    linear: Scalar = parameter("stiffness beside the law", default=0.3)
    pull: Scalar = parameter("of the unknown on the state", default=0.5)
    x: Scalar = variable("state", fixed=True)
    z: Scalar = variable("unknown")

    def equations(self):
        yield LAWS[self.law](Symbolic, self.z) + self.linear * self.z == drive(Symbolic, time) - self.x
        yield der(self.x) == tanh(self.z) * self.pull - self.x


def exact(law: str, linear: float, pull: float, times: np.ndarray) -> np.ndarray:
    def unknown(t: float, x: float) -> float:
        return brentq(
            lambda z: LAWS[law](Numeric, z) + linear * z - drive(Numeric, t) + x,
            -1e4,
            1e4,
            xtol=1e-15,
            rtol=1e-14,
            maxiter=500,
        )

    def rate(t: float, x: np.ndarray) -> list[float]:
        return [np.tanh(unknown(t, float(x[0]))) * pull - x[0]]

    found = solve_ivp(
        rate, (times[0], times[-1]), [0.0], method="LSODA", rtol=1e-11, atol=1e-13, t_eval=times, max_step=0.01
    )
    return found.y[0]


@pytest.mark.parametrize(
    ("law", "linear"),
    [
        *((law, 0.3) for law in LAWS),
        *(pytest.param(law, 0.2, marks=pytest.mark.slow) for law in LAWS),
        pytest.param("saturation", 1e-3, marks=pytest.mark.slow),
    ],
)
def test_the_error_is_that_of_the_tolerance(law: str, linear: float) -> None:
    compiled = ac.compile(type(law, (Kinked,), {"law": law})())
    pull = 0.8
    for method in ("auto", "rosenbrock"):
        for tolerance in (1e-4, 1e-5, 1e-6, 1e-7):
            run = ac.simulate(
                compiled,
                stop_time=12.0,
                intervals=120,
                method=method,
                tolerance=tolerance,
                parameters={"linear": linear, "pull": pull},
            )
            error = np.abs(run["x"] - exact(law, linear, pull, run.time)).max()
            assert error < 50 * tolerance, (method, tolerance, error)


@pytest.mark.parametrize("method", ["auto", "idas"])
@pytest.mark.parametrize("law", LAWS)
def test_what_is_read_satisfies_the_law(law: str, method: str) -> None:
    given: dict[str, Any] = {"method": method, "tolerance": 1e-7, "parameters": {"linear": 0.02, "pull": 0.8}}
    run = ac.simulate(type(law, (Kinked,), {"law": law})(), stop_time=3.0, intervals=600, **given)
    left = LAWS[law](Numeric, run["z"]) + 0.02 * run["z"] - drive(Numeric, run.time) + run["x"]
    np.testing.assert_allclose(left, 0, atol=4e-7)
