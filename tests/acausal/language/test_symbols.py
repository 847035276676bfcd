"""Symbols in Python operators, indices and numpy functions give correct results or clear errors."""

from __future__ import annotations

import math
import operator

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal import (
    DeclarationError,
    Expr,
    Matrix33,
    Model,
    Scalar,
    UnitsError,
    Vector3,
    chain,
    der,
    output,
    parameter,
    piecewise,
    structural,
    time,
    variable,
)
from components import rotational

M = np.arange(9.0).reshape(3, 3) + 1


class Values(Model):
    """Parameters with known values, and what a law makes of them."""

    s: Scalar = parameter("scalar", default=-2.0)
    v: Vector3 = parameter("vector", default=(1.0, -2.0, 3.0))
    m: Matrix33 = parameter("matrix", default=M)
    f: Vector3 = parameter("with units", unit=("m", "s", "kg"), default=(1.0, 2.0, 3.0))
    y: Scalar = output("scalar")
    w: Vector3 = output("vector")

    def law(self):
        return 0

    def equations(self):
        value = ac.as_expr(self.law())
        yield self.y == (0 if value.shape else value)
        yield self.w == (value if value.shape else (0, 0, 0))


def worth(law):
    """Value of a law of the parameters."""
    result = ac.simulate(type("Law", (Values,), {"law": law})(), stop_time=1, intervals=1)
    return result["w"][-1] if np.any(result["w"]) else result["y"][-1]


S, V = -2.0, np.array([1.0, -2.0, 3.0])
LAWS = {
    "abs": (lambda self: abs(self.s), 2),
    "abs of a vector": (lambda self: abs(self.v), abs(V)),
    "power of a number": (lambda self: 2**self.s, 0.25),
    "sine of numpy": (lambda self: np.sin(self.s), math.sin(S)),
    "other name": (lambda self: np.arctan2(self.s, 3), math.atan2(S, 3)),
    "absolute of numpy": (lambda self: np.abs(self.v), abs(V)),
    "square": (lambda self: np.square(self.s), 4),
    "dot": (lambda self: np.dot(self.v, (1, 2, 3)), 6),
    "cross": (lambda self: np.cross((1, 0, 0), self.v), np.cross((1, 0, 0), V)),
    "array from the left": (lambda self: np.array([1, 2, 3]) * self.s, S * np.array([1, 2, 3])),
    "sum with an array": (lambda self: np.array([1, 2, 3]) + self.v, V + np.array([1, 2, 3])),
    "matrix from the left": (lambda self: M @ self.v, M @ V),
    "number of numpy": (lambda self: np.float64(3) / self.s, -1.5),
    "row": (lambda self: self.m[1], M[1]),
    "last row": (lambda self: self.m[-1], M[2]),
    "rows": (lambda self: self.m[1:] @ (1, 0, 0), None),
    "row by row": (lambda self: [row[0] for row in self.m], M[:, 0]),
    "column": (lambda self: self.m[:, 2], M[:, 2]),
    "row of a slice": (lambda self: self.m[0, :], M[0]),
    "block": (lambda self: self.m[0:2, 1:3][1, 1], M[1, 2]),
    "entry": (lambda self: self.m[2, 0], M[2, 0]),
    "backwards": (lambda self: self.v[::-1], V[::-1]),
    "entry by entry": (lambda self: sum(x * x for x in self.v), V @ V),
    "scalar": (lambda self: self.s[0], S),
    "index of numpy": (lambda self: self.v[np.int64(1)], -2),
}


@pytest.mark.parametrize("name", LAWS)
def test_values(name):
    law, value = LAWS[name]
    if value is not None:
        assert worth(law) == pytest.approx(value)
        return
    with pytest.raises(DeclarationError, match="a vector of 3 and a vector of 2"):
        worth(law)


REFUSED = {
    "max": (lambda self: max(self.s, 0), "s < 0 is not known while the model is built"),
    "min of three": (lambda self: min(self.s, 1, self.v[0]), "s > 1 is not known while the model is built"),
    "maximum": (lambda self: np.maximum(self.v, 0), "numpy's `maximum` takes numbers, and v is symbolic"),
    "norm": (lambda self: np.linalg.norm(self.v), r"numpy's `norm` .*sqrt\(dot\(v, v\)\)"),
    "sum": (lambda self: np.sum(self.v), r"numpy's `sum`.*sum\(v\)"),
    "out": (lambda self: np.sin(self.s, where=True), "numpy's `sin`"),
    "reduce": (lambda self: np.add.reduce(self.v), "numpy's `add`"),
    "concatenate": (lambda self: np.concatenate([self.v, self.v]), "numpy's `concatenate`"),
    "array": (lambda self: np.array([self.s, 1, 2]), r"s is symbolic .*A tuple or a list is a vector"),
    "matrix": (lambda self: np.asarray([[self.s, 0], [0, 1]]), "numpy cannot make an array"),
    "floor": (lambda self: math.floor(self.s), "would jump without an event"),
    "rest": (lambda self: self.s % 2, "`%`, `//` and round"),
    "rest of a number": (lambda self: 7 % self.s, "`%`, `//` and round"),
    "whole part": (lambda self: 7 // self.s, "would jump without an event"),
    "round": (lambda self: round(self.s, 2), "would jump without an event"),
    "float": (lambda self: float(self.s), "s is symbolic and has no value .* cannot be a Python number"),
    "range": (lambda self: len(range(self.s)), "declare the field structural"),
    "beyond": (lambda self: self.v[3], r"`v\[3\]` is outside v, whose entries are v\[0\] to v\[2\]"),
    "before": (lambda self: self.v[-4], r"`v\[-4\]` is outside v"),
    "slice": (lambda self: self.v[1:7], r"`v\[1:7\]` is outside v"),
    "row": (lambda self: self.m[3], "which has 3 rows and 3 columns"),
    "column": (lambda self: self.m[0, 3], r"`m\[0, 3\]` is outside m"),
    "scalar": (lambda self: self.s[1], r"`s\[1\]` is outside s, which is a scalar"),
    "too many": (lambda self: self.m[0, 0, 0], r"`m\[0, 0, 0\]` is outside m"),
    "symbol": (lambda self: self.v[self.s], r"`v\[s\]`: entries of a symbol are selected by integers"),
    "fraction": (lambda self: self.v[0.5], "selected by integers"),
    "truth": (lambda self: self.v[True], "selected by integers"),
    "none": (lambda self: self.v[None], "selected by integers"),
    "set": (lambda self: operator.setitem(self.v, 0, 1), "entries of v cannot be assigned"),
    "method": (lambda self: self.v.sum(), "v is an expression and has no `sum`"),
    "sine of casadi": (lambda self: ca.sin(self.s), "`sin` is CasADi's; use acausal's: from acausal import sin"),
    "call": (
        lambda self: ca.Function("f", [Q], [Q])(self.s),
        r"a function of CasADi takes symbols.*Expr\(function",
    ),
    "stack": (lambda self: ca.vertcat(self.s, self.s), "`vertcat` is CasADi's"),
    "equality": (lambda self: piecewise((1, self.s == 2), 0), "is an equation, not a condition"),
    "lonely case": (lambda self: piecewise(self.s > 2, 0), "a case of piecewise is a pair"),
}
Q = ca.SX.sym("q")


@pytest.mark.parametrize("name", REFUSED)
def test_refused_with_the_line(name):
    law, text = REFUSED[name]
    with pytest.raises(DeclarationError, match=rf"^Law, {__file__}:\d+: .*{text}"):
        worth(law)


def test_names_and_units_of_entries():
    tree = ac.compile(Values()).tree
    assert [repr(e) for e in (tree.v[1], tree.m[1, 2], tree.m[0])] == ["v[1]", "m[1,2]", "m[0]"]
    assert [str(tree.f[k].unit) for k in range(3)] == ["m", "s", "kg"]
    assert [str(u) for u in tree.f[1:].unit] == ["s", "kg"]
    with pytest.raises(UnitsError):
        worth(lambda self: self.f[0] + abs(self.f[1]))


class InABody(Values):
    """The same with fields, whose values are not known yet."""

    n: int = structural("number", default=7)
    turned: Scalar = parameter("angle", default=np.sin(Values.s))
    size: Scalar = parameter("size", default=abs(Values.s))
    grown: Scalar = parameter("power", default=2**Values.s)
    half: int = structural("half", default=n // 2)
    odd: int = structural("odd", default=n % 2)
    scaled: Vector3 = parameter("scaled", default=np.array([1, 2, 3]) * Values.s)


def test_fields_in_a_class_body():
    result = ac.simulate(InABody(), stop_time=1, intervals=1)
    found = [result[name][-1] for name in ("turned", "size", "grown")]
    assert found == pytest.approx([math.sin(S), 2, 0.25])
    assert result["scaled"][-1] == pytest.approx([-2, -4, -6])
    assert (result.tree.half, result.tree.odd) == (3, 1)


@pytest.mark.parametrize(
    ("use", "text"),
    [
        (lambda: math.sin(Values.s), "a field has no value in the class body, so it cannot be a Python number"),
        (lambda: round(Values.s), "would jump without an event"),
        (lambda: np.array([Values.s, 0]), "numpy cannot make an array"),
        (lambda: np.maximum(Values.s, 0), "numpy's `maximum`"),
        (lambda: range(InABody.n), "cannot be a Python number"),
    ],
)
def test_refused_in_a_class_body(use, text):
    with pytest.raises(DeclarationError, match=text):
        use()


class Drag(Model):
    x: Scalar = variable("x", start=1, fixed=True)
    v: Scalar = variable("v", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -4 * self.x - abs(self.v) * self.v / 2 - 2 * self.v


def test_drag_that_comes_to_rest_makes_no_events():
    result = ac.simulate(Drag(), stop_time=300)
    assert result.stats["events"] == 0
    assert abs(result["x"][-1]) < 1e-6


def test_a_law_of_time_stops_at_its_kink():
    class Kinked(Model):
        at: Scalar = parameter("time of the kink", default=0.3)
        x: Scalar = variable("x", start=0, fixed=True)

        def equations(self):
            yield der(self.x) == abs(time - self.at)

    result = ac.simulate(Kinked(), stop_time=1)
    assert result.stats["break_times"] == pytest.approx([0.3])
    assert result["x"][-1] == pytest.approx((0.09 + 0.49) / 2, rel=1e-6)


def test_a_prescribed_motion_with_a_kink_is_refused_where_it_is():
    class Prescribed(Model):
        drive, rotor = rotational.Position(phi_ref=abs(time - 0.5)), rotational.Inertia(J=1)

        def connections(self):
            yield chain(self.drive, self.rotor)

    with pytest.raises(ac.SimulationError, match=r"0\.5 s"):
        ac.simulate(Prescribed(), stop_time=1)


@pytest.mark.parametrize(
    "use",
    [
        {"law": lambda self: self.s + Q},
        {"law": lambda self: Q * self.v},
        {"law": lambda self: piecewise((1, self.s > Q), 0)},
        {"law": lambda self: piecewise((1, self.s > Q), 0, smooth=True)},
        {"law": lambda self: der(Expr(Q) * time)},
        {"stored_energy": lambda self: self.s * Q},
        {"s": Expr(Q), "law": lambda self: self.s},
        {"requirements": lambda self: iter([ac.require(Expr(Q) > 0, "q")])},
        {"validity": lambda self: iter([ac.expect(Expr(Q), self.y, 0.1, "q")])},
    ],
)
def test_symbols_of_casadi(use):
    with pytest.raises(
        DeclarationError, match=r"(Law|stored_energy).*: `q` is not a variable or parameter of this model"
    ):
        ac.simulate(type("Law", (Values,), use)(), stop_time=1)


def test_symbols_of_another_model():
    other = ac.compile(Drag()).tree
    with pytest.raises(DeclarationError, match=r"test_symbols\.py:\d+: `x` is not a variable .* another built\s+model"):
        worth(lambda self: other.x)
    result = ac.simulate(Drag(), stop_time=1)
    with pytest.raises(DeclarationError, match="`x` is not a variable or parameter of this model"):
        result[other.x * 2]
