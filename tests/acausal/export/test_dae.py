"""Open DAEs: what is loaded simulates identically, without classes; what is damaged is refused."""

from __future__ import annotations

import pickle
import re
import subprocess
import sys
import warnings
import zipfile
from copy import copy
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    apart,
    der,
    discrete,
    expect,
    input,
    observed,
    output,
    parameter,
    piecewise,
    reinit,
    require,
    structural,
    time,
    variable,
    when,
)
from acausal.core.tape import KINDS
from acausal.export.dae import dae_archive
from acausal.export.dae.expressions import INT, NAMES, UNARY, Operations, Reader, Writer
from models import SCENES
from tests.shared import compiled


class Controlled(Model):
    """A sampled controller, a load that is switched on, a limit, an input, and all that may be stated."""

    end: Scalar = parameter("end", unit="s", default=1.0)
    tau: Scalar = parameter("time constant", unit="s", default=0.3, positive=True)
    late: Scalar = parameter("when the load comes", unit="s", default=0.7)
    step: Scalar = parameter("sample time", unit="s", default=0.11)
    kind: str = structural("kind", default="slow")
    wanted: Scalar = input("wanted value")
    x: Scalar = variable("value", start=0.2, fixed=True)
    y: Scalar = output("limited")
    held: Scalar = discrete("held", start=0)
    due: Scalar = discrete("next sample", unit="s", start=0.05)
    stop_time = 2 * end
    intervals = 50

    def equations(self):
        load = piecewise((0.0, time < self.late), 1.0)
        yield self.tau * der(self.x) == 2 * self.held + self.wanted - self.x - load
        yield self.y == piecewise((0.9, self.x > 0.9), (self.x, self.x > -0.3), -0.3)
        yield when(time >= self.due, reinit(self.held, self.wanted - self.x), reinit(self.due, self.due + self.step))

    def requirements(self):
        yield require(self.late < 5, "`late` is too late")
        yield require(self.step, lambda value: "" if value > 0 else "is not positive")

    def validity(self):
        yield expect(self.x, self.end / ac.quantity(1, "s"), 0.01, "x is not small")
        yield apart((self.x + 10, 0), self.held, self.y, "they meet")

    def stored_energy(self):
        return self.x * self.x

    @observed
    def twice(self):
        """Twice the value."""
        return 2 * self.x


def saved(model: ac.CompiledModel, path: Path) -> ac.CompiledModel:
    """Return what is loaded after the model was written."""
    ac.export_dae(model, path)
    return ac.load_dae(path)


def plain(value: Any) -> str:
    """Return a report without seconds and folders, which are not kept."""
    return re.sub(r"(/[\w.-]+)*/(\w+\.py)", r"\2", str(value))


def same_runs(one: ac.CompiledModel, other: ac.CompiledModel, **how: Any) -> None:
    """Both give the same numbers, bit by bit, and the same words."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ac.AcausalWarning)
        a, b = (ac.simulate(model, energy=True, **how) for model in (one, other))
    assert list(a) == list(b)
    assert a.outputs == b.outputs
    wrong = [name for name in a if a[name].tobytes() != b[name].tobytes()]
    assert not wrong
    told = [{k: plain(v) for k, v in r.stats.items() if "seconds" not in k} for r in (a, b)]
    assert told[0] == told[1]


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(s, marks=pytest.mark.slow) if k % 2 or s in ("slider-crank", "shaft") else s
        for k, s in enumerate(SCENES)
    ],
)
def test_scenes_simulate_identically(scene, tmp_path):
    own = compiled(SCENES[scene])
    loaded = saved(own, tmp_path / "a.dae")
    same_runs(own, loaded)
    reports = [{k: plain(v) for k, v in m.report.items() if k != "seconds"} for m in (own, loaded)]
    assert reports[0] == reports[1]
    texts = [text.partition("seconds")[0].split() for text in (plain(own.summary()), loaded.summary())]
    assert texts[0] == texts[1]  # lines break elsewhere beside the names of folders
    if own.report["stays_zero"]:  # parts of the linear system that a loaded model has only if the file has them
        own = ac.compile(SCENES[scene](), full=True)
        loaded = saved(own, tmp_path / "full.dae")
    a, b = (ac.linearize(m) for m in (own, loaded))
    assert (a.states, a.inputs, a.outputs) == (b.states, b.inputs, b.outputs)
    assert [getattr(a, n).tobytes() for n in "ABCD"] == [getattr(b, n).tobytes() for n in "ABCD"]


@pytest.mark.parametrize("scene", ["slider-crank", "bricard"])
def test_written_again_it_is_the_same_file(scene, tmp_path):
    loaded = saved(compiled(SCENES[scene]), tmp_path / "a.dae")
    ac.export_dae(loaded, tmp_path / "b.dae")
    assert (tmp_path / "a.dae").read_bytes() == (tmp_path / "b.dae").read_bytes()


def test_hybrid_model(tmp_path):
    own = ac.compile(Controlled(wanted=0.4))
    loaded = saved(own, tmp_path / "a.dae")
    same_runs(own, loaded)
    changed = {"late": 0.9, "tau": 0.2}
    same_runs(own, loaded, parameters=changed)
    same_runs(own, loaded, parameters={"end": 0.4})
    assert ac.simulate(loaded, parameters={"end": 0.4}).time[-1] == 0.8
    assert ac.simulate(loaded)["twice"].tolist() == (2 * ac.simulate(own)["x"]).tolist()


class Decay(Model):
    """No algebraic unknown, no condition at the start, nothing that repeats."""

    stop_time = 1.0
    rate: Scalar = parameter("rate", unit="1/s", default=1.0)
    x: Scalar = variable("value", start=1.0)

    def equations(self):
        yield der(self.x) == -self.rate * self.x


class Nothing(Model):
    """No state."""

    stop_time = 1.0
    x: Scalar = output("value")

    def equations(self):
        yield self.x == time


@pytest.mark.parametrize("model", [Decay, Nothing])
def test_models_that_lack_something(model, tmp_path):
    own = ac.compile(model())
    same_runs(own, saved(own, tmp_path / "a.dae"), initial="guesses")


def test_open_input_is_linearised_alike(tmp_path):
    own = ac.compile(Controlled())
    a, b = (ac.linearize(m) for m in (own, saved(own, tmp_path / "a.dae")))
    assert a.inputs == b.inputs == ("wanted",)
    assert a.B.tobytes() == b.B.tobytes()


@pytest.mark.parametrize(
    "changed",
    [{"tau": -1.0}, {"late": 6}, {"kind": "fast"}, {"x": 1}, {"taw": 1}, {"end": -1}],
)
def test_wrong_parameters_are_refused_alike(changed, tmp_path):
    own = ac.compile(Controlled(wanted=0.4))
    why = []
    for model in (own, saved(own, tmp_path / "a.dae")):
        with pytest.raises(ac.DeclarationError) as refused:
            ac.simulate(model, parameters=changed)
        why.append(plain(refused.value))
    assert why[0] == why[1]


def test_what_only_a_class_can_check_is_told(tmp_path):
    loaded = saved(ac.compile(Controlled(wanted=0.4)), tmp_path / "a.dae")
    with pytest.warns(ac.AcausalWarning, match=r"`step` was changed .* not checked"):
        ac.simulate(loaded, parameters={"step": 0.2})


def test_what_needs_classes_is_refused(tmp_path):
    loaded = saved(ac.compile(Controlled(wanted=0.4)), tmp_path / "a.dae")
    for function in (ac.study, ac.effects):
        with pytest.raises(ac.DeclarationError, match="compiled already; give the model itself"):
            function(loaded)  # type: ignore[arg-type]
    with pytest.raises(ac.ExportError, match=r"Write it as an open DAE"):
        pickle.dumps(loaded)
    again = pickle.loads(pickle.dumps(ac.simulate(loaded)))
    assert again["x"].tolist() == ac.simulate(copy(loaded))["x"].tolist()


def test_parameters_of_the_file(tmp_path):
    model = Controlled(wanted=0.4)
    ac.export_dae(model, tmp_path / "a.dae", parameters={"tau": 0.5})
    ac.export_dae(ac.compile(model), tmp_path / "b.dae", parameters={"tau": 0.5})
    for name in ("a.dae", "b.dae"):
        same_runs(ac.compile(model, parameters={"tau": 0.5}), ac.load_dae(tmp_path / name))


def test_unknown_names_are_told_alike(tmp_path):
    own = ac.compile(SCENES["simple-pendulum"]())
    found = [ac.simulate(m) for m in (own, saved(own, tmp_path / "a.dae"))]
    for key in ("hinge.fi", "hinge", "hinge.n", "bar.frame_a.R"):
        why = []
        for result in found:
            with pytest.raises(ac.DeclarationError) as refused:
                _ = result[key]
            why.append(str(refused.value))
        assert why[0] == why[1]


ALONE = """
import sys, acausal as ac, numpy as np
sys.meta_path.insert(0, type("No", (), {"find_spec": staticmethod(
    lambda name, *_: (_ for _ in ()).throw(ImportError(name)) if name.split(".")[0] in ("machine", "components") else None)}))
result = ac.simulate(ac.load_dae(sys.argv[1]))
np.save(sys.argv[2], np.column_stack([result[n].reshape(len(result.time), -1) for n in result]))
assert not {"machine", "components", "models"} & {name.split(".")[0] for name in sys.modules}
"""


def test_without_classes(tmp_path, monkeypatch):
    source = tmp_path / "machine.py"
    source.write_text(
        "from acausal import Model, connect\nfrom components import Body, Revolute, World, FixedTranslation\n\n\n"
        "class Machine(Model):\n    stop_time = 1.0\n    world = World()\n    hinge = Revolute(phi=0.3)\n"
        "    bar = FixedTranslation(r=(1, 0, 0))\n    mass = Body(m=2)\n\n    def connections(self):\n"
        "        yield connect(self.world.frame_b, self.hinge.frame_a)\n"
        "        yield connect(self.hinge.frame_b, self.bar.frame_a)\n"
        "        yield connect(self.bar.frame_b, self.mass.frame_a)\n".replace(
            "phi=0.3", "phi=fixed(0.3), w=fixed(0)"
        ).replace("import Model, connect", "import Model, connect, fixed")
    )
    monkeypatch.syspath_prepend(tmp_path)
    from machine import Machine  # type: ignore[import-not-found]

    own = ac.compile(Machine())
    ac.export_dae(own, tmp_path / "a.dae")
    source.unlink()
    words = [sys.executable, "-c", ALONE, str(tmp_path / "a.dae"), str(tmp_path / "a.npy")]
    subprocess.run(words, check=True, cwd=tmp_path)
    result = ac.simulate(own)
    expected = np.column_stack([result[n].reshape(len(result.time), -1) for n in result])
    assert np.load(tmp_path / "a.npy").tobytes() == expected.tobytes()


def test_no_folders_of_the_machine(tmp_path):
    ac.export_dae(compiled(SCENES["slider-crank"]), tmp_path / "a.dae")
    with zipfile.ZipFile(tmp_path / "a.dae") as file:
        said = b"".join(file.read(name) for name in file.namelist())
    assert str(Path(__file__).parents[3]).encode() not in said


def test_every_operation_is_read_as_it_was():
    x, y = ca.SX.sym("x", 2), ca.SX.sym("y")
    sparse = ca.SX(ca.Sparsity.upper(2), ca.vertcat(x, y))
    made = [ca.SX.unary(op, y) if k in UNARY else ca.SX.binary(op, x[0], y) for k, op in enumerate(KINDS)]
    column = [e for e in made if not e.is_symbolic()]
    powers = [y**3, y**-2, y**2.5, ca.if_else(x[0] < y, x[1], 1 - y), ca.SX(3, 2), ca.SX(-2.5), ca.SX(0, 1)]
    writer = Writer()
    for expression in [x, y, sparse, *column, *powers]:
        writer.add(expression)
    operations, symbols = writer.operations()
    assert len(NAMES) == len(KINDS) - 2  # no file holds functions of other libraries
    reader = Reader(operations, lambda k, name: symbols[k])
    for k, expression in enumerate([x, y, sparse, *column, *powers]):
        assert reader[k].sparsity() == expression.sparsity()
        assert ca.is_equal(reader[k], expression, 100)


@pytest.mark.parametrize(
    ("what", "wrong"),
    [
        ("operations", [[99, 0, 0]]),
        ("operations", [[0, 0, 5]]),
        ("operations", [[0, -1, 0]]),
        ("places", [7]),
        ("places", [-1]),
    ],
)
def test_operations_that_cannot_be_are_refused(what, wrong):
    good = {"operations": np.array([[0, 0, 0]], INT), "places": np.array([1], INT)}
    given = {**good, what: np.array(wrong, INT)}
    with pytest.raises(ValueError, match=r"\w"):
        Reader(Operations(np.zeros(0), ["x"], shapes=[(1, 1, None)], **given), lambda k, name: ca.SX.sym(name))


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    path = tmp_path_factory.mktemp("dae") / "a.dae"
    ac.export_dae(compiled(SCENES["simple-pendulum"]), path)
    return path


def members(path: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(path) as file:
        return {name: file.read(name) for name in file.namelist()}


def packed(path: Path, content: dict[str, bytes]) -> Path:
    with zipfile.ZipFile(path, "w") as file:
        for name, data in content.items():
            file.writestr(name, data)
    return path


def why(path: Any) -> str:
    with pytest.raises(ac.DeclarationError) as refused:
        ac.load_dae(path)
    return str(refused.value)


def test_cut_files_are_refused(good, tmp_path):
    content = good.read_bytes()
    for length in (0, 1, 100, len(content) // 2, len(content) - 1):
        (tmp_path / "cut.dae").write_bytes(content[:length])
        assert "it is not an open DAE, or it is truncated or damaged" in why(tmp_path / "cut.dae")


def test_damaged_files_are_refused_or_the_same(good, tmp_path):
    content, rng, refused = good.read_bytes(), np.random.default_rng(0), 0
    for place in rng.integers(0, len(content), 150).tolist():
        damaged = bytearray(content)
        damaged[place] ^= 1 << int(rng.integers(8))
        (tmp_path / "b.dae").write_bytes(damaged)
        try:
            loaded = ac.load_dae(tmp_path / "b.dae")
        except ac.DeclarationError:
            refused += 1
        else:  # a bit that says when the file was written, or on which system
            ac.export_dae(loaded, tmp_path / "c.dae")
            assert (tmp_path / "c.dae").read_bytes() == content
    assert refused > 100


@pytest.mark.parametrize("name", [dae_archive.FIRST, *dae_archive.MEMBERS])
def test_a_member_that_is_changed_missing_or_there_twice_is_refused(good, tmp_path, name):
    content = members(good)
    at = len(content[name]) // 2
    other = bytes([content[name][at] ^ 1])
    changed = content[name][:at] + other + content[name][at + 1 :]
    assert f"{name} is damaged" in why(packed(tmp_path / "b.dae", {**content, name: changed}))
    less = {k: v for k, v in content.items() if k != name}
    assert ("not an open DAE" if name == dae_archive.FIRST else "each once") in why(packed(tmp_path / "c.dae", less))


def test_foreign_files_are_refused(good, tmp_path):
    content = members(good)
    (tmp_path / "text.dae").write_text("not a model")
    assert "it is not an open DAE" in why(tmp_path / "text.dae")
    assert "it has no dae.json" in why(packed(tmp_path / "a.dae", {"a": b""}))
    assert "does not name the format" in why(packed(tmp_path / "b.dae", {**content, "dae.json": b'{"format": "x"}'}))
    assert "version 5" in why(
        packed(
            tmp_path / "c.dae", {**content, "dae.json": content["dae.json"].replace(b'"version":4', b'"version":5', 1)}
        )
    )
    assert "each once" in why(packed(tmp_path / "d.dae", {**content, "more": b""}))
    assert "No such file" in why(tmp_path / "none.dae")
    assert "directory" in why(tmp_path)
    for wrong in (None, 3, "a\0b"):
        assert "cannot read" in why(wrong)


def test_absurd_sizes_are_refused(good, tmp_path, monkeypatch):
    monkeypatch.setattr(dae_archive, "MOST", 1 << 10)
    assert "its content has more than" in why(good)


def test_content_that_contradicts_itself_is_refused(good, tmp_path):
    first, content = dae_archive.read(good)
    head = {k: v for k, v in first.items() if k not in ("format", "version", "sha256", "sha256_of_this")}
    for name, old, new in (
        ("model.json", b'"is":"Plan"', b'"is":"Plane"'),
        ("model.json", b'"class":0', b'"class":-99'),
        ("model.json", b'"expression":1}', b'"expression":123456}'),
        ("places", content["places"][:8], b"\xff" * 8),
    ):
        dae_archive.write(tmp_path / "b.dae", head, {**content, name: content[name].replace(old, new, 1)})
        assert "is inconsistent" in why(tmp_path / "b.dae")


def test_a_file_that_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(ac.ExportError, match="there is no directory"):
        ac.export_dae(SCENES["simple-pendulum"](), tmp_path / "none" / "a.dae")


def test_read_without_acausal(good, tmp_path):
    text = (Path(__file__).parents[3] / "docs/background/open-dae.md").read_text()
    code = re.search(r"```python\n(import json.*?)```", text, re.DOTALL)
    assert code
    assert len(code[1].splitlines()) <= 20
    done = subprocess.run(
        [sys.executable, "-I", "-c", code[1].replace("pendulum.dae", str(good))],
        capture_output=True,
        text=True,
        check=True,
    )
    own = compiled(SCENES["simple-pendulum"])
    p = own.parameter_values(None)
    x = np.array([0.1, 0.2])
    values = own.values(x, np.array([0.3]), p, 0.0, np.ones(own.reduced.constants.numel()), 0.0)[0][:3]
    assert [float(v) for v in done.stdout.split()[-3:]] == pytest.approx(values.tolist(), rel=1e-14, abs=1e-15)
