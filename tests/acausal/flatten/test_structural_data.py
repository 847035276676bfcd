"""Structural values that are objects: checked, compared, shown, read from files and sent."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import acausal as ac
from acausal import Component, DeclarationError, Model, Scalar, der, output, quantity, structural, variable
from acausal.flatten import template_reuse
from acausal.flatten.instantiate import Instantiation
from acausal.language import data
from acausal.study.measuring.case import Case
from acausal.study.measuring.journal import identity
from acausal.study.measuring.model_pickling import pack, unpack


@dataclass(frozen=True, eq=False, repr=False)
class Rates:
    """Data with a digest: what FE bodies are."""

    values: np.ndarray

    @classmethod
    def load(cls, path: str | Path) -> Rates:
        found = np.loadtxt(path)
        if np.any(found <= 0):
            raise DeclarationError(f"{Path(path).name} has rates that are not positive.")
        return cls(np.atleast_1d(found))

    @property
    def n(self) -> int:
        return len(self.values)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Rates) and np.array_equal(self.values, other.values)

    def __hash__(self) -> int:
        return hash(self.values.tobytes())

    def __repr__(self) -> str:
        return f"Rates({self.n}, {self.values.sum():.12g})"


class Told(Rates):
    """Data whose text tells all of it: sums of others may be equal."""

    def __repr__(self) -> str:
        return f"Told({self.values.tolist()})"


@dataclass(frozen=True)
class Careless:
    """Data that nobody can compare: a record of an array."""

    values: np.ndarray


class Modes(Component):
    """Modes that decay."""

    rates: Any = structural("rates of decay in 1/s", cls=Rates)
    modes: Any = structural("number of modes", default=None, cls=int, minimum=0, maximum=lambda s: s.rates.n)
    table: Any = structural("more about it", default=None)
    q: Any = variable(
        "amplitudes",
        unit="m",
        shape=lambda s: (s.rates.n if s.modes is None else s.modes,),
        start=1.0,
        fixed=True,
    )

    def equations(self):
        n = len(self.q)
        yield der(self.q) == -quantity(np.diag(self.rates.values[:n]), "1/s") @ self.q


THREE = Rates(np.array([1.0, 2.0, 3.0]))


class Decays(Model):
    body: Any = Modes(rates=THREE)
    y: Scalar = output("sum", unit="m")

    def equations(self):
        yield self.y == sum(self.body.q)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"body.rates": 3}, r"is 3; it must be a Rates, or the name of its file\."),
        ({"body.rates": Rates}, "is the class Rates; it must be a Rates"),
        ({"body.rates": None}, "is None; it must be a Rates"),
        ({"body.rates": np.ones(3)}, "it must be a Rates"),
        ({"body.rates": np.ones(300)}, r"is an array of shape \(300,\); it must be a Rates"),
        ({"body.rates": "none.txt"}, "'none.txt' contains no Rates: .*none.txt not found"),
        ({"body.modes": 2.5}, r"is 2\.5; it must be a whole number, or None\."),
        ({"body.modes": True}, r"is True; it must be a whole number, or None\."),
        ({"body.modes": "2"}, r"is '2'; it must be a whole number, or None\."),
        ({"body.modes": 4}, r"is 4; it must be a number of at most 3\."),
        ({"body.modes": -1}, r"is -1; it must be a number of at least 0\."),
    ],
)
def test_values_of_another_kind(values, message):
    for read in (lambda: ac.compile(Decays(), values), lambda: Instantiation(Decays(), values)):
        with pytest.raises(DeclarationError, match=f"of body \\(Modes, .*test_structural_data.py:.*{message}"):
            read()


@pytest.mark.parametrize("modes", [None, 0, 1, 3, np.int64(2)])
def test_values_that_fit(modes):
    result = ac.simulate(Decays(), stop_time=1, tolerance=1e-8, parameters={"body.modes": modes})
    n = 3 if modes is None else int(modes)
    assert type(Instantiation(Decays(), {"body.modes": modes}).root.body.modes) in (int, type(None))
    np.testing.assert_allclose(result["body.q"][-1], np.exp(-THREE.values[:n]), rtol=1e-6)


def test_a_file_name_stands_for_what_the_class_loads(tmp_path):
    path = tmp_path / "rates.txt"
    path.write_text("1 5\n")
    for name in (path, str(path)):
        result = ac.simulate(Decays(), stop_time=1, tolerance=1e-10, parameters={"body.rates": name})
        np.testing.assert_allclose(result["body.q"][-1], np.exp([-1, -5]), rtol=1e-6)
        with pytest.raises(DeclarationError, match=r"`body.rates` is structural .* its value is Rates\(2, 6\)"):
            result["body.rates"]
    first, second = (Instantiation(Decays(), {"body.rates": path}).root.body.rates for _ in range(2))
    assert first is second  # read once
    path.write_text("1 5 7\n")
    assert Instantiation(Decays(), {"body.rates": path}).root.body.rates.n == 3
    path.write_text("1 -5\n")
    with pytest.raises(DeclarationError, match=r"`rates` of body \(.*\): rates.txt has rates that are not positive\."):
        ac.compile(Decays(), {"body.rates": path})
    path.write_text("one\n")
    with pytest.raises(DeclarationError, match=r"rates.txt' contains no Rates: could not convert string 'one'"):
        ac.compile(Decays(), {"body.rates": path})


@pytest.mark.parametrize(
    ("declared", "message"),
    [
        (lambda: structural("n", cls="int"), r"cls='int' must be a class, such as cls=int"),
        (lambda: structural("n", cls=int, default=2.5), r"default=2\.5 must be a whole number"),
        (lambda: structural("n", cls=Rates, default=3), r"default=3 must be a Rates, or the name of its file"),
        (lambda: structural("n", maximum="3"), r"maximum='3' must be a number, or a function of the component"),
        (lambda: structural("n", maximum=lambda: 3), r"a computed maximum is a function of the component"),
    ],
)
def test_declarations(declared, message):
    with pytest.raises(DeclarationError, match=f"M.n: {message}"):
        type("M", (Component,), {"n": declared()})


def test_the_docstring_tells_class_and_bounds():
    class Bounded(Component):
        """Bounded."""

        rates: Any = structural("rates", cls=Rates)
        n: Any = structural("count", default=2, cls=int, minimum=1, maximum=5)

    assert "rates : Rates or str\n" in str(Bounded.__doc__)
    assert "n : int, at least 1, at most 5, default 2\n" in str(Bounded.__doc__)


ARRAYS = st.lists(st.floats(-2, 2), min_size=0, max_size=4).map(np.array)
VALUES = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(-3, 3), st.text(max_size=3), ARRAYS, ARRAYS.map(Told)),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.tuples(inner), ARRAYS.map(Careless)),
    max_leaves=5,
)


def copied(value: Any) -> Any:
    """An equal value that is another object."""
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, Rates | Careless):
        return type(value)(value.values.copy())
    return type(value)(map(copied, value)) if isinstance(value, list | tuple) else value


@settings(max_examples=200, deadline=None)
@given(VALUES, VALUES)
def test_what_is_one_value_is_one_case(a, b):
    """Equal values are equal in studies and journals, whatever they hold; others are not."""
    assert data.same(a, copied(a))
    assert json.dumps(data.plain(a)) == json.dumps(data.plain(copied(a)))
    assert Case(settings={"x": a}) == Case(settings={"x": copied(a)})
    if not data.same(a, b):
        assert Case(settings={"x": a}).key != Case(settings={"x": b}).key


def test_big_data_are_told_apart_by_all_their_entries():
    one, other = np.zeros(5000), np.zeros(5000)
    other[2500] = 1e-300
    assert repr(one) == repr(other)  # numpy leaves most out
    for kind in (np.asarray, Careless, lambda x: [Careless(x)]):
        assert not data.same(kind(one), kind(other))
        assert Case(settings={"x": kind(one)}).key != Case(settings={"x": kind(other)}).key
        assert Case(settings={"x": kind(one)}).key == Case(settings={"x": kind(one.copy())}).key
    assert len(json.dumps(data.plain(Careless(one)))) < 100


def test_a_journal_tells_models_apart_by_their_data(tmp_path):
    path = tmp_path / "rates.txt"
    path.write_text("1 2 3\n")

    def told(model: Model, **values: Any) -> dict[str, Any]:
        values = {path.replace("_", "."): value for path, value in values.items()}
        tree = Instantiation(model, values).root
        return json.loads(json.dumps(identity(model, [tree], given=values)))

    class Other(Decays):
        body = Modes(rates=Rates(np.array([1.0, 2.0, 4.0])))

    own = told(Decays())
    assert own == told(Decays())
    assert own != told(Other())
    assert told(Decays(), body_rates=Rates(THREE.values.copy()))["data"] == own["data"]
    first = told(Decays(), body_rates=str(path))
    assert first["data"] == own["data"]
    path.write_text("1 2 5\n")
    assert told(Decays(), body_rates=str(path)) != first
    given = (told(Decays(body=Modes(rates=THREE, modes=n)))["values"] for n in (1, 2))
    assert next(given) != next(given)


def test_components_with_equal_data_are_alike():
    class Many(Model):
        @ac.parts
        def bodies(self):
            return [Modes(rates=Rates(np.array([1.0, 2.0])), table=Careless(np.ones(2))) for _ in range(6)]

    tree = Instantiation(Many()).root
    assert template_reuse._structural_key(tree.bodies[0].rates) == template_reuse._structural_key(tree.bodies[1].rates)
    assert template_reuse._structural_key(tree.bodies[0].table) != template_reuse._structural_key(tree.bodies[1].table)
    result = ac.simulate(Many(), stop_time=1, tolerance=1e-8)
    np.testing.assert_allclose(result["bodies[5].q"][-1], np.exp([-1, -2]), rtol=1e-6)


def test_what_a_worker_is_sent():
    """As many numbers as a body of 40 modes has: 40 x 40 x 3 x 3 products and what else there is."""
    big = Rates(np.random.default_rng(0).uniform(1, 2, 40 * 40 * 9 + 4 * 40 * 40))
    model = Decays(body=Modes(rates=big, modes=1))
    sent = pack(model)
    assert len(sent) < 1_000_000
    assert len(pack(Decays())) + big.values.nbytes + 1000 > len(sent)
    again: Any = unpack(sent)
    assert again._values["body"]._values["rates"] == big


def test_a_study_over_data(tmp_path):
    journal = tmp_path / "journal.jsonl"
    values = [THREE, Rates(np.array([1.0, 2.0, 3.0, 1e3]))]
    study = ac.study(
        Decays(),
        stop_time=1,
        switches={"body.rates": values},
        tolerances=[1e-4, 1e-6],
        repeats=1,
        workers=1,
        journal=journal,
    )
    assert {str(row.case.settings["body.rates"]) for row in study.rows} == {"Rates(3, 6)", "Rates(4, 1006)"}
    study.to_csv(tmp_path / "study.csv")
    assert "Rates(3, 6)" in (tmp_path / "study.csv").read_text()
    assert "Rates" in study.table()


def test_a_file_name_on_the_command_line(tmp_path):
    rates, table = tmp_path / "rates.txt", tmp_path / "table.csv"
    rates.write_text("1 5\n")
    scene = f"{__file__}:Decays"
    call = [sys.executable, "-m", "acausal", "simulate", scene, "--stop-time", "1", "--intervals", "2"]

    def run(value: str) -> subprocess.CompletedProcess[str]:
        given = [*call, "--set", f"body.rates={value}", "--csv", str(table)]
        return subprocess.run(given, capture_output=True, text=True, cwd=tmp_path, check=False, timeout=120)

    done = run("rates.txt")
    assert done.returncode == 0, done.stderr
    assert float(table.read_text().split(",")[-1]) == pytest.approx(np.exp(-1) + np.exp(-5), rel=1e-4)
    for wrong, message in (
        ("nothing.txt", "contains no Rates: "),
        ("3", "is 3; it must be a Rates, or the name of its file"),
    ):
        done = run(wrong)
        assert done.returncode == 2
        assert message in " ".join(done.stderr.split())
