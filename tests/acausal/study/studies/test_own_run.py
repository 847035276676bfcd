"""Formulations that bring a run of their own."""

from __future__ import annotations

import re
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

import acausal as ac
from acausal import DeclarationError, Formulation, SimulationError
from acausal.cli import app
from acausal.study import Case, processes
from tests.acausal.study import stepped
from tests.acausal.study.stepped import Stepped, steps

FEW = {"tolerances": (1e-4, 1e-6), "repeats": 1, "intervals": 20}


def study(*formulations: Formulation, **options):
    with ThreadPoolExecutor(1) as pool:
        return ac.study(Stepped(), **{**FEW, "executor": pool, "formulations": formulations or None} | options)


def euler(rate: float, h: float) -> float:
    t = np.linspace(0, 2, 21)
    return np.abs((1 - rate * h) ** (t / h) - np.exp(-rate * t)).max() / (1 - np.exp(-2 * rate))


@pytest.fixture(scope="module")
def found():
    """With a reference that tells an error of 1e-6, the least here."""
    with processes(2) as executor:
        return ac.study(Stepped(), **FEW, executor=executor, accuracy=1e-7)


def rows(found, name):
    return [row for row in found.rows if row.case.formulation == name]


def test_steps_and_tolerances_are_swept(found):
    assert not [row.remark for row in found.rows if row.remark]
    assert [row.case.dt for row in rows(found, "Euler")] == [0.1, 0.05, 0.025]
    assert [row.case.tolerance for row in rows(found, "exact")] == [1e-4, 1e-6]
    for row in rows(found, "Euler"):
        assert row.error == pytest.approx(euler(1.0, row.case.dt), rel=1e-3)
        assert (row.limit, row.measurement.steps) == ("step", round(2 / row.case.dt))
        assert row.seconds <= 1e-5 * row.measurement.steps
    coarse, fine = rows(found, "midpoint")
    assert 1.95 < np.log2(coarse.error / fine.error) < 2.15
    assert [row.limit for row in rows(found, "exact")] == ["tolerance", "tolerance"]
    assert rows(found, "exact")[0].error == pytest.approx(1e-4 / (1 - np.exp(-2)), rel=0.05)
    assert rows(found, "exact")[0].seconds > 0


def test_the_reference_is_of_the_engine(found):
    assert found.reference.case.formulation == "engine"
    assert found.reference.floor < 1e-7


def test_tables_tell_steps(found, tmp_path):
    assert "tolerance," in found.table()
    assert "0.025 s" in found.table()
    found.to_csv(tmp_path / "a.csv")
    table = pd.read_csv(tmp_path / "a.csv")
    own = table["formulation"].isin(["Euler", "midpoint"])
    assert table["dt"].notna().tolist() == own.tolist()
    assert table["tolerance"].isna().tolist() == own.tolist()
    found.to_markdown(tmp_path / "a.md")
    found.plot(tmp_path / "a.png")
    assert str(rows(found, "Euler")[0].case) == "Euler, dt 0.1 s"


def test_other_steps_and_parameters():
    found = study(*Stepped.formulations[:2], dt=[0.2, 0.04], parameters={"rate": 0.5})
    assert [row.case.dt for row in rows(found, "Euler")] == [0.2, 0.04]
    # The outputs are 0.1 s apart, so that steps are shortened to that, and to a third of it.
    assert [row.measurement.steps for row in rows(found, "Euler")] == [20, 60]
    assert rows(found, "Euler")[0].error == pytest.approx(euler(0.5, 0.1), rel=1e-3)


def test_steps_that_were_shortened_are_compared_by_their_number():
    """0.1 s and 0.02 s, where 0.4 s was asked for: by the steps that were asked for the finer one would seem to be converged."""
    found = study(*Stepped.formulations[:2], dt=[0.4, 0.02])
    assert [row.measurement.steps for row in rows(found, "Euler")] == [20, 100]
    assert [row.limit for row in rows(found, "Euler")] == ["step", "step"]


def test_switches_reach_the_run():
    found = study(*Stepped.formulations[:2], switches={"rate": [1.0, 2.0]}, reference=None)
    assert {row.case.settings["rate"] for row in rows(found, "Euler")} == {1.0, 2.0}
    own = [row for row in rows(found, "Euler") if row.case.settings["rate"] == 2.0]
    assert max(row.error for row in own) > 0.1  # the reference has the rate of the model


def test_a_reference_of_steps_alone():
    """They are halved until they no longer change it."""
    found = study(Stepped.formulations[2], accuracy=1e-5)
    assert found.reference.case.dt == 0.05 / 2**3
    assert found.reference.floor <= 1e-5
    assert list(found.reference.agreement) == ["longer steps"]
    h = np.array([row.case.dt for row in found.rows])
    np.testing.assert_allclose([row.error for row in found.rows], euler_of_order_2(h), rtol=0.02)
    coarse = study(Stepped.formulations[1], accuracy=1e-9)
    assert "1e-09 was requested but not reached" in str(coarse.reference)


def euler_of_order_2(h):
    t = np.linspace(0, 2, 21)
    found = (1 - h[:, None] + h[:, None] ** 2 / 2) ** (t / h[:, None])
    return np.abs(found - np.exp(-t)).max(axis=1) / (1 - np.exp(-2))


def test_a_reference_of_a_run_with_a_tolerance():
    found = study(Formulation("exact", run=stepped.exact))
    assert list(found.reference.agreement) == ["looser tolerance"]
    assert found.reference.values["x"] == pytest.approx(2 * np.exp(-found.reference.times), rel=1e-6)


def test_gaps_of_other_models_are_told():
    def off(model, stop_time, times, dt):
        return ac.result_of(times, {"s": np.exp(-times) + 0.01 * times * (1 + dt / 100)}, model=model)

    found = study(Formulation("engine"), Formulation("off", run=off, dt=(0.1, 0.01)))
    assert [row.limit for row in rows(found, "off")] == ["model", "model"]
    (gap,) = found.gaps()
    assert gap.startswith("off: converges to another solution; its smallest error is 2.3e-02 of the range")
    assert gap in found.table()


@pytest.mark.parametrize(
    ("run", "words"),
    [
        (stepped.failing, "this run knows why it cannot"),
        (stepped.broken, r"the run of formulation `bad` ended with KeyError: 'nothing' \(.*stepped.py:\d+\)"),
        (stepped.other, "returned .*; it must return a Result"),
        (stepped.short, "returned 8 times up to 2 s; it must return the times .*: 21 up to 2 s"),
        (stepped.alone, "without `x`: it must contain all compared outputs"),
        (stepped.wild, "`x` is not finite from t = 1 s on"),
    ],
)
def test_runs_that_go_wrong_are_told(run, words):
    found = study(Formulation("engine"), Formulation("bad", run=run))
    assert all(re.search(words, row.remark) for row in rows(found, "bad"))
    assert all("\n" not in row.remark for row in rows(found, "bad"))
    assert not [row.remark for row in rows(found, "engine") if row.remark]


def test_without_a_reference():
    with pytest.raises(SimulationError, match=r"there is no reference: bad.* this run knows why"):
        study(Formulation("bad", run=stepped.failing))
    with pytest.raises(SimulationError, match=r"there is no reference: bad, dt 0.1 s.* at order 3"):
        study(Formulation("bad", run=partial(cubic, order=3), dt=(0.1,)))


def cubic(model, stop_time, times, dt, order):
    raise SimulationError(f"no steps at order {order}")


@pytest.mark.slow
def test_a_run_that_takes_too_long_is_stopped():
    """In processes by an alarm; in threads, where there is none, when it reports its progress."""
    slow = Formulation("slow", run=stepped.slow)
    for limit, workers in ((0.5, {}), (4, {"executor": None, "workers": 1})):
        found = study(Formulation("engine"), slow, limit=limit, tolerances=(1e-4,), **workers)
        assert [row.remark for row in rows(found, "slow")] == [f"it was stopped after {limit:g} s"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"run": 3}, "run is 3; it must be a function"),
        ({"run": stepped.exact, "dt": (0.1,)}, r"must be called as run\(model, stop_time, times, dt=...\)"),
        ({"run": steps}, r"must be called as run\(model, stop_time, times, tolerance=...\): missing"),
        ({"dt": (0.1,)}, "dt needs an integrator of its own"),
        ({"run": steps, "dt": 0.1}, "dt is 0.1; it must be a list of steps"),
        ({"run": steps, "dt": (0.1, -1)}, "dt has -1; a step is"),
        ({"run": steps, "dt": (0.1, True)}, "dt has True; a step is"),
        ({"run": steps, "dt": (0.1, np.inf)}, "dt has inf; a step is"),
        ({"run": steps, "dt": "fine"}, "dt is 'fine'"),
    ],
)
def test_wrong_formulations(options, words):
    with pytest.raises(DeclarationError, match=words):
        Formulation("wrong", **options)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"dt": [0.1]}, "dt has no effect: no formulation has steps of its own"),
        ({"dt": []}, "dt has no effect: it is empty"),
        ({"dt": [0]}, "dt has 0; a step is"),
        ({"dt": 0.1}, "dt is 0.1; it must be a list"),
    ],
)
def test_wrong_steps(options, words):
    forms = Stepped.formulations[: 1 if options["dt"] == [0.1] else 2]
    with pytest.raises(DeclarationError, match=words):
        study(*forms, **options)


def test_what_no_worker_can_be_sent():
    lock = threading.Lock()

    def held(model, stop_time, times, tolerance):
        return lock

    with pytest.raises(DeclarationError, match=r"formulation `held`: the run: .*`.*lock"):
        study(Formulation("held", run=held))


def test_functions_of_a_function_are_sent():
    factor = 3.0

    def own(model, stop_time, times, tolerance):
        return ac.result_of(times, {"s": factor * np.exp(-times)}, model=model)

    found = study(Formulation("engine"), Formulation("own", run=own), executor=None, workers=1)
    assert rows(found, "own")[0].error == pytest.approx(2 / (1 - np.exp(-2)), rel=1e-3)


def test_keys_tell_runs_apart():
    def made(k, name="run"):
        def run(model, stop_time, times, tolerance):
            return k

        run.__qualname__ = name
        return run

    cases = [
        Case("a"),
        Case("a", dt=0.1),
        Case("a", run=steps, dt=0.1),
        Case("a", run=partial(steps, order=2), dt=0.1),
        Case("a", run=partial(steps, order=2), dt=0.05),
        Case("a", run=partial(steps, dt=made(1)), dt=0.1),
        Case("a", run=partial(steps, dt=made(2)), dt=0.1),
        Case("a", run=made(1)),
        Case("a", run=made(2)),
        Case("a", run=stepped.exact),
    ]
    assert len({case.key for case in cases}) == len(cases)
    assert replace(cases[4]).key == cases[4].key
    assert Case("a", run=made(1)).key == cases[7].key


def test_an_interrupted_study_goes_on(tmp_path):
    """Runs that are known are not run again; those of another function of this name are."""
    path, forms = tmp_path / "a.journal", (Formulation("engine"), Stepped.formulations[1])
    ran = []

    def stop(done, wanted, what):
        ran.append(done)
        if done == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        study(*forms, journal=path, progress=stop)
    ran.clear()
    study(*forms, journal=path, progress=lambda done, wanted, what: ran.append(done))
    assert ran[0] == 4
    assert not path.exists()


FILE = Path(stepped.__file__).read_text()
FAST = ("--tolerances", "1e-4", "--repeats", "1", "--intervals", "20", "--workers", "1")


def test_command(tmp_path, monkeypatch):
    """Of a file that workers cannot import."""
    (tmp_path / "mine.py").write_text(FILE)
    monkeypatch.chdir(tmp_path)
    run = partial(CliRunner().invoke, app)
    done = run(["study", "mine.py:Stepped", *FAST, "--dt", "0.1,0.02", "--csv", "a.csv"])
    assert done.exit_code == 0, done.stderr
    table = pd.read_csv("a.csv")
    assert table["dt"].dropna().tolist() == [0.1, 0.02, 0.1, 0.02]
    assert table["remark"].isna().all()
    done = run(["study", "mine.py:Stepped", *FAST, "--formulation", "engine", "--dt", "0.1"])
    assert (done.exit_code, "no formulation has steps of its own" in done.stderr) == (2, True)
    done = run(["study", "mine.py:Stepped", *FAST, "--dt", "0.1,a"])
    assert (done.exit_code, "--dt takes comma-separated values" in done.stderr) == (2, True)
