"""What commands print: short summaries, lines that fit, and signs of work on a terminal only."""

import os
import pty
import re
import select
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some
from typer.testing import CliRunner

import acausal as ac
from acausal.cli import app, progress
from acausal.cli.output import LINES, MODES, modes_table, summary
from acausal.cli.scenes import scenes
from acausal.cli.streams import fitted
from acausal.result.tables import WIDTH
from tests.shared import CONTRACT, compiled

QUICK = ["simple-pendulum", "squeezer", "car-axis", "governor", "rolling-wheel-set-driving"]
MODEL = """import acausal as ac
class Still(ac.Model):
    '''A model.'''
    x: ac.Scalar = ac.variable("position", unit="m", start=1, fixed=True)
    y: ac.Scalar = ac.output("position", unit="m")
    def equations(self):
        yield ac.der(self.x) == 0
        yield self.y == self.x
"""


@pytest.mark.parametrize("name", QUICK)
def test_a_summary_is_short(name: str) -> None:
    model = compiled(scenes()[name])
    result = ac.simulate(model, stop_time=0.01, intervals=4, energy=True)
    lines = summary(result).splitlines()
    assert len(lines) <= LINES
    assert max(map(len, lines)) <= WIDTH
    shown = sum(f"    {column} " in f"{line} " for line in lines for column in CONTRACT[name][0])
    assert shown == len(CONTRACT[name][0]) or re.search(rf"\({len(CONTRACT[name][0])} in all", summary(result))
    assert max(map(len, model.summary().splitlines())) <= WIDTH


@given(some.lists(some.complex_numbers(max_magnitude=1e6, allow_nan=False), max_size=60))
@settings(max_examples=30, deadline=None)
def test_a_table_of_modes_is_short(values: list[complex]) -> None:
    table = modes_table(np.array([*values, *np.conj(values)], dtype=complex))
    assert len(table.splitlines()) <= MODES + 2
    assert max(map(len, table.splitlines())) <= WIDTH


def test_equal_modes_are_counted() -> None:
    assert "12 times 0" in modes_table(np.zeros(12))


@pytest.mark.parametrize("columns", [40, 80, 200])
def test_lines_fit_a_terminal_and_stay_whole_in_a_pipe(monkeypatch: pytest.MonkeyPatch, columns: int) -> None:
    class Stream:
        def __init__(self, terminal: bool) -> None:
            self.isatty = lambda: terminal

    monkeypatch.setenv("COLUMNS", str(columns))
    text = f"Error: {'word ' * 60}".strip() + "\nlast"
    assert fitted(text, Stream(False)) == fitted(text, None) == text
    shown = fitted(text, Stream(True))
    assert max(map(len, shown.splitlines())) <= min(columns, WIDTH)
    assert shown.split() == text.split()
    assert shown.endswith("\nlast")


def test_a_headline_is_first(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "still.py").write_text(MODEL)
    for command, line in {
        "check": "Still: 1 states, 0 algebraic unknowns\n",
        "linearize": "Still: 1 states, 0 inputs, 1 outputs; 0 frequencies",
        "simulate": "Still: 0 s to 1 s, 401 points",
    }.items():
        done = CliRunner().invoke(app, [command, "still.py:Still"])
        assert done.stdout.startswith(line), done.output
        assert "..." not in done.stderr


def test_a_place_is_told_once(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wrong.py").write_text("import acausal as ac\nclass A(ac.Model):\n    x = ac.output('x', start=1)\n")
    assert CliRunner().invoke(app, ["check", "wrong.py:A"]).stderr.count("wrong.py:3") == 1


@pytest.mark.skipif(os.name != "posix", reason="a pseudo-terminal is needed")
def test_long_work_shows_itself_on_a_terminal_only() -> None:
    script = textwrap.dedent("""
        import time
        from acausal.cli import progress
        progress.PATIENCE = 0.05
        for wanted in (True, False):
            with progress.working("compiling" if wanted else "unwanted", wanted):
                time.sleep(0.5)
        with progress.working("short"):
            pass
    """)
    ours, theirs = pty.openpty()
    done = subprocess.Popen(
        [sys.executable, "-c", script], stdout=theirs, stderr=theirs, env=os.environ | {"TERM": "xterm"}
    )
    os.close(theirs)
    text, end = b"", time.monotonic() + 60
    while time.monotonic() < end and select.select([ours], [], [], 30)[0]:
        try:
            piece = os.read(ours, 1 << 16)
        except OSError:
            break
        text += piece
        if not piece:
            break
    assert done.wait() == 0
    os.close(ours)
    assert b"compiling ..." in text
    assert b"unwanted" not in text
    assert b"short" not in text
    piped = subprocess.run([sys.executable, "-c", script], capture_output=True, check=True)
    assert piped.stderr == piped.stdout == b""


def test_quiet_without_a_terminal(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 0.0)
    with progress.working("compiling"):
        time.sleep(0.1)
    assert capsys.readouterr() == ("", "")
