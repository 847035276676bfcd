"""The reduced model as Base Modelica, read back by pymoca: residuals at random points."""

from __future__ import annotations

import re

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, discrete, output, parameter, piecewise, reinit, time, variable, when
from acausal.export.dae.base_modelica import base_modelica
from acausal.export.dae.modelica_text import Names, number
from models import SCENES, FreeVibration
from tests.shared import every_other

TOLERANCE = 1e-13


class Bounce(Model):
    """A ball on a floor that drives a counter."""

    e: Scalar = parameter("restitution", default=0.7)
    x: Scalar = variable("height", unit="m", start=1.0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0.0, fixed=True)
    n: Scalar = discrete("hits")
    y: Scalar = output("height, limited")

    def equations(self):
        yield self.v == ac.der(self.x)
        yield ac.der(self.v) == piecewise((-9.81, time < 1.5), -5.0)
        yield self.y == piecewise((self.x, self.x < 0.5), 0.5)
        yield when((self.x < 0) & (self.v < 0), reinit(self.v, -self.e * self.v), reinit(self.n, self.n + 1))


def text_of(compiled):
    return base_modelica(compiled, compiled.parameter_values(None))


@pytest.fixture(scope="module")
def pymoca():
    """How pymoca reads a text; it lacks some functions of Modelica, CasADi has them."""
    parser = pytest.importorskip("pymoca.parser")
    generator = pytest.importorskip("pymoca.backends.casadi.generator")
    known = {"atan2": ca.atan2, "asin": ca.asin, "acos": ca.acos, "atan": ca.atan, "noEvent": ca.MX}
    before = {name: ca.MX.__dict__.get(name) for name in [*known, "__div__"]}
    for name, function in known.items():
        setattr(ca.MX, name, lambda *arguments, function=function: function(*arguments))
    ca.MX.__div__ = ca.MX.__truediv__  # type: ignore[attr-defined]

    def read(text):
        text = text.replace(
            "(if initial() then 1.0 else 0.0)", "0.0"
        )  # pymoca knows no initial(): while the model runs
        name = re.findall(r"package ('[^']*')", text)[0]
        return generator.generate(parser.parse(text), f"{name}.{name}")

    yield read
    for name, method in before.items():
        if method is None:
            delattr(ca.MX, name)
        else:
            setattr(ca.MX, name, method)


def solved(model, text, given, t):
    """Values of derivatives, of all that stands alone on the left of an equation, and residuals of the other equations.

    As many passes as definitions are deep give all of them.
    """
    symbols = {v.symbol.name(): v.symbol for v in [*model.states, *model.alg_states, *model.parameters]}
    rates = {v.symbol.name(): v.symbol for v in model.der_states}
    free = {name: s for name, s in symbols.items() if name not in given} | rates
    known = [symbols[name] for name in given]
    column = ca.vertcat(*model.equations)
    function = ca.Function("f", [ca.vertcat(*known), ca.vertcat(*free.values()), model.time], [column])
    targets = [line.strip().partition(" = ")[0] for line in text.partition("\n  equation\n")[2].splitlines()]
    targets = targets[: len(model.equations)]
    place = {name: k for k, name in enumerate(free)}
    rows = [(row, place[name]) for row, name in enumerate(targets) if name in place]
    found = np.ones(len(free))
    for _ in range(len(free) + 2):
        residuals = np.array(function(list(given.values()), found, t)).ravel()
        new = found.copy()
        for row, k in rows:
            new[k] = found[k] - residuals[row]
        new[~np.isfinite(new)] = 1.0
        if np.array_equal(new, found):
            break
        found = new
    others = [row for row, name in enumerate(targets) if name not in place]
    return dict(zip(free, found, strict=True)), -residuals[others]


@pytest.mark.parametrize("scene", every_other(SCENES))
def test_residuals_are_those_of_the_model(pymoca, scene):
    compiled = ac.compile(SCENES[scene]())
    agrees(pymoca, compiled, 0.01)


def agrees(pymoca, compiled, t):
    r, rng = compiled.reduced, np.random.default_rng(1)
    text = text_of(compiled)
    model = pymoca(text)
    n, values = compiled.nx + compiled.nz, compiled.parameter_values(None)
    at = compiled.start(values, t)[0] + 0.1 * rng.standard_normal(n)
    x, z = np.split(at, [compiled.nx])
    chosen = rng.uniform(0.5, 1.5, r.constants.numel())
    layout = compiled.layout
    others = {v.symbol.name() for v in model.parameters}
    p = {f"'{name}'": value for name, value in zip(r.flat.parameters.names, values, strict=True)}
    names = [f"'${s.name()}'" for s in ca.vertsplit(r.constants[layout.switches + layout.discretes :])]
    p |= dict(zip(names, chosen[layout.switches + layout.discretes :], strict=True))
    p = {name: value for name, value in p.items() if name[1] != "$" or name in others}
    assert set(p) == others
    quoted = re.findall(r"^    Real ('[^'$]*')\(.*start = ", text, re.MULTILINE)
    more, residuals = solved(model, text, {**dict(zip(quoted, at, strict=True)), **p}, t)
    slopes = [more[f"der({name})"] for name in quoted[: compiled.nx]]
    for k in range(layout.switches):
        chosen[k] = more[f"'switch[{k + 1}]'"]
    expected = compiled.values(x, z, values, t, chosen, 0.0)[0][:n]
    size = np.maximum(1.0, np.abs(expected))
    assert np.max(np.abs(np.concatenate([slopes, residuals]) - expected) / size) <= TOLERANCE


def test_switches_and_jumps_of_a_hybrid_model(pymoca):
    compiled = ac.compile(Bounce())
    lines = [line.strip() for line in text_of(compiled).splitlines()]
    assert "'switch[1]' = if (time - 1.5) < 0.0 then 1.0 else 0.0;" in lines
    when = lines.index("when ('x' < 0.0) and ('v' < 0.0) then")
    assert lines[when + 1 : when + 4] == ["reinit('v', (-('e' * 'v')));", "'n' = (pre('n') + 1.0);", "end when;"]
    agrees(lambda text: pymoca(re.sub(r"    when .*?end when;\n", "", text, flags=re.DOTALL)), compiled, 1.0)


def test_hybrid_text_is_modelica():
    parser = pytest.importorskip("pymoca.parser")
    assert parser.parse(text_of(ac.compile(Bounce()))) is not None


def test_size_is_linear():
    sizes = [len(text_of(ac.compile(FreeVibration(elements=n)))) for n in (5, 10, 20)]
    assert sizes[2] - sizes[1] < 2.2 * (sizes[1] - sizes[0])


def test_names_and_texts_are_quoted():
    names = Names()
    assert [names("a"), names("a"), names("\u03c6'")] == ["'a'", "'a#2'", "'__'"]
    assert [number(v) for v in (1.0, -2.5, np.inf, -np.inf)] == ["1.0", "(-2.5)", "(1.0 / 0.0)", "(-1.0 / 0.0)"]
