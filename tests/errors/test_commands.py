"""What the command tells of wrong uses of it: status and standard error of each line are in messages/commands.txt.

`python -m tests.errors.test_commands` writes them anew; read the difference before it is committed.
"""

from __future__ import annotations

import json
import os
import re
import shlex
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from typer.testing import CliRunner

from acausal.cli import app
from tests.errors.broken.files import inside
from tests.shared import heed_interrupts

ROOT = Path(__file__).parents[2]
GOLDEN = Path(__file__).parent / "messages/commands.txt"
HEAD = "from acausal import *\n"
MODEL = '''from acausal import *


class Decay(Model):
    """Decays."""

    k: Scalar = parameter("rate", default=1)
    drag = effect("friction", default=True)
    n = structural("axis", default=(0, 0, 1))
    x: Scalar = variable("position", start=1, fixed=True)
    y: Scalar = output("what is seen")

    def equations(self):
        yield der(self.x) == (-self.k * self.x if self.drag else 0)
        yield self.y == self.x
'''
PLAIN = MODEL.replace("Decay", "M")
FILES: dict[str, str | bytes] = {
    "decay.py": MODEL,
    "two.py": PLAIN + "class N(M):\n    pass\n",
    "none.py": "x = 1\n",
    "empty.py": "",
    "syntax.py": "def f(:\n",
    "indent.py": "class A:\nx = 1\n",
    "raises.py": PLAIN + "raise ValueError('no\\nway')\n",
    "exits.py": PLAIN + "import sys\nsys.exit('bye')\n",
    "recursion.py": PLAIN + "def f():\n    return f()\nf()\n",
    "memory.py": PLAIN + "x = [0] * 10**15\n",
    "generator.py": PLAIN + "raise GeneratorExit\n",
    "stops.py": PLAIN + "raise KeyboardInterrupt\n",
    "missing.py": "import no_such_module\n",
    "typo.py": "from components import Revolut\n",
    "helper.py": "import no_such_module\n",
    "broken_helper.py": "def f(:\n",
    "uses.py": "import helper\n",
    "uses_broken.py": "import broken_helper\n",
    "relative.py": "from . import helper\n",
    "picture.py": b"\x89PNG\r\n\0\xff",
    "part.py": HEAD + "class Rod(Component):\n    pass\ndef f():\n    pass\n",
    "instance.py": PLAIN + "m = M()\n",
    "arguments.py": PLAIN + "    def __init__(self, length, *, width):\n        super().__init__()\n",
    "fails.py": PLAIN + "    def __init__(self):\n        raise ValueError('bad')\n",
    "e.json": '{"scene": "pendulum", "effects": {}}',
    "r.csv": "time,y\n0,1\n1,a\n",
    "old.csv": "kept\n",
    "a b.py": PLAIN,
    "ünï.py": PLAIN,
    "prints.py": PLAIN + "print('hello')\n",
}
LIST = ["-m", "acausal", "list"]
SHORT = "--intervals 4 --stop-time 1"
WRONG = {
    # Scenes.
    "no_scene": "simulate ''",
    "unknown_scene": "simulate pendelum",
    "long_scene": f"simulate {'a' * 300}",
    "file_without_ending": "simulate decay",
    "module_and_class": "simulate decay:Decay",
    "class_alone": "simulate Decay",
    "file_without_class": "simulate decay.py",
    "empty_class": "simulate decay.py:",
    "two_models": "simulate two.py",
    "other_class": "simulate decay.py:decay",
    "class_called": "simulate 'decay.py:Decay()'",
    "two_colons": "simulate decay.py::Decay",
    "space_for_colon": "simulate 'decay.py Decay'",
    "other_ending": "simulate decay.txt:Decay",
    "file_of_nobody": "simulate '~nobody_of_this_name/x.py:M'",
    "long_file": f"simulate {'a' * 300}.py:M",
    "directory": "simulate dir.py:M",
    "directory_alone": "simulate .",
    "device": "simulate /dev/null:M",
    "circle": "simulate circle.py:M",
    "fifo": "simulate fifo.py:M",
    "picture": "simulate picture.py:M",
    "no_model": "check none.py:M",
    "empty_file": "check empty.py:M",
    "part": "check part.py:Rod",
    "function": "check part.py:f",
    "base_class": "check part.py:Model",
    "instance": "check instance.py:m",
    "constructor_with_arguments": "check arguments.py:M",
    "study_of_constructor_with_arguments": "study arguments.py:M",
    "effects_of_constructor_with_arguments": "effects arguments.py:M",
    "constructor_fails": "check fails.py:M",
    "syntax": "check syntax.py:M",
    "indent": "check indent.py:M",
    "raises": "check raises.py:M",
    "exits": "check exits.py:M",
    "recursion": "check recursion.py:M",
    "memory": "check memory.py:M",
    "generator": "check generator.py:M",
    "stops": "check stops.py:M",
    "missing_module": "check missing.py:M",
    "missing_name": "check typo.py:M",
    "missing_in_helper": "check uses.py:M",
    "syntax_in_helper": "check uses_broken.py:M",
    "relative_import": "check relative.py:M",
    # Values.
    "set_without_value": "check decay.py:Decay --set k",
    "set_without_name": "check decay.py:Decay --set =1",
    "set_nothing": "check decay.py:Decay --set k=",
    "set_twice": "check decay.py:Decay --set k=1 --set 'k = 2'",
    "set_unknown": "check decay.py:Decay --set kk=1",
    "set_word": "check decay.py:Decay --set k=fast",
    "set_unit": "check decay.py:Decay --set 'k=1 mm'",
    "set_quoted": "check decay.py:Decay --set 'k=\"1\"'",
    "set_nan": "check decay.py:Decay --set k=nan",
    "set_infinity": "check decay.py:Decay --set k=1e999",
    "set_400_digits": f"check decay.py:Decay --set k={'9' * 400}",
    "set_many_signs": "check decay.py:Decay --set k=----1",
    "set_endless_signs": f"check decay.py:Decay --set k={'-' * 100_000}1",
    "set_deep_brackets": f"check decay.py:Decay --set k={'(' * 5000}1",
    "set_open_bracket": "check decay.py:Decay --set n=(0,0,1",
    "set_dictionary": "check decay.py:Decay --set 'n={1: 2}'",
    "set_bytes": "check decay.py:Decay --set 'k=b\"1\"'",
    "set_complex": "check decay.py:Decay --set k=1j",
    "set_none": "check decay.py:Decay --set k=None",
    "set_expression": "check decay.py:Decay --set k=1+1",
    "switch_alone": "study decay.py:Decay --switch k",
    "switch_with_gap": "study decay.py:Decay --switch k=1,,2",
    "switch_twice": "study decay.py:Decay --switch k=1 --switch k=2",
    # Options.
    "method": "simulate decay.py:Decay --method euler",
    "constraints": "simulate decay.py:Decay --constraints none",
    "initial": "simulate decay.py:Decay --initial zero",
    "linearize_initial": "linearize decay.py:Decay --initial zero",
    "max_order": "simulate decay.py:Decay --max-order 9",
    "many_intervals": "simulate decay.py:Decay --intervals 10000000000",
    "no_intervals": "simulate decay.py:Decay --intervals 0",
    "stop_time_nan": "simulate decay.py:Decay --stop-time nan",
    "stop_time_backwards": "simulate decay.py:Decay --stop-time -1",
    "tolerance": "simulate decay.py:Decay --tolerance 2",
    "tiny_tolerance": "simulate decay.py:Decay --tolerance 1e-40",
    "tolerance_and_accuracy": "simulate decay.py:Decay --tolerance 1e-3 --accuracy 1e-3",
    "study_tolerances": "study decay.py:Decay --tolerances 1e-3;1e-4",
    "study_tolerance_range": "study decay.py:Decay --tolerances 1e-3,5",
    "study_orders": "study decay.py:Decay --max-orders high",
    "study_methods": "study decay.py:Decay --methods idas,,rosenbrock",
    "study_method": "study decay.py:Decay --methods euler",
    "study_workers": "study decay.py:Decay --workers 0",
    "study_initial": "study decay.py:Decay --initial zero",
    "study_limit": "study decay.py:Decay --limit -1",
    "study_reference": f"study decay.py:Decay --reference no.csv {SHORT}",
    "study_reference_text": "study decay.py:Decay --reference r.csv --stop-time 1 --intervals 1 --methods idas --tolerances 1e-3",
    "effects_pairs": "effects decay.py:Decay --pairs -1",
    "effects_file_of_another_scene": "simulate decay.py:Decay --effects e.json",
    "effects_file_missing": "simulate decay.py:Decay --effects no.json",
    # Output files.
    "csv_to_dash": "simulate decay.py:Decay --csv -",
    "csv_into_directory": "simulate decay.py:Decay --csv .",
    "csv_long": f"simulate decay.py:Decay --csv {'a' * 300}",
    "csv_circle": "simulate decay.py:Decay --csv circle.py",
    "csv_full_disk": f"simulate decay.py:Decay {SHORT} --csv /dev/full",
    "json_full_disk": f"simulate decay.py:Decay {SHORT} --json /dev/full",
    "csv_over_the_model": "simulate decay.py:Decay --csv ./decay.py",
    "json_of_check_over_the_model": "check decay.py:Decay --json decay.py",
    "json_of_linearize_over_the_model": "linearize decay.py:Decay --json decay.py",
    "csv_over_the_reference": "study decay.py:Decay --csv r.csv --reference r.csv",
    "one_file_twice": "simulate decay.py:Decay --csv out.csv --json ./out.csv",
    "json_and_csv_on_standard_output": "simulate decay.py:Decay --json - --csv /dev/stdout",
    "plot_without_ending": "simulate decay.py:Decay --plot out",
    "plot_of_unknown_kind": "simulate decay.py:Decay --plot out.xlsx",
    "study_plot": "study decay.py:Decay --plot out.txt",
    "variables": "simulate decay.py:Decay --variables X",
    "empty_variables": "simulate decay.py:Decay --variables ''",
}
# Told by typer, in words that differ with its version.
USAGE = [
    "simulate decay.py:Decay --intervals 2.5",
    "simulate decay.py:Decay --stop-time end",
    "simulate decay.py:Decay --stoptime 3",
    "run decay.py:Decay",
    "simulate",
    "simulate pendulum spin-up",
]
RIGHT = [
    f"simulate decay.py:Decay {SHORT} --set k=2 --set n=0,0,1 --quiet",
    f"simulate decay.py:Decay {SHORT} --set ' k = 2 ' --csv /dev/null --json /dev/null --quiet",
    f"simulate 'a b.py:M' {SHORT} --csv 'a b.csv' --quiet",
    f"simulate ünï.py:M {SHORT} --csv ünï.csv --json ünï.json --quiet",
    f"simulate instance.py:M {SHORT} --plot out.SVG --quiet",
]


@pytest.fixture
def place():
    with directory():
        yield Path.cwd()


@contextmanager
def directory():
    """A new directory with all files in it."""
    with inside(FILES):
        _others()
        yield


def _others() -> None:
    os.mkdir("dir.py")
    os.symlink("circle.py", "circle.py")
    if hasattr(os, "mkfifo"):
        os.mkfifo("fifo.py")


def told(line: str) -> str:
    """Status and standard error, without the name of the directory."""
    done = CliRunner().invoke(app, shlex.split(line), prog_name="acausal")
    assert done.stdout == "", line
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return f"{done.exit_code} {done.stderr.replace(str(Path.cwd().resolve()), 'HERE').strip()}"


def golden() -> dict[str, str]:
    text = GOLDEN.read_text() if GOLDEN.exists() else ""
    return {name: told.rstrip() for name, told in re.findall(r"^\[(\w+)\]\n(.*?)\n(?=\n\[|\Z)", text, re.M | re.S)}


def test_every_message_has_its_command():
    assert list(golden()) == list(WRONG)


@pytest.mark.parametrize("name", WRONG)
def test_message(place, name):
    before = sorted(os.listdir())
    assert told(WRONG[name]) == golden()[name]
    assert [path for path in sorted(os.listdir()) if path != "__pycache__"] == before
    assert Path("decay.py").read_text() == MODEL


@pytest.mark.parametrize("line", USAGE)
def test_usage(place, line):
    status, _, text = told(line).partition(" ")
    assert status == "2"
    assert text.startswith("Usage: acausal ")
    assert "Error: " in text


@pytest.mark.parametrize("line", RIGHT)
def test_right(place, line):
    assert told(line) == "0 "


# What needs a shell: streams that are full, closed or no longer read, and an environment that is wrong.
STREAMS = {
    "list | true": (141, ""),
    "check decay.py:Decay | true": (141, ""),
    "simulate decay.py:Decay --csv /dev/stdout --intervals 20000 --quiet | head -1": (141, ""),
    "list > /dev/full": (2, "Error: cannot write standard output: No space left on device.\n"),
    "simulate decay.py:Decay --json - --quiet > /dev/full": (
        2,
        "Error: cannot write standard output: No space left on device.\n",
    ),
    "simulate decay.py:Decay --json - --quiet >&-": (
        2,
        "Error: cannot write the JSON document: standard output is closed; give a file, --json FILE.\n",
    ),
    "check decay.py:Decay --set k=fast 2>/dev/full": (2, ""),
    "simulate decay.py:Decay --quiet >&- 2>&-": (0, ""),
    "MPLBACKEND=nonsense simulate decay.py:Decay --plot a.png": (
        2,
        "Error: matplotlib cannot be loaded, so there are no pictures; MPLBACKEND is 'nonsense': unset it, pictures need no "
        "screen.\n",
    ),
    "PYTHONIOENCODING=ascii COLUMNS=1 NO_COLOR=1 linearize decay.py:Decay > /dev/null": (0, ""),
}


@pytest.mark.skipif(os.name == "nt" or not Path("/dev/full").exists(), reason="streams of POSIX")
@pytest.mark.parametrize("line", STREAMS)
def test_streams(place, line):
    settings, command = re.fullmatch(r"((?:[A-Z_]+=\S+ )*)(.*)", line).groups()
    status, text = STREAMS[line]
    done = _shell(f"{settings} {shlex.quote(sys.executable)} -m acausal {command}; exit ${{PIPESTATUS[0]}}")
    assert (done.returncode, done.stderr) == (status, text)


def test_json_stays_alone(place):
    """Also where a library writes past Python, and where letters are missing."""
    Path("loud.py").write_text(PLAIN + "import os\nprint('one')\nos.write(1, b'two\\n')\n")
    os.rename("loud.py", "laut-ü.py")
    command = "check laut-ü.py:M --json -"
    done = _shell(f"PYTHONIOENCODING=ascii {shlex.quote(sys.executable)} -m acausal {command}")
    assert json.loads(done.stdout)["scene"] == "laut-ü.py:M"
    assert "one" in done.stderr
    assert "two" in done.stderr


def test_a_directory_that_is_gone(place):
    python = shlex.quote(sys.executable)
    done = _shell(f"mkdir gone; cd gone; rmdir ../gone; {python} -m acausal simulate simple-pendulum --csv a.csv")
    assert done.returncode == 2
    assert done.stderr == "Error: cannot write a.csv: the current directory no longer exists; change to another one.\n"


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_an_interrupt_while_it_loads(place):
    # A package that interrupts the process where it is loaded: no signal from outside comes at a known instant.
    (place / "casadi.py").write_text("import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(60)\n")
    # Streams are flushed as they are for users, whatever the environment of the tests asks for.
    path = os.pathsep.join([str(place), str(ROOT)])
    environment = {**os.environ, "PYTHONPATH": path, "PYTHONUNBUFFERED": ""}
    how = {"capture_output": True, "text": True, "env": environment, "timeout": 60, "check": False}
    done = subprocess.run([sys.executable, *LIST], preexec_fn=heed_interrupts, **how)
    assert done.returncode in (130, -signal.SIGINT)
    assert "Traceback" not in done.stderr
    assert done.stderr.endswith("Error: interrupted.\n")


def test_no_more_memory(place, monkeypatch):
    def exhausted(*_, **__):
        raise MemoryError

    monkeypatch.setattr("acausal.simulate", exhausted)
    assert told("simulate decay.py:Decay") == (
        "1 Error: there is not enough memory; take fewer intervals, elements or variables."
    )


def _shell(line: str) -> subprocess.CompletedProcess[str]:
    # Streams are flushed as they are for users, whatever the environment of the tests asks for.
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONUNBUFFERED": ""}
    how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "env": environment, "check": False}
    return subprocess.run(["bash", "-c", line], **how)


def main() -> None:
    """Write all messages."""
    with directory():
        parts = [f"[{name}]\n{told(line)}\n" for name, line in WRONG.items()]
    GOLDEN.write_text("\n".join(parts))


if __name__ == "__main__":
    main()
