"""Arrays keep their declared shape, also with one entry, in all operations of numpy."""

from __future__ import annotations

import pickle
from typing import Any

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import acausal as ac
from acausal import (
    Component,
    DeclarationError,
    Model,
    Vector3,
    der,
    discrete,
    fixed,
    input,
    observed,
    parameter,
    quantity,
    structural,
    variable,
    when,
)
from acausal.language.expression import Expr, as_expr

SIZES = st.integers(0, 3)
SHAPES = st.one_of(st.just(()), st.tuples(SIZES), st.tuples(SIZES, SIZES))


def symbols(shape: tuple[int, ...], seed: int) -> tuple[Expr, np.ndarray]:
    """An expression of a shape, and values for its entries."""
    values = np.random.default_rng(seed).uniform(0.2, 0.9, shape)
    return Expr(ca.SX.sym("x", *shape), None, "x", shape), values


def value(found: Expr, *given: tuple[Expr, np.ndarray]) -> np.ndarray:
    """What an expression is, its entries laid out by its shape."""
    columns = [v.reshape(-1, order="F") for _, v in given]
    call = ca.Function("f", [ca.vec(e.sx) for e, _ in given], [ca.densify(ca.vec(found.sx))])
    return np.array(call.call(columns)[0]).reshape(found.shape, order="F")


def agrees(found: Any, wanted: Any, *given: tuple[Expr, np.ndarray]) -> None:
    assert isinstance(found, Expr)
    assert found.shape == np.shape(wanted)
    assert found.sx.shape == (found.shape if len(found.shape) == 2 else (int(np.prod(found.shape)), 1))
    np.testing.assert_allclose(value(found, *given), wanted, rtol=1e-14)


@settings(max_examples=150, deadline=None)
@given(SHAPES)
def test_operations_on_one_array(shape):
    x, v = symbols(shape, 1)
    one = [(x, v)]
    for mine, its in (
        (-x, -v),
        (+x, v),
        (2 * x, 2 * v),
        (x * 2, 2 * v),
        (x / 4, v / 4),
        (x**2, v**2),
        (x**0.5, v**0.5),
    ):
        agrees(mine, its, *one)
    for function, twin in ((ac.sin, np.sin), (ac.sqrt, np.sqrt), (ac.exp, np.exp), (ac.atan2, None), (abs, np.abs)):
        agrees(function(x) if twin else function(x, x), twin(v) if twin else np.arctan2(v, v), *one)
    agrees(ac.sign(as_expr(v)), np.sign(v))
    agrees(as_expr(v), v)
    if v.size and v.ndim:
        agrees(as_expr([x[k] for k in range(shape[0])]), v, *one)
        agrees(sum(x[1:], x[0]), sum(v[1:], v[0]), *one)
    if v.ndim == 2:
        agrees(x.T, v.T, *one)
    if v.ndim:
        assert len(x) == len(v)
        for k in range(shape[0]):
            agrees(x[k], v[k], *one)
        agrees(x[0:], v[0:], *one)
        agrees(x[: shape[0] // 2], v[: shape[0] // 2], *one)


@settings(max_examples=200, deadline=None)
@given(SHAPES, SHAPES)
def test_operations_on_two_arrays(first, second):
    (a, v), (b, w) = symbols(first, 1), symbols(second, 2)
    two = ((a, v), (b, w))
    if first == second:
        agrees(a + b, v + w, *two)
        agrees(a - b, v - w, *two)
        assert (a == b).lhs.shape == first
    else:
        for wrong in (lambda: a + b, lambda: a - b, lambda: a == b):
            with pytest.raises(DeclarationError, match=r"do not fit|the sides of an equation"):
                wrong()
    if first == second or not first or not second:
        agrees(a * b, v * w, *two)
        agrees(a**b, v**w, *two)
        agrees(ac.atan2(a, b), np.arctan2(v, w), *two)
    else:
        for wrong in (lambda: a * b, lambda: a**b, lambda: ac.atan2(a, b)):
            with pytest.raises(DeclarationError, match="do not fit"):
                wrong()
    if first and second and first[-1] == second[0]:
        agrees(a @ b, v @ w, *two)
    else:
        with pytest.raises(DeclarationError, match="do not fit"):
            a @ b


@settings(max_examples=100, deadline=None)
@given(st.tuples(st.integers(1, 3), st.integers(1, 3)), st.data())
def test_entries_of_matrices(shape, data):
    x, v = symbols(shape, 1)
    i, j = (data.draw(st.integers(-n, n - 1)) for n in shape)
    for index in ((i, j), (i,), (slice(None), j), (i, slice(None)), (slice(i, None), slice(None, j % shape[1] + 1))):
        agrees(x[index], v[index], (x, v))


def test_how_they_are_written():
    x, _ = symbols((1,), 1)
    y, _ = symbols((1, 1), 1)
    z, _ = symbols((2, 1), 1)
    assert [repr(2 * e) for e in (x[0], x, y, z)] == ["(2.*x)", "[(2.*x)]", "[[(2.*x)]]", "[[(2.*x_0)], [(2.*x_1)]]"]
    with pytest.raises(DeclarationError, match="a scalar and a vector of 1"):
        x[0] + x


def test_an_expression_of_time_keeps_its_shape_in_a_pickle():
    law = as_expr([2 * ac.time])
    assert law.shape == pickle.loads(pickle.dumps(law)).shape == (1,)


class Modes(Component):
    """A mass on springs, in any number of equal directions."""

    n: int = structural("directions", default=1)
    K: Any = parameter("stiffness", unit="N/m", shape=lambda s: (s.n, s.n), default=lambda s: 4 * np.eye(s.n))
    B: Any = parameter("map", unit="1", shape=lambda s: (3, s.n), default=lambda s: np.eye(3)[:, : s.n])
    R: Any = parameter("sum", unit="1", shape=lambda s: (1, s.n), default=lambda s: np.ones((1, s.n)))
    f: Any = input("force", unit="N", shape=lambda s: (s.n,), start=1.0)
    q: Any = variable("displacement", unit="m", shape=lambda s: (s.n,), start=0.1, fixed=True)
    v: Any = variable("der(q)", unit="m/s", shape=lambda s: (s.n,), fixed=True)
    c: Any = variable("displacement as a column", unit="m", shape=lambda s: (s.n, 1))
    total: Any = variable("sum of q", unit="m", shape=(1,))
    u: Vector3 = variable("displacement in space", unit="m")
    hits: Any = discrete("extreme elongation", unit="m", shape=lambda s: (s.n,))

    def equations(self):
        mass = quantity(1, "kg")
        yield der(self.q) == self.v
        yield mass * der(self.v) == self.f - self.K @ self.q
        yield self.u == self.B @ self.q
        yield self.total == self.R @ self.q
        yield self.c == [(x,) for x in self.q]
        yield when(self.v[0] < 0, ac.reinit(self.hits, self.q))

    def stored_energy(self):
        return self.q @ self.K @ self.q / 2 + quantity(0.5, "kg") * self.v @ self.v - self.f @ self.q

    @observed
    def twice(self):
        return 2 * self.q


class Machine(Model):
    n: int = structural("directions", default=1)
    body = Modes(n=n, f=(1.0,))


class Two(Machine):
    body = Modes(n=2, f=(1.0, 1.0))


def exact(times: np.ndarray, force: float = 1.0, stiffness: float = 4.0, start: float = 0.1) -> np.ndarray:
    rest = force / stiffness
    return rest + (start - rest) * np.cos(np.sqrt(stiffness) * times)


def test_a_component_with_arrays_of_one_entry():
    compiled = ac.compile(Machine())
    result = ac.simulate(compiled, stop_time=2, tolerance=1e-9, energy=True)
    q = exact(result.time)[:, None]
    np.testing.assert_allclose(result["body.q"], q, atol=1e-7)
    np.testing.assert_allclose(result["body.q[0]"], q[:, 0], atol=1e-7)
    np.testing.assert_allclose(result["body.c"], q[:, :, None], atol=1e-7)
    np.testing.assert_allclose(result["body.c[0,0]"], q[:, 0], atol=1e-7)
    np.testing.assert_allclose(result["body.total"], q, atol=1e-7)
    np.testing.assert_allclose(result["body.twice"], 2 * q, atol=2e-7)
    np.testing.assert_allclose(result["body.u"], np.pad(q, ((0, 0), (0, 2))), atol=1e-7)
    np.testing.assert_allclose(result["body.hits"][-1], exact(np.array([np.pi / 2])), atol=1e-7)
    assert result["body.K"].shape == (401, 1, 1)
    assert list(result.to_dataframe("body.q", "body.c").columns) == ["time", "body.q[0]", "body.c[0,0]"]
    assert set(compiled.states) == {"body.q[0]", "body.v[0]"}
    two = ac.simulate(Two(), stop_time=2, tolerance=1e-9)
    np.testing.assert_allclose(two["body.q"], np.hstack([q, q]), atol=1e-7)


@pytest.mark.parametrize("name", ["body.K", "body.K[0,0]"])
def test_values_by_path(name):
    given = 9.0 if "[" in name else [[9.0]]
    for model in (Machine(), ac.compile(Machine())):
        if "[" in name and isinstance(model, Model):
            continue
        result = ac.simulate(model, stop_time=1, tolerance=1e-9, parameters={name: given})
        np.testing.assert_allclose(result["body.q"][:, 0], exact(result.time, stiffness=9.0), atol=1e-7)


@pytest.mark.parametrize("start", [0.3, (0.3,), [0.3], np.array([0.3])])
def test_start_values(start):
    class Started(Machine):
        body = Modes(q=fixed(start), f=(1.0,))

    result = ac.simulate(Started(), stop_time=1, tolerance=1e-9)
    np.testing.assert_allclose(result["body.q"][:, 0], exact(result.time, start=0.3), atol=1e-7)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"q": fixed((0.1, 0.2))}, r"start of `body.q` has shape \(2,\); it must have shape \(1,\)"),
        ({"q": fixed(((0.1,),))}, r"start of `body.q` has shape \(1, 1\); it must have shape \(1,\)"),
        ({"K": 4.0}, r"`K` of body .* has shape \(\); it must have shape \(1, 1\)"),
        ({"K": (4.0,)}, r"`K` of body .* has shape \(1,\); it must have shape \(1, 1\)"),
        ({"f": 1.0}, "the sides of an equation are a vector of 1 and a scalar"),
    ],
)
def test_values_of_another_shape(values, message):
    class Wrong(Machine):
        body = Modes(**values)

    with pytest.raises(DeclarationError, match=message):
        ac.compile(Wrong())


def test_units_of_one_row():
    class Mixed(Model):
        x: Any = variable("a length", unit=("m",), shape=(1,))
        t: Any = variable("a time", unit=("s",), shape=(1,))

        def equations(self):
            yield self.x == (1,)
            yield self.t == self.x

    with pytest.raises(ac.UnitsError, match=r"t is in \[s\], x in \[m\]"):
        ac.compile(Mixed())


def test_equal_components_with_arrays_of_one_entry():
    class Several(Model):
        @ac.parts
        def bodies(self):
            return [Modes(f=(1.0 + k,)) for k in range(6)]

    result = ac.simulate(Several(), stop_time=1, tolerance=1e-9)
    for k in range(6):
        np.testing.assert_allclose(result[f"bodies[{k}].q"][:, 0], exact(result.time, 1.0 + k), atol=1e-7)


def test_an_open_dae_knows_the_shapes(tmp_path):
    path = tmp_path / "machine.dae"
    ac.export_dae(Machine(), path)
    result = ac.simulate(ac.load_dae(path), stop_time=1, tolerance=1e-9)
    np.testing.assert_allclose(result["body.q"][:, 0], exact(result.time), atol=1e-7)
    assert result["body.c"].shape == (401, 1, 1)


def test_no_entry_at_all():
    class Rigid(Machine):
        body = Modes(n=0, f=())

        def equations(self):
            yield from ()

    class Empty(Component):
        q: Any = variable("none", unit="m", shape=(0,))
        u: Vector3 = variable("displacement", unit="m")

        def equations(self):
            yield der(self.q) == -self.q
            yield self.u == np.zeros((3, 0)) @ self.q

    class Whole(Model):
        part = Empty()

    result = ac.simulate(Whole(), stop_time=1)
    assert result["part.q"].shape == (401, 0)
    assert not result["part.u"].any()


def test_three_dimensions_are_refused():
    cube = np.ones((2, 2, 2))
    made = {
        r"the shape of `k` is \(2, 2, 2\); a vector has \(3,\), a matrix \(3, 3\)": parameter(
            "cube", shape=lambda s: cube.shape, default=cube
        ),
        r"the shape of `k` is 3; a vector has": parameter("length", shape=lambda s: 3, default=cube),
        r"`k` of M \(.*\) has shape \(2, 2, 2\); it must be one number": parameter("cube", default=cube),
        r"`k` of M \(.*\) has shape \(2, 2, 2\); it must have shape \(2, 2\)": parameter(
            "cube", shape=(2, 2), default=cube
        ),
        r"`k` is \(2, 2, 2\); a vector has": variable("cube", shape=lambda s: (2, 2, 2)),
    }
    for message, field in made.items():

        class M(Model):
            k = field

        with pytest.raises(DeclarationError, match=message):
            ac.compile(M())
