"""What used to be passed over without a word, and how the command ends when it is asked to."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time as clock
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from acausal.cli import app
from tests.shared import heed_interrupts

ROOT = Path(__file__).parents[2]
MODELS = '''"""Models of a user."""
import sys
import numpy as np
from acausal import Model, Scalar, der, fixed, output, parameter, sin, sqrt, structural, variable


class Base(Model):
    """Decays."""

    y: Scalar = variable("y", start=1.0, fixed=True)
    x: Scalar = output("x")

    def equations(self):
        yield der(self.y) == -self.y
        yield self.x == self.y


class Text(Base):
    stop_time = "3 s"


class Negative(Base):
    stop_time = -1


class Yes(Base):
    stop_time = True


class Integer(Base):
    stop_time = np.int64(3)


class Short(Base):
    stop_time = np.float32(3)


class Adjustable(Base):
    stop_time: Scalar = parameter("end", unit="s", default=3.0)


class Follows(Base):
    half: Scalar = parameter("half", unit="s", default=1.5)
    stop_time: Scalar = parameter("end", unit="s", default=lambda self: 2 * self.half)


class Structural(Base):
    stop_time = structural("end", default=3)


class Computed(Base):
    n = structural("number", default=2)

    @property
    def stop_time(self):
        return 1.5 * self.n


class Unknown(Base):
    stop_time: Scalar = variable("unknown")

    def equations(self):
        yield from super().equations()
        yield self.stop_time == 2.0


class Timed(Base):
    time: Scalar = output("clock of its own")

    def equations(self):
        yield from super().equations()
        yield self.time == 5.0


class Vectors(Base):
    time = output("clock of its own", shape=(2,))

    def equations(self):
        yield from super().equations()
        yield self.time == (5.0, 6.0)


class Exits(Base):
    def equations(self):
        sys.exit(0)
        yield


class Root(Base):
    """Not defined after a while."""

    z: Scalar = output("root")
    pair = variable("two", shape=(2,))

    def equations(self):
        yield from super().equations()
        yield self.z == sqrt(self.y - 0.5)
        yield self.pair == (self.y, 1 / (1 - self.y))


class Fast(Model):
    """Far more steps than outputs."""

    x: Scalar = output("angle")
    v: Scalar = variable("its rate", start=0.0, fixed=True)
    y: Scalar = variable("angle", start=1.0, fixed=True)

    def equations(self):
        open("started", "w").close()
        yield self.x == self.y
        yield der(self.y) == self.v
        yield der(self.v) == -1e8 * sin(self.y)
'''


@pytest.fixture
def run(tmp_path, monkeypatch):
    (tmp_path / "ends.py").write_text(MODELS)
    monkeypatch.chdir(tmp_path)
    runner = CliRunner()
    return lambda *arguments: runner.invoke(app, [str(a) for a in arguments])


@pytest.mark.parametrize("code", ["0", "", "3", "'bye'"])
def test_a_file_that_exits(run, tmp_path, code):
    (tmp_path / "exits.py").write_text(f"import sys\nfrom acausal import Model\nsys.exit({code})\n")
    for command in ("simulate", "check", "linearize", "study", "effects"):
        done = run(command, "exits.py:Any")
        assert done.exit_code == 2, command
        assert "exits.py:3" in done.stderr
        assert "__main__" in done.stderr


def test_equations_that_exit(run):
    done = run("simulate", "ends.py:Exits")
    assert done.exit_code == 2
    assert "ends.py:" in done.stderr


@pytest.mark.parametrize("name", ["", " "])
@pytest.mark.parametrize(
    "arguments",
    [
        ("simulate", "--csv"),
        ("simulate", "--json"),
        ("simulate", "--plot"),
        ("check", "--json"),
        ("linearize", "--json"),
        ("study", "--csv"),
        ("study", "--markdown"),
        ("study", "--plot"),
        ("study", "--json"),
        ("effects", "--apply"),
        ("effects", "--csv"),
    ],
)
def test_no_name_of_a_file(run, tmp_path, arguments, name):
    command, option = arguments
    done = run(command, "ends.py:Base", option, name)
    assert done.exit_code == 2
    assert "the name of the file is empty" in done.stderr
    assert [path.name for path in tmp_path.iterdir() if path.suffix != ".py"] in ([], ["__pycache__"])


@pytest.mark.parametrize("name", ["out/", "out.png/", "./.", "..", "out/.."])
@pytest.mark.parametrize("option", ["--csv", "--json", "--plot"])
def test_the_name_of_a_directory(run, tmp_path, option, name):
    if option == "--plot" and "png" not in name:
        pytest.skip("no name of a picture")
    done = run("simulate", "ends.py:Base", option, name)
    assert done.exit_code == 2
    assert "directory" in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("option", ["--variables", "--effects"])
def test_other_empty_texts(run, option):
    assert run("simulate", "ends.py:Base", option, "").exit_code == 2


@pytest.mark.parametrize("name", ["Integer", "Short", "Adjustable", "Follows", "Structural", "Computed"])
def test_stop_times_of_all_kinds(run, name):
    assert run("simulate", f"ends.py:{name}", "--csv", "a.csv", "--intervals", 3, "--quiet").exit_code == 0
    np.testing.assert_allclose(pd.read_csv("a.csv")["time"], [0, 1, 2, 3])
    assert run("simulate", f"ends.py:{name}", "--csv", "a.csv", "--stop-time", 6, "--quiet").exit_code == 0
    assert pd.read_csv("a.csv")["time"].iloc[-1] == 6


@pytest.mark.parametrize(
    ("name", "setting"), [("Adjustable", "stop_time=4"), ("Follows", "half=2"), ("Structural", "stop_time=4")]
)
def test_stop_times_that_are_set(run, name, setting):
    done = run("simulate", f"ends.py:{name}", "--set", setting, "--csv", "a.csv", "--intervals", 4, "--quiet")
    assert done.exit_code == 0
    np.testing.assert_allclose(pd.read_csv("a.csv")["time"], [0, 1, 2, 3, 4])


@pytest.mark.parametrize("name", ["Text", "Negative", "Yes", "Unknown"])
@pytest.mark.parametrize("command", ["simulate", "study"])
def test_stop_times_that_are_none(run, name, command):
    done = run(command, f"ends.py:{name}")
    assert done.exit_code == 2
    assert name in done.stderr
    assert "stop_time" in done.stderr


@pytest.mark.parametrize("name", ["Timed", "Vectors"])
def test_an_output_named_time(run, tmp_path, name):
    done = run("simulate", f"ends.py:{name}", "--csv", "a.csv")
    assert done.exit_code == 2
    assert "`time`" in done.stderr
    assert not (tmp_path / "a.csv").exists()
    assert run("simulate", f"ends.py:{name}", "--plot", "a.png").exit_code == 0


def test_values_that_are_no_numbers(run):
    done = run("simulate", "ends.py:Root", "--json", "-", "--csv", "a.csv", "--variables", "pair", "--variables", "z")
    assert done.exit_code == 0
    document = json.loads(done.stdout)
    assert document["not_finite"] == pytest.approx({"z": 0.695, "pair[1]": 0.0}, abs=1e-9)
    warnings = [line for line in done.stderr.splitlines() if line.startswith("Warning")]
    assert len(warnings) == 2
    assert "`z` is not a number (NaN) at 123 of 401 times, first at t = 0.695 s" in warnings[0]
    assert "`pair[1]` is infinite at 1 of 401 times, first at t = 0 s" in warnings[1]


def test_values_that_are_numbers(run):
    done = run("simulate", "ends.py:Base", "--json", "-")
    assert json.loads(done.stdout)["not_finite"] == {}
    assert "Warning" not in done.stderr


@pytest.fixture
def start(tmp_path):
    """Start a command that ends with the test at the latest."""
    started = []

    def begin(*arguments):
        (tmp_path / "ends.py").write_text(MODELS)
        command = [sys.executable, ROOT / "tests/acausal/study/command.py", *map(str, arguments)]
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        how = {"cwd": tmp_path, "stderr": subprocess.PIPE, "env": environment, "text": True}
        started.append(subprocess.Popen(command, preexec_fn=heed_interrupts, **how))
        return started[-1]

    yield begin
    for process in started:
        process.kill()
        process.wait()


needs_signals = pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")


@needs_signals
@pytest.mark.parametrize(
    ("number", "status", "word", "method"),
    [
        (signal.SIGTERM, 143, "terminated", "auto"),
        (signal.SIGINT, 130, "interrupted", "idas"),
        pytest.param(signal.SIGTERM, 143, "terminated", "idas", marks=pytest.mark.slow),
        pytest.param(signal.SIGINT, 130, "interrupted", "auto", marks=pytest.mark.slow),
    ],
)
def test_what_was_computed_is_written(start, tmp_path, number, status, word, method):
    arguments = ("--stop-time", 100, "--intervals", 200_000, "--csv", "a.csv", "--json", "a.json", "--method", method)
    process = start("simulate", "ends.py:Fast", *arguments, "--quiet")
    end = clock.monotonic() + 60
    while not (tmp_path / "started").exists() and clock.monotonic() < end:
        clock.sleep(0.1)
    clock.sleep(2)
    process.send_signal(number)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == status
    assert word in errors
    table = pd.read_csv(tmp_path / "a.csv")
    assert 10 < len(table) < 200_001
    assert np.all(np.abs(table["x"][table["time"] < 0.5]) < 1.01)
    assert json.loads((tmp_path / "a.json").read_text())["error"] == word


def children(pid):
    listed = subprocess.run(["ps", "-eo", "pid=,ppid="], capture_output=True, text=True, check=True).stdout
    return [int(own) for own, parent in (line.split() for line in listed.splitlines()) if int(parent) == pid]


def lives(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().split()[2] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks into /proc")
@pytest.mark.parametrize("number", [signal.SIGTERM, pytest.param(signal.SIGKILL, marks=pytest.mark.slow)])
def test_workers_do_not_outlive_a_study(start, number):
    arguments = ("--stop-time", 1000, "--tolerances", "1e-8,1e-9", "--workers", 2, "--quiet")
    process = start("study", "ends.py:Fast", *arguments)
    end = clock.monotonic() + 30
    while len(workers := children(process.pid)) < 3 and clock.monotonic() < end:  # two and the tracker of resources
        clock.sleep(0.2)
    assert len(workers) >= 3
    clock.sleep(1.5)
    process.send_signal(number)
    process.communicate(timeout=30)
    assert process.returncode == (143 if number == signal.SIGTERM else -number)
    while any(map(lives, workers)) and clock.monotonic() < end + 30:
        clock.sleep(0.2)
    assert not [pid for pid in workers if lives(pid)]
