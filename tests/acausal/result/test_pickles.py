"""Results and compiled models are pickled, copied, and read by processes that know nothing of the model."""

from __future__ import annotations

import copy
import dataclasses
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal import Expr, Model, Scalar, cos, der, exp, fixed, output, piecewise, sin, time, variable
from acausal.cli.scenes import find_scene
from acausal.result import match, names
from models import FourBar, SpinUp
from tests.acausal.result.pickled_model import Plant, Tank

ROOT = Path(__file__).parents[3]
TANK = {"stop_time": 1.0, "intervals": 20}


@pytest.fixture(scope="module")
def live():
    return ac.simulate(ac.compile(Plant()), **TANK)


@pytest.fixture(scope="module")
def loaded(live):
    return pickle.loads(pickle.dumps(live))


@pytest.mark.parametrize("model", [Plant(n=3), FourBar(), pytest.param(SpinUp(), marks=pytest.mark.slow)])
def test_every_quantity_by_its_name(model):
    live = ac.simulate(model, stop_time=0.2, intervals=7, tolerance=1e-4)
    loaded = pickle.loads(pickle.dumps(live))
    known = names(live.tree)
    assert names(loaded.tree) == known
    for name in known:
        assert loaded[name].shape == live[name].shape, name
        np.testing.assert_array_equal(loaded[name], live[name], err_msg=name)
        assert [(s.name, s.unit) for s in loaded.series(name)] == [(s.name, s.unit) for s in live.series(name)]
    np.testing.assert_array_equal(loaded.time, live.time)
    assert (loaded.outputs, loaded.title, loaded.stats) == (live.outputs, live.title, live.stats)


@pytest.mark.parametrize(
    "path",
    ["time", "tank[-1].h", "tank[1].h[1]", "tank[0].matrix[1,2]", "tank[0].matrix[-1, 0]", "spare[1]", "tank[0].twice"],
)
def test_indices(live, loaded, path):
    np.testing.assert_array_equal(loaded[path], live[path])


@pytest.mark.parametrize("path", ["tank", "tank[5].h", "tank[0].h[7]", "n", "nix", "tank.h", "tank[0].q", 3])
def test_wrong_paths_are_told_as_before(live, loaded, path):
    messages = []
    for result in (live, loaded):
        with pytest.raises(ac.DeclarationError) as caught:
            result[path]
        messages.append(str(caught.value))
    assert messages[0] == messages[1]


def test_expressions_are_refused(live, loaded):
    tree = live.tree
    np.testing.assert_array_equal(live[tree.tank[0].h[0] - tree.x], 0 * live.time)
    with pytest.raises(ac.DeclarationError, match=r"loaded without its model.*result\['x'\]"):
        loaded[tree.x]
    with pytest.raises(ac.DeclarationError, match="loaded without its model"):
        loaded[tree.tank[0].h[0] - tree.x]


def test_tables_pictures_and_patterns(live, loaded, tmp_path):
    live.to_csv(tmp_path / "a.csv", "x", "tank[0].matrix")
    loaded.to_csv(tmp_path / "b.csv", "x", "tank[0].matrix")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    assert loaded.to_dataframe("spare").equals(live.to_dataframe("spare"))
    loaded.plot("tank[1].h", path=tmp_path / "b.png")
    assert (tmp_path / "b.png").stat().st_size > 1000
    assert match(loaded.tree, ["tank[*].h", "x"]) == match(live.tree, ["tank[*].h", "x"])
    assert "Plant" in repr(loaded)


def test_a_pickle_of_what_was_loaded(loaded):
    again = pickle.loads(pickle.dumps(loaded))
    np.testing.assert_array_equal(again["tank[1].h"], loaded["tank[1].h"])


READER = """
import pickle, sys
result = pickle.load(sys.stdin.buffer)
assert not any("concealed" in name for name in sys.modules)
print(result["part.s"][-1], result.series("part.s")[0].unit, list(result.to_dataframe()))
"""
HIDDEN = """
from acausal import Component, Model, Scalar, der, output, parameter, variable

class Part(Component):
    s: Scalar = variable("way", unit="m", start=0.0, fixed=True)
    def equations(self):
        yield der(self.s) == 2.0

class Hidden(Model):
    part = Part()
    x: Scalar = output("out", unit="m")
    def equations(self):
        yield self.x == self.part.s
"""


def test_a_process_without_the_model_reads_it(tmp_path):
    (tmp_path / "concealed.py").write_text(HIDDEN)
    cls = find_scene(f"{tmp_path}/concealed.py:Hidden")
    compiled = ac.compile(cls())
    data = pickle.dumps(ac.simulate(compiled, stop_time=3.0, intervals=4))
    done = subprocess.run([sys.executable, "-c", READER], input=data, capture_output=True, cwd=ROOT, check=False)
    assert done.stderr == b""
    value, unit, *columns = done.stdout.decode().split(maxsplit=2)
    assert abs(float(value) - 6) < 1e-5
    assert (unit, columns) == ("m", ["['time', 'x']\n"])
    with pytest.raises(ac.ExportError, match=r"Hidden.*concealed.py.*from concealed import Hidden"):
        pickle.dumps(compiled)


def test_a_failed_simulation_keeps_its_result():
    error = ac.SimulationError("it failed", ac.simulate(Plant(), **TANK))
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == "it failed\nThe result up to there is in error.result."
    np.testing.assert_array_equal(again.result["x"], error.result["x"])


@pytest.mark.parametrize("parameters", [None, {"tank[0].k": 3.0, "n": 3}])
def test_compiled_models(parameters):
    compiled = ac.compile(Plant(), parameters)
    again = pickle.loads(pickle.dumps(compiled))
    expected = ac.simulate(compiled, parameters={"tank[1].k": 5.0}, **TANK)
    found = ac.simulate(again, parameters={"tank[1].k": 5.0}, **TANK)
    for name in names(compiled.tree):
        np.testing.assert_array_equal(found[name], expected[name])


def run(compiled):
    return ac.simulate(compiled, **TANK)


@pytest.mark.slow
def test_a_pool_of_processes_takes_and_gives_both():
    compiled = ac.compile(Plant())
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        result = pool.submit(run, compiled).result()
    np.testing.assert_array_equal(result["tank[1].h"], run(compiled)["tank[1].h"])


@pytest.mark.parametrize("drive", [2 * time, sin(time) * exp(-time), piecewise((cos(time), time < 0.5), 2.0)])
def test_models_with_expressions_of_time(drive):
    model = Plant(tank=[Tank(u=drive), Tank(u=0.0)])
    again = pickle.loads(pickle.dumps(model))
    for other in (again, copy.deepcopy(model), copy.copy(model)):
        np.testing.assert_array_equal(ac.simulate(other, **TANK)["x"], ac.simulate(model, **TANK)["x"])


def test_symbols_of_a_built_model_are_refused():
    tree = ac.compile(Plant()).tree
    with pytest.raises(ac.DeclarationError, match="belong to one built model"):
        pickle.dumps(tree.x)
    assert copy.deepcopy(tree.x) is tree.x
    assert isinstance(pickle.loads(pickle.dumps(time)), Expr)
    assert pickle.loads(pickle.dumps(time)) is time


def test_a_local_class_is_named_with_the_mend():
    class Local(Plant):
        """Not to be imported."""

    compiled = ac.compile(Local())
    with pytest.raises(ac.ExportError, match=r"Local.*inside the function test_a_local_class.*top of its module"):
        pickle.dumps(compiled)
    result = pickle.loads(pickle.dumps(ac.simulate(compiled, **TANK)))
    assert result["x"].shape == (21,)


def test_a_class_of_the_script_is_named_with_the_mend(tmp_path):
    script = "import pickle\nimport acausal as ac\n" + HIDDEN + "\npickle.dumps(ac.compile(Hidden()))\n"
    (tmp_path / "script.py").write_text(script)
    done = subprocess.run([sys.executable, tmp_path / "script.py"], capture_output=True, text=True, check=False)
    assert "ExportError" in done.stderr
    assert "Hidden" in done.stderr
    assert "from hidden import Hidden" in done.stderr


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_copies(copied, live):
    compiled = ac.compile(Plant())
    other = copied(compiled)
    assert other is not compiled
    assert other.local is not compiled.local
    np.testing.assert_array_equal(run(other)["x"], run(compiled)["x"])
    result = copied(live)
    tree = live.tree
    np.testing.assert_array_equal(result[tree.x * 2], live[tree.x * 2])
    assert result.stats == live.stats
    with pytest.raises(TypeError, match="assignment"):
        result.stats["steps"] = -1
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.stats.steps = -1
    assert copied(pickle.loads(pickle.dumps(live)))["x"].shape == (21,)


def test_values_that_are_no_numbers_survive():
    class Root(Model):
        """Not defined after a while."""

        x: Scalar = variable("x")
        y: Scalar = output("root")

        def equations(self):
            yield der(self.x) == -1
            yield self.y == ac.sqrt(self.x)

    live = ac.simulate(Root(x=fixed(0.5)), stop_time=1.0, intervals=10)
    loaded = pickle.loads(pickle.dumps(live))
    with pytest.warns(ac.AcausalWarning, match="`y` is not a number"):
        np.testing.assert_array_equal(loaded["y"], live["y"])
