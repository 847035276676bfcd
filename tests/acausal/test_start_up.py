"""Commands import only the modules that they need."""

import subprocess
import sys

import pytest

TABLES = {"matplotlib", "pandas", "rich"}
SCIPY = {"scipy.interpolate", "scipy.linalg", "scipy.optimize", "scipy.sparse"}
LARGE = {"scipy.interpolate", "scipy.optimize"}
NOWHERE = {"distributed", "pytest", "sympy"}


@pytest.mark.parametrize(
    ("code", "unused"),
    [
        ("import acausal, components, models", NOWHERE | TABLES | SCIPY | {"networkx", "typer"}),
        ("run('list')", NOWHERE | TABLES | SCIPY | {"networkx"}),
        ("run('check', 'spin-up')", NOWHERE | TABLES | LARGE),
        ("import acausal as ac, models\nac.simulate(models.Squeezer(), stop_time=1e-3)", NOWHERE | TABLES | LARGE),
        ("import acausal as ac, models\nac.simulate(models.Governor(), stop_time=1)", NOWHERE | TABLES | LARGE),
    ],
)
def test_modules_that_are_not_loaded(code: str, unused: set[str]) -> None:
    run = "def run(*words):\n from acausal.cli import app\n app(words, standalone_mode=False)\n"
    script = f"import sys\n{run}{code}\nprint('modules', *sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.splitlines()[-1].split()[1:])
    assert "casadi" in loaded
    assert not loaded & unused
