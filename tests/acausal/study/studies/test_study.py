"""Whole studies of a model whose errors are known, by real workers."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal.errors import DeclarationError
from acausal.study import cluster, processes
from tests.acausal.study import decay
from tests.acausal.study.decay import Decay, study
from tests.shared import heed_interrupts

ROOT = Path(__file__).parents[4]


@pytest.fixture(scope="module")
def found():
    return study(accuracy=1e-3)


def errors(found, formulation, size, tolerance=1e-7):
    (row,) = [
        r for r in found.rows if (r.case.formulation, r.case.size, r.case.tolerance) == (formulation, size, tolerance)
    ]
    return row


def test_errors_are_those_of_the_formulas(found):
    span = 1 - np.exp(-2)
    for formulation, size, error in (("square", "4", 4**-2), ("square", "8", 8**-2), ("fourth", "4", 4**-4)):
        row = errors(found, formulation, size)
        assert row.error == pytest.approx(error / span, rel=0.02)
        assert row.limit == "elements"
    assert errors(found, "off", "8").error == pytest.approx(0.05 / span, rel=0.01)
    assert errors(found, "off", "8").limit == "model"


def test_reference_is_known_as_asked(found):
    assert found.reference.floor <= 1e-3
    assert found.reference.case.formulation == "fourth"
    assert found.reference.values["x"] == pytest.approx(np.exp(-found.reference.times), abs=1e-4)


def test_a_formulation_that_diverges_is_marked(found):
    rows = [row for row in found.rows if row.case.formulation == "unstable"]
    assert len(rows) == 2
    assert all(row.remark.startswith("it diverged") for row in rows)
    assert len(found.rows) == 14


def test_files(found, tmp_path):
    found.to_csv(tmp_path / "a.csv")
    found.to_markdown(tmp_path / "a.md")
    lines = (tmp_path / "a.csv").read_text().splitlines()
    assert len(lines) == 15
    assert lines[0].startswith(
        "formulation,size,tolerance,max_order,method,constraints,error,rms,error x,rms x,compile_s"
    )
    text = (tmp_path / "a.md").read_text()
    assert text.startswith("reference: fourth, ")
    assert text.count("\n| ") == 16
    assert "| unstable |  |" in text
    assert found.document()["reference"]["known_to"]["x"] == found.reference.floor


def test_orders_switches_and_a_table_as_reference(tmp_path):
    ac.simulate(Decay(kind="fourth", n=20), stop_time=2, intervals=20, tolerance=1e-9).to_csv(tmp_path / "r.csv")
    found = study(
        formulations=Decay.formulations[:1],
        max_orders=(None, 2),
        switches={"rate": (1.0, 1.1)},
        reference=tmp_path / "r.csv",
        tolerances=(1e-6,),
    )
    assert len(found.rows) == 2 * 2 * 2
    assert {(r.case.max_order, r.case.settings["rate"]) for r in found.rows} == {
        (None, 1.0), (None, 1.1), (2, 1.0), (2, 1.1)
    }  # fmt: skip
    assert str(found.reference) == f"reference: {tmp_path / 'r.csv'}"
    assert "rate" in found.columns
    assert min(r.error for r in found.rows if r.case.settings["rate"] == 1.1) > 0.02


@pytest.mark.parametrize(
    "workers",
    [
        pytest.param(processes, id="processes"),
        pytest.param(lambda n: cluster("local", n), id="dask", marks=pytest.mark.slow),
    ],
)
def test_two_workers(workers):
    few = {"formulations": Decay.formulations[:2], "tolerances": (1e-5,), "accuracy": 1e-2}
    with workers(2) as executor:
        places = {future.result() for future in [executor.submit(_place) for _ in range(4)]}
        found = study(**few, executor=executor)
    assert len(places - {os.getpid()}) == 2
    assert all(not row.remark for row in found.rows)
    assert found.reference.floor <= 1e-2


def _place() -> int:
    time.sleep(0.5)
    return os.getpid()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"outputs": ["y"]}, "there is no `y` in the model"),
        ({"tolerances": (2.0,)}, "tolerances has 2.0; it must lie between 1e-12 and 1"),
        ({"tolerances": ()}, "tolerances is empty; give at least one"),
        ({"max_orders": (7,)}, "a limit of the order is 7; it must be a whole number from 1 to 5"),
        ({"methods": ("euler",)}, "methods has 'euler'; it must be one of auto, idas"),
        ({"constraints": ("none",)}, "constraints has 'none'; it must be one of auto, states"),
        ({"workers": 0}, "workers is 0; it must be a whole number of at least 1"),
        ({"repeats": 0}, "repeats is 0; it must be a whole number of at least 1"),
        ({"limit": 0}, "limit is 0; it must be a number of seconds greater than 0"),
        ({"accuracy": 2}, "accuracy is 2; it must lie between 0 and 1"),
        ({"stop_time": -1}, "stop_time is -1; it must be a number of seconds greater than 0"),
        ({"switches": {"size": (1, 2)}}, "there is no `size` in the model"),
        ({"switches": {"kind": ()}}, "the switch `kind` has no values"),
        ({"switches": {"kind": ("square", "cube")}}, "`kind` of Decay is 'cube'; it must be one of"),
        ({"formulations": Decay.formulations[:1] * 2}, "formulations need names of their own"),
        ({"reference": "no.csv"}, "cannot read the reference no.csv"),
        ({"journal": "none/j"}, "there is no directory"),
    ],
)
def test_wrong_input_is_refused_before_anything_is_run(options, message):
    with pytest.raises(ac.AcausalError, match=message) as caught:
        study(**options, progress=lambda *_: pytest.fail("a point was run"))
    assert isinstance(caught.value, DeclarationError | ac.ExportError)


def long_study(tmp_path):
    """Write a file of a user, and return the command that studies it in 280 points."""
    (tmp_path / "mine.py").write_text(Path(decay.__file__).read_text())
    command = [sys.executable, "-m", "tests.acausal.study.command", "study", str(tmp_path / "mine.py:Decay")]
    command += ["--csv", str(tmp_path / "a.csv"), "--workers", "2", "--repeats", "1", "--intervals", "20"]
    tolerances = ",".join(f"{10 ** -(3 + k / 5):.3e}" for k in range(20))
    return [*command, "--tolerances", tolerances, "--max-orders", "auto,2"]


@pytest.mark.slow
def test_an_interrupted_study_goes_on(tmp_path):
    command, journal = long_study(tmp_path), tmp_path / "a.csv.journal"
    run = subprocess.Popen(command, cwd=ROOT, stderr=subprocess.PIPE, text=True, preexec_fn=heed_interrupts)
    while not (journal.exists() and len(journal.read_text().splitlines()) > 3):
        assert run.poll() is None
        time.sleep(0.005)
    run.send_signal(2)
    _, told = run.communicate(timeout=30)
    assert run.returncode == 130
    assert told == f"finished cases are kept in {journal}: the same command continues from there\nError: interrupted.\n"
    assert not (tmp_path / "a.csv").exists()
    lines = journal.read_text().splitlines()
    assert 4 <= len(lines) < 280
    # Marks tell whether these points are measured again; the last line was cut while it was written.
    marked = [json.dumps({**json.loads(line), "steps": 123456}) for line in lines[1:3]]
    journal.write_text("\n".join([lines[0], *marked, lines[3][:50]]))
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.count("123456") == 2
    assert not journal.exists()
    assert (tmp_path / "a.csv").exists()


def test_a_journal_of_another_study_is_refused(tmp_path):
    journal = tmp_path / "j"
    few = {"formulations": Decay.formulations[1:2], "tolerances": (1e-3,), "journal": journal}

    def stop(done, total, what):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        study(**few, progress=stop)
    assert len(journal.read_text().splitlines()) == 3
    with pytest.raises(DeclarationError, match=r"holds cases of another study \(other stop_time\). Remove it to start"):
        study(**few, stop_time=3.0)
    assert len(journal.read_text().splitlines()) == 3


@pytest.mark.slow
def test_a_switch_that_changes_the_model_limits_it():
    form = {"formulations": Decay.formulations[1:2], "tolerances": (1e-6,), "accuracy": 1e-3}
    found = study(**form, switches={"rate": (1.0, 1.1)})
    assert found.reference.case is not None
    assert found.reference.case.settings["rate"] == 1.0
    assert {row.limit for row in found.rows if row.case.settings["rate"] == 1.1} == {"model"}
