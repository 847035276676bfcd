"""Where the solution of algebraic equations ends, a run does, whatever its method; where it goes on, so does a run."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, atan2, chain, cos, der, fixed, guess, parameter, sin, time, variable
from components import Body, Revolute, World
from tests.shared import pairwise


class Implicit(Model):
    """A state, and an unknown that follows from it."""

    x: Scalar = variable("state")
    z: Scalar = variable("what follows")


class Fold(Implicit):
    """Two branches beside one that leads from one to the other; the upper one begins where the lower one ends, at x = 2."""

    rate: Scalar = parameter("rate of the state", default=1.0)

    def equations(self):
        yield self.z**3 - 3 * self.z == self.x
        yield der(self.x) == self.rate


class FoldBack(Implicit):
    """The same, with a state that depends on the branch."""

    def equations(self):
        yield self.z**3 - 3 * self.z == self.x
        yield der(self.x) == self.z + 4


class FoldAfterSteep(Implicit):
    """A fold behind an instant at which another unknown leaves more between steps than the fold does."""

    s: Scalar = variable("steep, but continuous")

    def equations(self):
        yield self.z**3 - 3 * self.z == self.x
        yield self.s + 0.1 * sin(self.s) == atan2(1e4 * (time - 0.5317), 1)
        yield der(self.x) == 1


class Sine(Implicit):
    """No solution after 1 s."""

    def equations(self):
        yield sin(self.z) == time
        yield der(self.x) == self.z


class Gap(Implicit):
    """No solution for a while."""

    def equations(self):
        yield sin(self.z) == 1.05 * sin(time)
        yield der(self.x) == self.z - self.x


ENDS = [
    (Fold(x=fixed(-2.0), z=guess(-2.0)), 4.0),
    (FoldBack(x=fixed(-2.0), z=guess(-2.0)), 1.7461),
    (FoldAfterSteep(x=fixed(-2.0), z=guess(-2.0)), 4.0),
    (Sine(x=fixed(0.0)), 1.0),
    (Gap(x=fixed(0.0)), float(np.arcsin(1 / 1.05))),
]


WORDS = r"no solution|could not be solved|no step was short enough"


@pytest.mark.parametrize(
    ("case", "method", "intervals", "tolerance"),
    pairwise(range(len(ENDS)), ["auto", "rosenbrock", "idas"], [1, 10, 400], [1e-3, 1e-6, 1e-9]),
)
def test_a_run_ends_where_its_solution_does(case, method, intervals, tolerance):
    model, end = ENDS[case]
    with pytest.raises(ac.SimulationError, match=WORDS) as caught:
        ac.simulate(model, stop_time=5.0, tolerance=tolerance, intervals=intervals, method=method)
    rows = caught.value.result
    assert rows.time[-1] <= end + 0.1
    if method == "auto":
        assert abs(float(str(caught.value).split("t = ")[1].split(" ")[0]) - end) < 0.08


class Steep(Implicit):
    """A law that rises within 1e-6 s."""

    def equations(self):
        yield self.z + 0.1 * sin(self.z) == atan2(1e6 * (time - 0.5317), 1)
        yield der(self.x) == self.z


class Bent(Implicit):
    def equations(self):
        yield self.z + 0.5 * sin(self.z) == 5 * sin(3 * time)
        yield der(self.x) == self.z - self.x


class Large(Implicit):
    """Far larger than its nominal value."""

    def equations(self):
        yield 1e-9 * self.z + 1e-12 * cos(self.z / 1e8) == sin(time)
        yield der(self.x) == 1e-9 * self.z


class Growing(Implicit):
    """Faster than some steps may resolve."""

    def equations(self):
        yield self.z + 0.1 * sin(self.z) == 3 * self.x
        yield der(self.x) == self.z - sin(time)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7])
@pytest.mark.parametrize("intervals", [1, 200])
@pytest.mark.parametrize(
    "model",
    [
        Fold(x=fixed(-2.0), z=guess(-2.0), rate=0.7),
        Steep(x=fixed(0.0)),
        Bent(x=fixed(0.0)),
        Large(x=fixed(0.0)),
        Growing(x=fixed(1.0)),
    ],
)
def test_steep_bent_and_large_unknowns_are_no_end(model, intervals, tolerance):
    how = {"stop_time": 5.0, "tolerance": tolerance, "intervals": intervals}
    found, other = (ac.simulate(model, method=method, **how) for method in ("rosenbrock", "idas"))
    assert found.stats.method == "rosenbrock"
    np.testing.assert_allclose(found["x"], other["x"], rtol=1e3 * tolerance, atol=1e3 * tolerance)


def test_a_run_without_states_ends_there_and_keeps_what_it_found():
    class Alone(Model):
        z: Scalar = variable("what time tells")

        def equations(self):
            yield sin(self.z) == time

    with pytest.raises(
        ac.SimulationError, match=r"stopped at t = (0\.99\d*|1\.\d*) s: .*no solution[^$]*test_branches"
    ) as caught:
        ac.simulate(Alone(), stop_time=1.5, intervals=50)
    found = caught.value.result
    assert found.time[-1] == pytest.approx(0.99)
    np.testing.assert_allclose(found["z"], np.arcsin(found.time), atol=1e-12)


class Rotor(Model):
    """A body out of balance that turns freely about an oblique hinge: terms of its acceleration cancel, and rounding is left."""

    world = World(gravity=None)
    hinge = Revolute(n=(1, 2, 3), phi=fixed(0.77), w=fixed(-1.84))
    body = Body(m=3.6, r_CM=(0.05, 0.23, 0.1), I=np.diag([0.4, 0.45, 0.5]))

    def connections(self):
        yield chain(self.world, self.hinge, self.body)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("method", ["auto", "rosenbrock"])
def test_what_is_left_of_terms_that_cancel_is_no_jump(method: str, tolerance: float) -> None:
    run = ac.simulate(Rotor(), stop_time=2.0, method=method, tolerance=tolerance)
    assert run.stats.method == "rosenbrock"
    np.testing.assert_allclose(run["hinge.phi"], 0.77 - 1.84 * run.time, atol=1e-12)
