"""The command line with any arguments, and with any bytes in its files: a result, or a message and an exit status."""

from __future__ import annotations

import json
from itertools import chain

import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from acausal.cli import app
from tests.fuzz.arguments import SMALL
from tests.fuzz.machines import HEAD
from tests.fuzz.outcome import limited
from tests.fuzz.settings import effort

COMMANDS = ("simulate", "check", "linearize", "list", "simulat", "")
SCENES = (
    "own.py:Machine",
    "own.py",
    "own.py:",
    "own.py:Missing",
    "missing.py:Machine",
    "simple-pendulum",
    "simple",
    "./own.py:Machine",
    "",
)
OPTIONS = (
    *(
        "--set",
        "--stop-time",
        "--tolerance",
        "--accuracy",
        "--intervals",
        "--method",
        "--max-order",
        "--initial",
        "--constraints",
    ),
    *("--csv", "--plot", "--json", "--variables", "--effects", "--quiet", "--help", "--colour", "-x", "--"),
)
VALUES = (
    *(
        "1",
        "0",
        "-1",
        "1e-3",
        "nan",
        "inf",
        "1e400",
        "9" * 400,
        "----1",
        "x",
        "",
        " ",
        "1,2,3",
        "(1, 2)",
        "True",
        "None",
        "None=None",
    ),
    *(
        "arm.m=2",
        "arm.m=",
        "arm.m",
        "=2",
        "arm.m=-1",
        "arm.m=x",
        "arm.r=1,2,3",
        "arm.r=1",
        "hinge.phi=1",
        "arm=1",
        "arm.m=1e400",
    ),
    *(
        "idas",
        "rosenbrock",
        "states",
        "steady",
        "guesses",
        "-",
        ".",
        "/",
        "out.csv",
        "out.png",
        "out.xyz",
        "missing/out.csv",
        "data.json",
    ),
    *("*", "arm.*", "[", "ä", "\x00", "a" * 300, "~nobody/x", "own.py:Machine", "arm.m=" + "[" * 200, "{}"),
)


def _run(arguments: list[str]) -> None:
    with limited():
        found = CliRunner().invoke(app, arguments)
    said = f"{arguments}\n{found.output}"
    assert found.exception is None or isinstance(found.exception, SystemExit), f"{said}\n{found.exception!r}"
    assert found.exit_code in (0, 1, 2), said
    assert "Traceback" not in found.output, said
    assert found.exit_code == 0 or found.output.strip(), said
    if found.exit_code == 0 and arguments[-2:] == ["--json", "-"] and "--help" not in arguments:
        json.loads(found.stdout)


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "own.py").write_text(HEAD + SMALL)


words = st.sampled_from(VALUES) | st.text(max_size=5)
settings = st.lists(
    st.tuples(st.sampled_from(OPTIONS), words).map(list) | st.sampled_from(OPTIONS).map(lambda o: [o]), max_size=3
)


@effort(40)
@given(st.sampled_from(COMMANDS), st.sampled_from(SCENES) | words, settings, st.sampled_from([[], ["--json", "-"]]))
def test_any_command_ends_with_a_message(command, scene, options, last):
    own = [] if command == "list" else [scene]
    _run([part for part in [command, *own, *chain.from_iterable(options), *last] if "\x00" not in part])


values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=4) | st.sampled_from(VALUES),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(["arm.m", "arm", "effects", "scene", "choices", ""]), inner, max_size=3)
    ),
    max_leaves=6,
)


@effort(25)
@given(values.map(json.dumps) | st.text(max_size=20) | st.binary(max_size=20))
def test_any_file_of_choices_ends_with_a_message(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("choices") / "data.json"
    path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass"))
    _run(["check", "own.py:Machine", "--effects", str(path)])
