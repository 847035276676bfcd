"""The reduced model as Base Modelica, read back by pymoca: residuals at random points."""

from __future__ import annotations

import re

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, discrete, output, parameter, piecewise, reinit, time, variable, when
from acausal.export.dae.base_modelica import base_modelica
from models import SCENES

TOLERANCE = 1e-13


class Bounce(Model):
    """A ball on a floor that drives a counter."""

    e: Scalar = parameter("restitution", default=0.7)
    x: Scalar = output("height", unit="m", start=1.0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", fixed=True)
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
        name = re.search(r"package ('[^']*')", text)[1]
        return generator.generate(parser.parse(text), f"{name}.{name}")

    yield read
    for name, method in before.items():
        if method is None:
            delattr(ca.MX, name)
        else:
            setattr(ca.MX, name, method)


def solved(model, x, z, p, t, names):
    """Values of derivatives, shared expressions and switches, and the residuals of the algebraic equations.

    What an equation defines stands alone on its left: as many passes as they are deep give all of them.
    """
    own = {v.symbol.name(): v.symbol for v in [*model.states, *model.alg_states]}
    given = {**dict(zip(names, [*x, *z], strict=True)), **p}
    own |= {v.symbol.name(): v.symbol for v in model.parameters}
    free = [s for name, s in own.items() if name not in given]
    rates = [v.symbol for v in model.der_states]
    known = [own[name] for name in given]
    function = ca.Function(
        "f", [ca.vertcat(*known), ca.vertcat(*free), ca.vertcat(*rates), model.time], model.equations
    )
    found, slopes = np.zeros(len(free)), np.zeros(len(rates))
    left = {s.name(): k for k, s in enumerate(free)}
    ders = {v.symbol.name(): k for k, v in enumerate(model.der_states)}
    for _ in range(len(free) + 2):
        values = [float(v) for v in function(list(given.values()), found, slopes, t)]
        before = found.copy(), slopes.copy()
        rows = []
        for row, value in enumerate(values):
            target = _left(model.equations[row])
            if target in left:
                found[left[target]] -= value
            elif target in ders:
                slopes[ders[target]] -= value
            else:
                rows.append(-value)
        if np.array_equal(before[0], found) and np.array_equal(before[1], slopes):
            break
    return slopes, rows, {name: found[k] for name, k in left.items()}


def _left(equation):
    """Name of what stands alone on the left of an equation."""
    first = equation.dep(0) if equation.n_dep() else equation
    return first.name() if first.is_symbolic() else ""


@pytest.mark.parametrize("scene", SCENES)
def test_residuals_are_those_of_the_model(pymoca, scene):
    compiled = ac.compile(SCENES[scene]())
    agrees(pymoca, compiled, 0.01)


def agrees(pymoca, compiled, t):
    r, rng = compiled.reduced, np.random.default_rng(1)
    model = pymoca(text_of(compiled))
    n, values = compiled.nx + compiled.nz, compiled.parameter_values(None)
    quoted = [f"'{name}'" for name in (*compiled.states, *compiled.algebraic)]
    at = compiled.start(values, t)[0] + 0.1 * rng.standard_normal(n)
    x, z = np.split(at, [compiled.nx])
    chosen = rng.uniform(0.5, 1.5, r.constants.numel())
    layout = compiled.layout
    others = {v.symbol.name() for v in model.parameters}
    p = {f"'{name}'": value for name, value in zip(r.flat.parameters.names, values, strict=True)}
    names = [f"'${s.name()}'" for s in ca.vertsplit(r.constants[layout.switches + layout.discretes :])]
    p |= dict(zip(names, chosen[layout.switches + layout.discretes :], strict=True))
    assert set(p) == others
    slopes, residuals, more = solved(model, x, z, p, t, quoted)
    for k in range(layout.switches):
        chosen[k] = more[f"'switch[{k + 1}]'"]
    expected = compiled.values(x, z, values, t, chosen, 0.0)[0][:n]
    size = np.maximum(1.0, np.abs(expected))
    assert np.all(np.abs(np.concatenate([slopes, residuals]) - expected) <= TOLERANCE * size)
