"""Equal components share one evaluation of their equations, and state what each would state alone."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal.flatten import FlatModel, flatten, template_reuse
from acausal.language.functions import feedback, initial, time
from components import BodyRod, Revolute, World
from models import NFourBar, SpinUp, Squeezer

COUNT = 5


class Rods(ac.Model):
    """Rods with joints that differ: friction in some, and another axis in every second."""

    world = World()

    @ac.parts
    def joint(self):
        return [Revolute(n=(0, k % 2, 1), d=0.1 * (k % 3), tau_dry=0.2 * (k == 7)) for k in range(12)]

    @ac.parts
    def rod(self):
        return [BodyRod(r=(1, 0, 0.1 * (k > 5)), m=1) for k in range(12)]

    def connections(self):
        links = zip(self.joint, self.rod, strict=True)
        yield ac.chain(self.world, *[part for link in links for part in link])


class Part(ac.Component):
    """A part whose equations are counted and depend on what it is given."""

    calls = 0
    stop: Any = ac.structural("where a stop is", default=None)
    k: ac.Scalar = ac.parameter("rate", unit="1/s", default=1.0)
    x: ac.Scalar = ac.variable("state", unit="1", start=1.0)
    y: ac.Scalar = ac.variable("its second derivative", unit="1/s2")
    z: ac.Scalar = ac.variable("limited", unit="1")

    def __init__(self, sign: float = 1.0, **values: Any) -> None:
        super().__init__(**values)
        self.sign = sign

    def equations(self):
        type(self).calls += 1
        yield ac.der(self.x) == -self.sign * self.k * self.x
        yield self.y == ac.der(ac.der(self.x))
        yield self.z == (self.x if self.stop is None else ac.piecewise((self.x, self.x < self.stop), self.stop))

    def stored_energy(self):
        return ac.quantity(1.0, "J") * self.x**2


class Parts(ac.Model):
    """Parts made by a function of their number."""

    make: Any = ac.structural("makes a part", default=lambda s: lambda k: Part())

    @ac.parts
    def part(self):
        return [self.make(k) for k in range(COUNT)]


def told(flat: FlatModel) -> list[Any]:
    """Everything of a flat model that can be compared."""
    u, e, d = flat.unknowns, flat.equations, flat.discontinuities
    given = [u.symbols, flat.parameters.symbols, ca.vertcat(time.sx, initial.sx, feedback.sx), d.constants]
    energies = ca.substitute(ca.vertcat(*flat.energies.values()), *u.eliminated)
    start = ca.vertcat(*[i.residual for i in e.initial])
    function = ca.Function("told", given, [ca.densify(x) for x in (e.residuals, energies, start)])
    values = function(*[np.linspace(0.3, 0.9, g.numel()) for g in given])
    words = [u.names, u.derivative, e.origins, e.defines, e.redundant, [(i.text, i.origin) for i in e.initial]]
    return [*words, dict(flat.counts), [g.origin for g in d.guards], [np.array(v).tolist() for v in values]]


@pytest.mark.parametrize(
    "model",
    [Rods(), SpinUp(volumes=6), NFourBar(N=5), Squeezer(), Parts()],
    ids=lambda model: type(model).__name__,
)
def test_they_state_what_each_would_have_stated(model: ac.Model, monkeypatch: pytest.MonkeyPatch) -> None:
    once = told(flatten(model))
    monkeypatch.setattr(template_reuse, "FEWEST", 10**6)
    assert told(flatten(model)) == once


@pytest.mark.parametrize(
    ("make", "calls"),
    [
        (lambda k: Part(), 1),
        (lambda k: Part(k=k + 1.0), 1),
        (lambda k: Part(k=float(k > 0)), 2),  # one has a constant 0
        (lambda k: Part(sign=1.0 if k else -1.0), 2),
        (lambda k: Part(sign=float(k)), COUNT),
        (lambda k: Part(stop=0.5), COUNT + 1),  # heard once in vain: it requests a switch
    ],
    ids=["equal", "parameters", "zero", "attribute", "attributes", "switch"],
)
def test_how_often_equations_are_formed(make: Any, calls: int) -> None:
    Part.calls = 0
    flatten(Parts(make=make))
    assert Part.calls == calls


def test_each_keeps_its_own_values() -> None:
    compiled = ac.compile(Parts(make=lambda k: Part(k=k + 1.0)))
    result = ac.simulate(compiled, stop_time=1.0, initial="guesses")
    np.testing.assert_allclose(
        [result[f"part[{k}].x"][-1] for k in range(COUNT)], np.exp(-np.arange(1.0, COUNT + 1)), rtol=1e-3
    )


def test_what_is_wrong_is_told_of_the_first() -> None:
    class Wrong(Part):
        def equations(self):
            yield self.x == self.y

    with pytest.raises(ac.UnitsError, match=r"part\[0\] \(Wrong\), .*_reuse.py:\d+: units differ: `?part\[0\].x"):
        flatten(Parts(make=lambda k: Wrong()))
