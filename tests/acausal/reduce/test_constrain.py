"""Equations of the projection for a point on a circle, with a plan written by hand."""

from __future__ import annotations

from types import SimpleNamespace

import casadi as ca
import numpy as np
import pytest

from acausal.language.functions import feedback
from acausal.reduce.constrain import constrain
from acausal.structure import analyse
from tests.acausal.structure.examples import Model

G = 9.81


class Pendulum:
    """ax = -lam x, ay = -lam y - g, x^2 + y^2 = 1; rows 3 and 4 are the derivatives of row 2."""

    def __init__(self, closed: bool = False) -> None:
        chains = {"x": "vx", "vx": "ax", "y": "vy", "vy": "ay"}
        closures = {2: "dual"} if closed else {}
        equations = ["x lam | ax", "y lam | ay", "x y", *(["| dual lam"] if closed else [])]
        model = Model(equations, chains, closures=closures)
        self.plan = analyse(model.system)
        names = model.names(self.plan, range(self.plan.system.n_variables))
        self.elements = [ca.SX.sym(f"{name}{k}") for k, name in enumerate(names)]
        self.at = dict(zip(names, self.elements, strict=True))
        (self.constraint,) = self.plan.constrained.constraints
        self.mu = [self.elements[m] for m in self.constraint.multipliers]
        s = SimpleNamespace(**self.at)
        self.residuals = [s.ax + s.lam * s.x, s.ay + s.lam * s.y + G, s.x**2 + s.y**2 - 1]
        self.residuals += [s.dual - s.lam] if closed else []
        self.residuals += [2 * (s.x * s.vx + s.y * s.vy), 2 * (s.vx**2 + s.vy**2 + s.x * s.ax + s.y * s.ay)]
        closures = [SimpleNamespace(row=2, dual=s.dual, loop=0)] if closed else []
        flat = SimpleNamespace(loops=SimpleNamespace(closures=closures, of_parts=[]))
        one = ca.SX(1)
        at = model.index
        self.explicit = {(0, at["ax"]): one, (1, at["ay"]): one}
        self.own = list(self.residuals)
        self.projections = constrain(flat, self.plan, self.elements, self.residuals, self.explicit)  # type: ignore[arg-type]

    def value(self, expression, choice, **values) -> np.ndarray:
        known = [*(self.at[name] for name in values), self.projections.choice]
        f = ca.Function("f", known, [expression], {"allow_free": True})
        return np.array(f(*values.values(), choice)).ravel()

    def projected(self, X: float, Y: float, choice) -> np.ndarray:
        """x, y and the multiplier that solve the constraint and the projections of x and y."""
        added = self.residuals[len(self.own) :: 2]
        equations = [self.residuals[self.constraint.rows[0]], *added[:2]]
        unknowns = ca.vertcat(self.at["x"], self.at["y"], self.mu[0])
        known = ca.vertcat(self.at["X"], self.at["Y"], self.projections.choice)
        f = ca.Function("f", [unknowns, known], [ca.vertcat(*equations)])
        solve = ca.rootfinder("solve", "newton", f, {"abstol": 1e-13})
        return np.array(solve([X, Y, 0.0], [X, Y, *choice])).ravel()


@pytest.fixture(scope="module")
def pendulum() -> Pendulum:
    return Pendulum()


def test_constraints_are_told_in_terms_of_what_is_integrated(pendulum):
    found = pendulum.value(pendulum.projections.constraints, np.zeros(5), X=3, Y=4, VX=5, VY=-1)
    np.testing.assert_allclose(found, [24, 22])


def test_projections_are_appended_with_their_constant_coefficients(pendulum):
    n = len(pendulum.own)
    assert len(pendulum.residuals) == n + 8
    assert len(pendulum.residuals) == pendulum.plan.system.n_equations
    for (row, unknown), coefficient in pendulum.explicit.items():
        slope = ca.jacobian(pendulum.residuals[row], pendulum.elements[unknown])
        assert ca.is_equal(ca.simplify(ca.substitute(slope, pendulum.projections.moves, 0)), coefficient, 3)
    assert {row for row, _ in pendulum.explicit} == {0, 1, *range(n, n + 8)}


@pytest.mark.parametrize("scale", [1.0, 7.0])
def test_a_projection_along_the_jacobian_goes_to_the_nearest_point(pendulum, scale):
    x, y, _ = pendulum.projected(1.2, -1.6, [1, scale, scale, scale, scale])
    np.testing.assert_allclose([x, y], [0.6, -0.8], atol=1e-10)


def test_a_projection_along_unit_vectors_makes_a_coordinate_follow(pendulum):
    projections = pendulum.plan.constrained.projections
    names = [next(n for n, e in pendulum.at.items() if e is pendulum.elements[p.coordinate]) for p in projections]
    for follows, expected in (("x", [0.8, 0.6]), ("y", [0.5, 0.75**0.5])):
        D = [float(name in (follows, "v" + follows)) for name in names]
        np.testing.assert_allclose(pendulum.projected(0.5, 0.6, [0, *D])[:2], expected, atol=1e-10)


def test_what_is_integrated_comes_back_to_what_is_projected(pendulum):
    """der(X) = der(x) + feedback (x - X)."""
    n = len(pendulum.own)
    p = pendulum.plan.constrained.projections[0]
    x, rate, state, state_rate = (pendulum.elements[v] for v in (p.coordinate, p.rate, p.state, p.state_rate))
    f = ca.Function("f", [x, rate, state, state_rate, feedback.sx], [pendulum.residuals[n + 1]])
    assert float(f(0.5, 3.0, 0.2, 3.0 + 0.3 * 7, 7)) == pytest.approx(0.0, abs=1e-15)
    assert float(f(0.5, 3.0, 0.2, 3.0, 7)) == pytest.approx(-0.3 * 7)


def test_a_closure_that_counts_stays_and_one_that_does_not_gives_way():
    pendulum = Pendulum(closed=True)
    on = [1.0, *np.zeros(5)]
    values = {"x": 2.0, "y": 3.0, "vx": 5.0, "vy": 7.0, "ax": 1.0, "ay": 1.0, "dual": 11.0}
    rows = [*pendulum.constraint.rows, pendulum.constraint.top]
    both = ca.vertcat(*[pendulum.residuals[row] for row in rows])
    symbols = [*(pendulum.at[name] for name in values), *pendulum.mu, pendulum.projections.choice]
    f = ca.Function("f", symbols, [both])
    np.testing.assert_allclose(np.array(f(*values.values(), 0.1, 0.2, on)).ravel(), [12, 62, 158])
    off = [0.0, *np.zeros(5)]
    np.testing.assert_allclose(np.array(f(*values.values(), 0.1, 0.2, off)).ravel(), [0.1, 0.2, 11])


def test_nothing_to_constrain_leaves_nothing_to_choose():
    model = Model(["u | a", "phi | u"], {"phi": "w", "w": "a"})
    plan = analyse(model.system)
    elements = [ca.SX.sym(name) for name in model.name]
    residuals = [elements[0], elements[1]]
    flat = SimpleNamespace(loops=SimpleNamespace(closures=[], of_parts=[]))
    projections = constrain(flat, plan, elements, residuals, {})  # type: ignore[arg-type]
    assert projections.choice.numel() == projections.constraints.numel() == projections.states.numel() == 0
    assert len(residuals) == 2
