"""The command export: what it refuses before it compiles, and what it asks the export for."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

import acausal.export
from acausal.cli import app, export_command
from acausal.export import platforms

MODEL = '''from acausal import Model, Scalar, der, parameter, variable


class Decay(Model):
    """One state."""

    rate: Scalar = parameter("rate of decay", unit="1/s", default=2.0)
    x: Scalar = variable("what decays", start=1.0, fixed=True)

    def equations(self):
        yield der(self.x) == -self.rate * self.x
'''


@pytest.fixture
def run(tmp_path, monkeypatch):
    (tmp_path / "decay.py").write_text(MODEL)
    monkeypatch.chdir(tmp_path)
    return lambda *words: CliRunner().invoke(app, ["export", "decay.py:Decay", *words])


@pytest.fixture
def asked(monkeypatch):
    """What the export was called with, where every library is installed."""
    calls = []

    def note(compiled, path, **options):
        calls.append((path, options))

    monkeypatch.setattr(platforms, "_is_installed", lambda name: True)
    for name in ("export_fmu", "export_dae"):
        monkeypatch.setattr(acausal.export, name, note, raising=False)
    return calls


@pytest.mark.parametrize(
    ("words", "status", "why"),
    [
        ([], 2, "export writes one file: give --fmu FILE.fmu or --dae FILE"),
        (["--fmu", "a.fmu", "--dae", "a.dae"], 2, "export writes one file"),
        (["--fmu", "a.zip"], 2, "cannot write a.zip: importers need a name that ends in .fmu"),
        (["--fmu", "none/a.fmu"], 2, "there is no directory"),
        (["--fmu", "decay.py"], 2, "--fmu would replace decay.py, which the command reads"),
        (["--fmu", "a.fmu", "--fmi-version", "1"], 2, "fmi_version must be 2 or 3, not 1"),
        (["--fmu", "a.fmu", "--fmi-version", "three"], 2, "Invalid value for '--fmi-version'"),
        (["--fmu", "a.fmu", "--platforms", "linux"], 2, "there is no platform `linux`; did you mean `linux-x86_64`?"),
        (["--fmu", "a.fmu", "--platforms", ""], 2, "there is no platform ``."),
        (["--dae", "a.dae", "--platforms", "all"], 2, "--platforms does not apply to --dae a.dae"),
        (["--dae", "a.dae", "--free", "x"], 2, "--free does not apply to --dae a.dae"),
    ],
)
def test_refused_before_anything_is_compiled(run, asked, monkeypatch, words, status, why):
    monkeypatch.setattr(export_command, "compile_scene", lambda *_: pytest.fail("compiled"))
    done = run(*words)
    assert done.exit_code == status
    assert why in done.stderr
    assert not asked


def test_all_platforms_name_the_command_that_builds_them(run, monkeypatch):
    monkeypatch.setattr(export_command, "compile_scene", lambda *_: pytest.fail("compiled"))
    monkeypatch.setattr(platforms, "_is_installed", lambda name: name == "linux-x86_64")
    done = run("--fmu", "a.fmu", "--platforms", "all")
    assert done.exit_code == 2
    assert "the core is not installed for linux-aarch64, windows-x86_64, macos-x86_64, macos-arm64" in done.stderr
    assert "`python -m pip install ziglang`, then `python -m acausal.core.build`" in done.stderr


def test_what_is_asked_for(run, asked, monkeypatch):
    compiled = []
    monkeypatch.setattr(export_command, "compile_scene", lambda *words: compiled.append(words[2]) or object())
    monkeypatch.setattr(platforms, "own_platform", lambda: "linux-x86_64")
    assert run("--fmu", "a.fmu").stdout == "wrote a.fmu: FMI 3.0, for linux-x86_64\n"
    words = ["--fmi-version", "2", "--platforms", "macos-arm64, own", "--free", "x", "--free", "rate"]
    done = run("--set", "rate=3", "--fmu", "b.fmu", *words)
    assert (done.exit_code, done.stdout) == (0, "wrote b.fmu: FMI 2.0, for linux-x86_64, macos-arm64\n")
    assert run("--dae", "c.dae").stdout == "wrote c.dae\n"
    assert run("--dae", "c.dae", "--quiet").stdout == ""
    assert asked == [
        ("a.fmu", {"fmi_version": 3, "platforms": ("own",), "free": (), "full": False}),
        ("b.fmu", {"fmi_version": 2, "platforms": ("macos-arm64", "own"), "free": ("x", "rate"), "full": False}),
        *[("c.dae", {"full": False})] * 2,
    ]
    assert compiled == [None, ["rate=3"], None, None]


def test_the_compiled_scene_is_exported(run, monkeypatch):
    found = []
    monkeypatch.setattr(platforms, "_is_installed", lambda name: True)
    monkeypatch.setattr(acausal.export, "export_dae", lambda compiled, path, **_: found.append(compiled), raising=False)
    assert run("--set", "rate=3", "--dae", "c.dae").exit_code == 0
    assert found[0].parameter_values(None).tolist() == [3.0]


def test_an_open_dae_is_written_and_loaded(run, tmp_path):
    assert run("--set", "rate=3", "--dae", "c.dae").exit_code == 0
    assert acausal.load_dae("c.dae").parameter_values(None).tolist() == [3.0]
