"""Uncaught errors in scripts show the user's lines, without libraries and chained errors."""

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import acausal as ac
from acausal.tracebacks import SETTING, user_traceback

ROOT = Path(__file__).parents[2]
HEAD = """import acausal as ac
import casadi as ca
from acausal import Model, Scalar, der, variable
from components import Revolute

class Own(Model):
    x: Scalar = variable("x")

"""
MODEL = "class M(Own):\n    def equations(self):\n        yield "
SCRIPTS = {
    "equation": f"{MODEL}self.y == 1\nac.compile(M())\n",
    "constructor": "Revolute(phi=3)\n",
    "start": f"{MODEL}der(self.x) == 1\nac.simulate(M(), stop_time=1)\n",
    "casadi": f"{MODEL}ca.sin(self.x) == 1\nac.compile(M())\n",
}


def run(folder, text, setting=""):
    (folder / "own.py").write_text(HEAD + text)
    environment = {**os.environ, "PYTHONPATH": str(ROOT), SETTING: setting}
    command = [sys.executable, "own.py"]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True).stderr


@pytest.mark.parametrize("name", SCRIPTS)
def test_only_lines_of_the_script(tmp_path, name):
    text = run(tmp_path, SCRIPTS[name])
    files = [line for line in text.splitlines() if line.startswith("  File ")]
    assert text.startswith("Traceback (most recent call last):\n  File ")
    assert files
    assert all("own.py" in line for line in files)
    assert text.count("Traceback") == 1
    assert "acausal.errors." in text


def test_all_lines_when_asked_for(tmp_path):
    assert "acausal/simulation/simulate.py" in run(tmp_path, SCRIPTS["start"], "full").replace(os.sep, "/")


def test_other_errors_stay_as_they_are(tmp_path):
    text = run(tmp_path, "def f():\n    return 1 / 0\nf()\n")
    assert text.count("  File ") == 2
    assert "ZeroDivisionError" in text


def test_a_notebook_shows_the_same(monkeypatch):
    with pytest.raises(ac.AcausalError) as caught:
        ac.simulate(3, stop_time=1)  # type: ignore[arg-type]
    text = "\n".join(caught.value._render_traceback_())
    assert text == user_traceback(caught.value, caught.value.__traceback__).rstrip()
    assert text.count("  File ") == 1
    assert __file__ in text
    monkeypatch.setenv(SETTING, "full")
    assert not hasattr(caught.value, "_render_traceback_")


def test_a_notebook_names_cells(monkeypatch):
    file = "/tmp/ipykernel_1/2.py"
    source = "def f():\n    ac.simulate(3, stop_time=1)\nf()"
    with pytest.raises(ac.AcausalError) as caught:
        exec(compile(source, file, "exec"), {"ac": ac})
    shell = SimpleNamespace(
        compile=SimpleNamespace(format_code_name=lambda name: ("Cell", "In[7]") if name == file else None)
    )
    python = SimpleNamespace(get_ipython=lambda: shell, __file__="/site/IPython/__init__.py")
    monkeypatch.setitem(sys.modules, "IPython", python)
    text = "\n".join(caught.value._render_traceback_())
    assert "  Cell In[7], line 3\n  Cell In[7], line 2, in f\n" in text
    assert file not in text
