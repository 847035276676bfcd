"""The command line on models of the user's own, so that only the engine is needed."""

import json

import pandas as pd
import pytest
from typer.testing import CliRunner

import acausal as ac
from acausal.cli import app

MODELS = '''"""Models of a user."""
from acausal import Model, Scalar, as_expr, der, output, parameter, part, sqrt, structural, time, variable


class Oscillator(Model):
    """Mass on a spring."""

    stop_time = 2.0
    c: Scalar = parameter("stiffness", unit="N/m", default=4.0)
    n = structural("axis", default=(0, 0, 1), shape=(3,))
    kind: str = structural("kind", default="free", choices=("free", "damped", None))
    x: Scalar = output("position", unit="m")
    v: Scalar = variable("speed", unit="m/s", start=0.0, fixed=True)
    s: Scalar = variable("stretch", unit="m", start=1.0, fixed=True)
    pair = variable("both", shape=(2,), unit="m")

    def equations(self):
        yield self.v == der(self.s)
        yield 1.0 * der(self.v) == as_expr((-self.c * self.s).sx - (0.4 * self.v.sx if self.kind == "damped" else 0))
        yield self.x == self.s
        yield self.pair == (self.s, 2 * self.s)


class Root(Model):
    """Not defined after 1 s."""

    x: Scalar = output("position")
    y: Scalar = variable("the same", start=1.0, fixed=True)

    def equations(self):
        yield der(self.y) == sqrt(1 - as_expr(time.sx))
        yield self.x == self.y


class Open(Model):
    """Without start values."""

    x: Scalar = output("position", unit="m")
    y: Scalar = variable("the same", unit="m")

    def equations(self):
        yield der(self.y) == as_expr(-self.y.sx)
        yield self.x == self.y


class Typo(Model):
    """A name that does not exist, in a part."""

    @part
    def thing(self):
        """Fails."""
        return undefined_name


class NoModel:
    pass
'''


@pytest.fixture
def run(tmp_path, monkeypatch):
    (tmp_path / "mine.py").write_text(MODELS)
    monkeypatch.chdir(tmp_path)
    runner = CliRunner()
    return lambda *arguments: runner.invoke(app, [str(a) for a in arguments])


def test_simulate_writes_a_table(run, tmp_path):
    done = run("simulate", "mine.py:Oscillator", "--csv", "a.csv", "--intervals", 10, "--quiet")
    assert (done.exit_code, done.stdout, done.stderr) == (0, "", "")
    table = pd.read_csv(tmp_path / "a.csv")
    assert list(table) == ["time", "x"]
    assert len(table) == 11
    assert table["time"].iloc[-1] == 2.0
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.csv", "mine.py"]


def test_summary_for_people(run):
    done = run("simulate", "mine.py:Oscillator")
    lines = done.stdout.splitlines()
    assert lines[0] == "Oscillator: 0 s to 2 s, 401 points"
    assert lines[-2] == "  at 2 s:"
    assert lines[-1].startswith("    x = -0.653")
    assert lines[-1].endswith(" m")


@pytest.mark.parametrize(
    ("given", "columns"),
    [
        (["v"], ["v"]),
        (["?"], ["v", "c", "s"]),
        (["pair"], ["pair[0]", "pair[1]"]),
        (["pair[1]", "x"], ["pair[1]"]),
        (["c", "v"], ["c", "v"]),
    ],
)
def test_variables_follow_the_outputs(run, tmp_path, given, columns):
    patterns = [a for pattern in given for a in ("--variables", pattern)]
    assert run("simulate", "mine.py:Oscillator", "--csv", "a.csv", *patterns).exit_code == 0
    table = list(pd.read_csv(tmp_path / "a.csv"))
    assert table[:2] == ["time", "x"]
    assert sorted(table[2:]) == sorted(columns)


def test_plot(run, tmp_path):
    assert run("simulate", "mine.py:Oscillator", "--plot", "a.png", "--variables", "pair").exit_code == 0
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_json_alone_on_standard_output(run):
    done = run("simulate", "mine.py:Oscillator", "--json", "-", "--set", "c=9")
    document = json.loads(done.stdout)
    assert document["scene"] == "mine.py:Oscillator"
    assert {
        "equations_flat", "equations_reduced", "states", "algebraic", "compile_seconds", "solve_seconds", "steps",
        "factorisations", "residual_evaluations", "max_order", "break_times", "energy_supplied", "energy_stored_change",
        "energy_dissipated", "energy_method",
    } <= set(document)  # fmt: skip
    assert "Oscillator: 0 s to 2 s" in done.stderr


def test_json_into_a_file(run, tmp_path):
    done = run("check", "mine.py:Oscillator", "--json", "a.json")
    assert json.loads((tmp_path / "a.json").read_text())["states"] == ["v", "s"]
    assert done.stdout.startswith("Oscillator: 2 states")


def test_linearize(run):
    done = run("linearize", "mine.py:Oscillator", "--set", "c=100", "--json", "-")
    document = json.loads(done.stdout)
    assert document["frequencies_hz"] == pytest.approx([10 / 6.283185307179586])
    assert [pair for value in document["eigenvalues"] for pair in value] == pytest.approx([0, -10, 0, 10], abs=1e-9)
    assert sorted(document["states"]) == ["s", "v"]
    assert "± 10i" in done.stderr


def test_linearize_real_eigenvalues_are_pairs(run):
    done = run("linearize", "mine.py:Open", "--initial", "guesses", "--json", "-")
    assert json.loads(done.stdout)["eigenvalues"] == [[-1.0, 0.0]]


def test_set_changes_the_model(run, tmp_path):
    for value in ("free", "damped", "None"):
        assert run("simulate", "mine.py:Oscillator", "--set", f"kind={value}", "--csv", f"{value}.csv").exit_code == 0
    last = {k: pd.read_csv(tmp_path / f"{k}.csv")["x"].iloc[-1] for k in ("free", "damped", "None")}
    assert last["free"] == last["None"] != last["damped"]
    assert run("simulate", "mine.py:Oscillator", "--set", "n=1,0,0").exit_code == 0


def test_failed_simulation_keeps_what_it_found(run, tmp_path):
    files = ("--csv", "a.csv", "--plot", "a.png", "--json", "a.json")
    done = run("simulate", "mine.py:Root", "--stop-time", 2, "--intervals", 20, *files)
    assert done.exit_code == 1
    assert "Error: the simulation failed: the run stopped at t = 1 s" in done.stderr
    assert "Traceback" not in done.stderr
    table = pd.read_csv(tmp_path / "a.csv")
    assert len(table) == 11
    assert (tmp_path / "a.png").exists()
    assert "error" in json.loads((tmp_path / "a.json").read_text())


def test_interrupt(run, monkeypatch, tmp_path):
    whole = ac.simulate

    def interrupted(*arguments, **options):
        stop = KeyboardInterrupt()
        stop.result = whole(*arguments, **options)  # type: ignore[attr-defined]
        raise stop

    monkeypatch.setattr(ac, "simulate", interrupted)
    done = run("simulate", "mine.py:Oscillator", "--csv", "a.csv")
    assert (done.exit_code, done.stderr) == (130, "Error: interrupted.\n")
    assert (tmp_path / "a.csv").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["mine.py:Oscilator"], "mine.py has no class `Oscilator`; its models: {all}."),
        (["mine.py"], "mine.py needs the name of a class; its models: {all}."),
        (["mine.py:NoModel"], "NoModel in mine.py is not a Model: class NoModel(Model), with Model from acausal."),
        (["none.py:A"], "there is no file none.py; a model of your own is given as path/to/file.py:ClassName."),
        (["mine.py:Typo"], "Typo, {dir}/mine.py:52: NameError: name 'undefined_name' is not defined"),
        (
            ["mine.py:Oscillator", "--set", "c"],
            "--set takes NAME=VALUE, such as --set omega=4 or --set beam.E=7e10, not `c`.",
        ),
        (["mine.py:Oscillator", "--set", "kinds=free"], "there is no `kinds` in the model; did you mean `kind`?"),
        (
            ["mine.py:Oscillator", "--set", "kind=fre"],
            "`kind` of Oscillator is 'fre'; it must be one of 'free', 'damped', None.",
        ),
        (["mine.py:Oscillator", "--set", "c=stiff"], "`c` of Oscillator is 'stiff'; it must be a number."),
        (["mine.py:Oscillator", "--set", "n=1,0"], "`n` of Oscillator has shape (2,); it must have shape (3,)."),
        (
            ["mine.py:Oscillator", "--stop-time", "-1"],
            "stop_time is -1 s; it must come after start_time = 0 s.",
        ),
        (["mine.py:Oscillator", "--intervals", "0"], "intervals is 0; it must be a whole number of at least 1."),
        (
            ["mine.py:Oscillator", "--tolerance", "1"],
            "tolerance is 1; it must lie between 1e-15 and 1, for instance 1e-6.",
        ),
        (
            ["mine.py:Oscillator", "--csv", "none/a.csv"],
            "cannot write none/a.csv: there is no directory {dir}/none; create it first.",
        ),
        (["mine.py:Oscillator", "--json", "."], "cannot write .: it is a directory; append a file name."),
        (["mine.py:Oscillator", "--plot", "a.txt"], "cannot write a.txt: a picture's name ends in .png, .svg or .pdf."),
        (["mine.py:Oscillator", "--variables", "w*"], "no variable of the model matches `w*`; * stands for any text."),
        (["mine.py:Oscillator", "--variables", "xx"], "there is no `xx` in the model; did you mean `x`?"),
    ],
)
def test_wrong_input_is_one_message(run, tmp_path, arguments, message):
    done = run("simulate", *arguments)
    everything = ", ".join(f"mine.py:{name}" for name in ("Oscillator", "Root", "Open", "Typo"))
    assert done.stderr == f"Error: {message.format(all=everything, dir=tmp_path)}\n"
    assert (done.exit_code, done.stdout) == (2, "")


def test_missing_start_value_tells_the_option(run):
    done = run("simulate", "mine.py:Open")
    assert done.exit_code == 2
    assert "--initial guesses" in done.stderr
    assert run("simulate", "mine.py:Open", "--initial", "guesses").exit_code == 0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("import acausal\nx = 1 +\n", "{path}:2: SyntaxError: invalid syntax"),
        (
            "import nothing_there\n",
            "{path}:1: ModuleNotFoundError: No module named 'nothing_there'; install it, or put nothing_there.py beside this "
            "file.",
        ),
        ("x = 1\n1 / 0\n", "{path}:2: ZeroDivisionError: division by zero"),
        ("x = 1\n", "{name} has no model: derive a class from Model."),
    ],
)
def test_broken_file(run, tmp_path, text, message):
    (tmp_path / "broken.py").write_text(text)
    done = run("check", "broken.py:A")
    assert done.stderr == f"Error: {message.format(path=tmp_path / 'broken.py', name='broken.py')}\n"
    assert done.exit_code == 2


def test_a_file_imports_its_neighbours(run, tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "neighbour_of_mine.py").write_text(MODELS)
    (tmp_path / "sub" / "top.py").write_text("from neighbour_of_mine import Oscillator\n")
    assert run("check", "sub/top.py:Oscillator").exit_code == 0


def test_bad_options_are_refused_by_name(run):
    done = run("simulate", "mine.py:Oscillator", "--intervals", "many")
    assert done.exit_code == 2
    assert "--intervals" in done.stderr
    assert run("simulate").exit_code == 2
