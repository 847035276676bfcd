"""Which method a run takes, and why."""

from __future__ import annotations

import pickle
from copy import deepcopy

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, fixed, output, reinit, time, variable, when
from acausal.errors import DeclarationError
from acausal.solve.integrate import methods
from acausal.solve.integrate.order import eigenvalues_of
from components.rotational import Damper
from models import FourBar, NFourBar
from tests.reference import four_bar


class Spring(Model):
    x: Scalar = output("displacement")
    v: Scalar = variable("its rate")

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -self.x


def spring(**options):
    return ac.simulate(Spring(x=fixed(1.0), v=fixed(0.0)), stop_time=10.0, intervals=20, **options)


def test_auto_begins_with_the_one_step_method():
    stats = spring(tolerance=1e-8).stats
    assert (stats.method, stats.damped) == ("rosenbrock", False)
    assert stats.method_steps == {"rosenbrock": stats.steps}
    assert "less time" in stats.method_reason


@pytest.mark.parametrize(
    ("options", "method", "reason"),
    [
        ({"method": "idas"}, "idas", "given"),
        ({"method": "resolve"}, "idas", "given"),
        ({"method": "rosenbrock"}, "rosenbrock", "given"),
        ({"max_order": 3}, "idas", "order has a limit"),
    ],
)
def test_what_is_asked_for_is_taken(options, method, reason):
    stats = spring(**options).stats
    assert stats.method == method
    assert reason in stats.method_reason
    assert stats.damped == (method == "rosenbrock")


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
@pytest.mark.parametrize("method", ["auto", "idas"])
def test_errors_follow_the_tolerance(method, tolerance):
    result = spring(method=method, tolerance=tolerance)
    assert np.max(np.abs(result["x"] - np.cos(result.time))) < 100 * tolerance


def test_flat_positions_are_crossed():
    stats = ac.simulate(NFourBar(), stop_time=2.0, tolerance=1e-5).stats
    assert (stats.method, stats.loosened_at) == ("rosenbrock", [])


class Undamped(FourBar):
    """The four-bar without its damper: it swings for ever."""

    damper = Damper(d=0)


def test_errors_that_lead_off_the_constraints_do_not_add_up():
    result = ac.simulate(Undamped(), stop_time=100.0, tolerance=1e-6, intervals=200)
    reference = four_bar.FourBar(damping=0.0)
    energy = np.array([reference.energy(*pair) for pair in zip(result["j1_phi"], result["j1_w"], strict=True)])
    exchanged = abs(max(reference.energy(phi, 0.0) for phi in np.linspace(0, 2 * np.pi, 100)) - energy[0])
    assert np.abs(energy - energy[0]).max() < 1e-4 * exchanged


class Fast(Spring):
    """1600 periods in a second."""

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -1e8 * self.x


class Driven(Model):
    """A law that turns four times between two outputs, and nothing that vibrates by itself."""

    x: Scalar = output("what follows it")

    def equations(self):
        yield der(self.x) == 50 * ac.cos(50 * time) - (self.x - ac.sin(50 * time))


@pytest.mark.parametrize("watched", [False, True])
def test_what_takes_as_many_steps_and_does_not_vibrate_is_followed(watched):
    class Watched(Driven):
        def equations(self):
            yield from super().equations()
            yield when(time >= 150, reinit(self.x, self.x + 1))

    result = ac.simulate((Watched if watched else Driven)(x=fixed(0.0)), stop_time=200.0, intervals=400, tolerance=1e-3)
    assert result.stats.steps > 400 * 12  # 150 sqrt(1000) / 400 of them are allowed where something vibrates
    assert (result.stats.method, result.stats.damped) == ("rosenbrock", False)
    jump = np.where(result.time >= 150, np.exp(np.minimum(150 - result.time, 0)), 0) if watched else 0
    np.testing.assert_allclose(result["x"], np.sin(50 * result.time) + jump, atol=0.05)


def test_eigenvalues_are_found_when_they_are_read(monkeypatch):
    asked, found = [], eigenvalues_of
    monkeypatch.setattr("acausal.solve.integrate.order.eigenvalues_of", lambda *of: asked.append(1) or found(*of))
    result = spring(tolerance=1e-6)
    assert result.stats.steps > 0
    assert "steps" in dict.fromkeys(result.stats)
    before = len(asked)
    other, copied = pickle.loads(pickle.dumps(result)), deepcopy(result)
    for stats in (result.stats, result.stats, other.stats, copied.stats, result.with_stats(stopped="here").stats):
        assert stats.fastest_rate == stats["fastest_rate"] == pytest.approx(1.0)
        assert (stats.max_order, stats.order_reason) == (5, "no oscillation is both fast and lightly damped")
        assert dict(stats)["max_order"] == 5
    assert (before, len(asked)) == (0, 1)


def test_too_many_vibrations_are_damped_unless_digits_are_asked_for():
    compiled = ac.compile(Fast(x=fixed(1.0), v=fixed(0.0)))
    loose, fine = (ac.simulate(compiled, stop_time=1.0, tolerance=t, intervals=5).stats for t in (1e-3, 1e-9))
    assert (loose.damped, fine.damped) == (True, False)
    assert "damps vibrations" in loose.method_reason


def test_without_idas_the_others_work(monkeypatch):
    monkeypatch.setattr(methods, "why_no_idas", lambda: "it was not found")
    assert "idas" not in methods.chosen("auto")
    assert methods.chosen("rosenbrock") == ("rosenbrock",)
    for given in (("idas", None), ("resolve", None), ("auto", 2)):
        with pytest.raises(DeclarationError, match="IDAS cannot be used: it was not found; take method="):
            methods.chosen(*given)
