"""The search for consistent modes: where it cycles it enumerates modes, the nearest first, and fails when none is left."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, discrete, parameter, piecewise, reinit, time, variable, when
from acausal.solve.initialization.mode_search import ModeSearch
from tests.acausal.solve.saturated import Row, Saturated, Stepped


def then(tried, current, found):
    following = tried.next(np.array(current, dtype=float), np.array(found, dtype=float))
    return None if following is None else following.tolist()


def test_what_is_new_is_tried():
    tried = ModeSearch([0, 1])
    assert then(tried, [0, 0, 7], [0, 0, 7]) == [0, 0, 7]
    assert then(tried, [0, 0, 7], [0, 1, 8]) == [0, 1, 8]
    assert (tried.cycle, tried.changing, tried.count) == ([], [1], 2)


def cycling():
    tried = ModeSearch([0, 1, 2])
    for one in ([0, 0, 0, 7], [1, 0, 1, 7], [0, 1, 1, 7]):
        assert then(tried, one, one) == one
    return tried


def test_in_a_cycle_one_changes_at_a_time_what_no_longer_holds_first():
    tried = cycling()
    assert then(tried, [0, 1, 1, 7], [1, 0, 1, 7]) == [0, 0, 1, 7]
    assert tried.changing == [0, 1]
    assert then(tried, [0, 0, 1, 7], [1, 1, 1, 8]) == [1, 0, 1, 8]


def test_others_beside_a_cycle_are_tried_each_once_what_changes_first():
    tried = cycling()
    assert then(tried, [0, 1, 1, 7], [1, 0, 1, 7]) == [0, 0, 1, 7]
    found = [then(tried, [0, 0, 1, 7], [0, 1, 1, 7]) for _ in range(5)]
    assert found == [[1, 1, 1, 7], [1, 0, 0, 7], [0, 1, 0, 7], [1, 1, 0, 7], None]


def test_what_the_clock_decides_stays():
    tried = ModeSearch([1])
    assert then(tried, [1, 0], [1, 0]) == [1, 0]
    assert then(tried, [1, 0], [1, 1]) == [1, 1]
    assert then(tried, [1, 1], [1, 0]) is None


@pytest.mark.parametrize("stop", [0.1, 0.2, 0.5, 1.0, 3.0])
def test_whether_a_run_starts_does_not_depend_on_its_length(stop):
    result = ac.simulate(Saturated(), stop_time=stop)
    given, k, m = 6 * np.sin(5 * result.time), 0.8, 0.5
    between = given / (m + k)
    expected = np.where(np.abs(m * between) > 2, np.sign(between) * 2 / m, between)
    np.testing.assert_allclose(result["a"], expected, atol=1e-6)


@pytest.mark.parametrize("guess", [-20.0, 0.0, 20.0])
def test_a_start_between_two_limits_is_found_from_either(guess):
    class Guessed(Saturated):
        a: Scalar = variable("acceleration", start=guess)

    assert ac.simulate(Guessed(), stop_time=0.1)["a"][0] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("method", [None, "idas"])
@pytest.mark.parametrize("k", [0.4, 0.8, 3.0])
def test_a_step_from_a_limit_to_between_them(k, method):
    result = ac.simulate(Stepped(), stop_time=1.0, parameters={"k": k}, method=method)
    before = min(4.0, 6 / (0.5 + k))
    np.testing.assert_allclose(result["a"], np.where(result.time < 0.5, before, 0.0), atol=1e-9)
    assert result["v"][-1] == pytest.approx(0.5 * before, abs=1e-6)


def test_a_step_through_several_saturations():
    result = ac.simulate(Row(), stop_time=1.0)
    after = result.time > 0.5
    for name in "abc":
        np.testing.assert_allclose(result[name][after], 0, atol=1e-12)
        np.testing.assert_allclose(result[name][~after][:-1], 4, atol=1e-12)


def test_a_law_that_is_not_monotone_is_found_beside_the_cycle():
    class Rising(Saturated):
        def given(self):
            return 2.0

    result = ac.simulate(Rising(), stop_time=0.1, parameters={"m": 1.0, "k": -1.2})
    np.testing.assert_allclose(result["a"], 2, atol=1e-12)


def test_nothing_acts_at_assignments_that_do_not_fit():
    class Counting(Stepped):
        n: Scalar = discrete("how often both limits are off")

        def equations(self):
            yield from super().equations()
            yield when((self.y < 2) & (self.y > -2), reinit(self.n, self.n + 1))

    assert ac.simulate(Counting(), stop_time=1.0)["n"][-1] == 1


class Contrary(Model):
    """Two conditions that are false where they are true, and true where they are false, from 0.5 s on."""

    late: Scalar = parameter("until when all is well", unit="s", default=0.5)
    x: Scalar = variable("its integral", start=0.0, fixed=True)
    y: Scalar = variable("against itself")
    z: Scalar = variable("against itself, too")

    def equations(self):
        yield der(self.x) == self.y + self.z
        bias = piecewise((9.0, time < self.late), 0.0)
        yield self.y == bias + piecewise((1, self.y < 0), -1)
        yield self.z == bias + piecewise((2, self.z < 0), -2)


def test_what_no_assignment_fits_is_refused_with_the_conditions_that_change():
    with pytest.raises(ac.SimulationError, match=r"(?s)t = 0\.5 s events repeat without end.*switch back and forth"):
        ac.simulate(Contrary(), stop_time=1.0)
    with pytest.raises(ac.InitializationError, match=r"(?s)no consistent positions.*after 4 iterations"):
        ac.simulate(Contrary(), stop_time=1.0, parameters={"late": -1.0})
