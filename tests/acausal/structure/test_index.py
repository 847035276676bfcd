from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

from acausal.structure import StructuralSingularity, Subsystem, analyse
from acausal.structure.extension import Extension
from tests.acausal.structure.examples import Model, freedom, random_model

PENDULUM = ["x lam | ax", "y lam | ay", "x y"]
PENDULUM_CHAINS = {"x": "vx", "vx": "ax", "y": "vy", "vy": "ay"}


def test_double_integrator_needs_no_differentiation() -> None:
    model = Model(["u | a", "phi | u"], {"phi": "w", "w": "a"})
    plan = analyse(model.system)
    assert plan.differentiated == plan.created == ()
    assert model.names(plan, plan.states) == ["phi", "w"]


def test_pendulum_differentiates_its_length_twice() -> None:
    model = Model(PENDULUM, PENDULUM_CHAINS)
    plan = analyse(model.system)
    assert plan.differentiated == (2, 3)
    assert plan.created == ()
    assert set(model.names(plan, plan.system.rows[3])) == {"x", "y", "vx", "vy", "mu"}
    assert set(model.names(plan, plan.system.rows[4])) == {"x", "y", "vx", "vy", "ax", "ay"}


def test_pendulum_integrates_all_coordinates_and_projects_them() -> None:
    model = Model(PENDULUM, PENDULUM_CHAINS)
    plan = analyse(model.system)
    assert model.names(plan, plan.states) == ["X", "Y", "VX", "VY"]
    assert freedom(plan) == 2
    (length,) = plan.constrained.constraints
    assert (length.base, length.rows, length.top) == (2, (2, 3), 4)
    position, velocity = length.multipliers
    found = {model.name[p.coordinate]: p for p in plan.constrained.projections}
    assert {name: p.multipliers for name, p in found.items()} == {
        "x": (position,),
        "y": (position,),
        "vx": (velocity,),
        "vy": (velocity,),
    }
    x = found["x"]
    assert plan.system.rows[5:7] == ((x.coordinate, x.state, position), (x.state_rate, x.rate, x.coordinate, x.state))
    assert plan.system.derivative[x.state] == x.state_rate
    assert plan.system.derivative[x.coordinate] == -1


def test_pendulum_without_given_accelerations_creates_them() -> None:
    model = Model(
        ["x lam | vx'", "y lam | vy'", "vx | x'", "vy | y'", "x y"], {"x": "x'", "y": "y'", "vx": "vx'", "vy": "vy'"}
    )
    plan = analyse(model.system)
    assert sorted(plan.differentiated) == [2, 3, 4, 5]
    assert sorted(model.names(plan, plan.created)) == ["x'", "y'"]
    assert freedom(plan) == 2


def test_prescribed_motion_differentiates_twice_and_leaves_no_state() -> None:
    model = Model(["| phi", "tau | a"], {"phi": "w", "w": "a"})
    plan = analyse(model.system)
    assert plan.differentiated == (0, 2)
    assert plan.states == ()
    at = model.index
    assert [plan.system.explicit[e] for e in (2, 3)] == [{at["w"]}, {at["a"]}]
    assert [block.variables for block in plan.blocks] == [(at["phi"],), (at["w"],), (at["a"],), (at["tau"],)]


LOOP = [
    "rA rB",
    "qA | rA",
    "qB | rB",
    "qA | vA wA",
    "qB | vB wB",
    "qA wA | aA zA",
    "qB wB | aB zB",
    "lam | zA",
    "lam | zB",
]
LOOP_CHAINS = {"qA": "wA", "wA": "zA", "qB": "wB", "wB": "zB"}
LOOP_DECLARED = {"rA": "vA", "rB": "vB", "vA": "aA", "vB": "aB"}
LOOP_DEFINES = {1: "rA", 2: "rB", 3: "vA", 4: "vB"}


def test_loop_differentiates_the_cut_and_not_the_definitions() -> None:
    model = Model(LOOP, LOOP_CHAINS, LOOP_DECLARED, LOOP_DEFINES)
    plan = analyse(model.system)
    assert plan.differentiated == (0, 9)
    assert plan.created == ()
    assert set(model.names(plan, plan.system.rows[9])) == {"rA", "rB", "vA", "vB", "mu"}
    assert set(model.names(plan, plan.system.rows[10])) == {"rA", "rB", "vA", "vB", "aA", "aB"}
    assert model.names(plan, plan.states) == ["QA", "QB", "WA", "WB"]
    assert freedom(plan) == 2
    assert set(plan.system.defines[9:]) == {-1}


def test_closure_is_differentiated_beforehand_and_may_give_way_to_its_substitute() -> None:
    """Two closures on one coordinate: one too many, which numbers must tell."""
    chains = {"q": "w", "w": "z"}
    declared, defines = {"r": "v", "v": "a"}, {0: "r", 1: "v"}
    equations = ["q | r", "q | v w", "q w | a z", "f g | z", "r", "q r"]
    model = Model(equations, chains, declared, defines, closures={4: "f", 5: "g"})
    plan = analyse(model.system)
    assert [c.base for c in plan.constrained.constraints] == [4, 5]
    assert [len(c.rows) for c in plan.constrained.constraints] == [2, 2]
    assert model.names(plan, plan.states) == ["Q", "W"]
    for constraint, flow in zip(plan.constrained.constraints, "fg", strict=True):
        assert model.index[flow] in plan.system.rows[constraint.top]
        assert plan.system.explicit[constraint.top] == frozenset()
    assert {model.name[v] for v, _ in plan.constrained.following} == {"r", "v"}


def test_constant_coefficients_keep_dependent_coordinates_out_of_the_constraints() -> None:
    chains = {"p1": "w1", "w1": "a1", "p2": "w2", "w2": "a2"}
    plan = analyse(Model(["tau | a1", "tau | a2", "| p1 p2"], chains).system)
    assert plan.constrained.constraints == plan.constrained.projections == ()


@pytest.mark.parametrize(
    ("preference", "state"), [({}, "1"), ({"p2": 1}, "2"), ({"p1": -1, "w1": -1}, "2"), ({"w1": 1}, "1")]
)
def test_rigidly_coupled_inertias(preference: dict[str, int], state: str) -> None:
    chains = {"p1": "w1", "w1": "a1", "p2": "w2", "w2": "a2"}
    model = Model(["tau | a1", "tau | a2", "| p1 p2"], chains, preference=preference)
    plan = analyse(model.system)
    assert plan.differentiated == (2, 3)
    assert sorted(model.names(plan, plan.states)) == ["p" + state, "w" + state]


@pytest.mark.parametrize(
    ("order", "state"), [((-2, 2), 1), ((-2, -1), 1), ((-1, 0), 1), ((0, 1), 1), ((1, 2), 1), ((2, 1), 0), ((0, 0), 0)]
)
def test_the_less_preferred_becomes_algebraic(order: tuple[int, int], state: int) -> None:
    model = Model(["f | x'", "f | y'", "| x y"], {"x": "x'", "y": "y'"}, preference={"x": order[0], "y": order[1]})
    plan = analyse(model.system)
    assert model.names(plan, plan.states) == [["x", "y"][state]]


def test_created_derivatives_are_not_preferred_more_than_default() -> None:
    for given, created in ((2, 0), (0, 0), (-1, -1)):
        model = Model(["x u | x'", "z | x", "| z"], {"x": "x'"}, preference={"z": given})
        plan = analyse(model.system)
        assert model.names(plan, plan.created) == ["z"]
        assert plan.system.preference[-1] == created


def test_rate_that_is_also_in_a_coefficient_is_not_explicit() -> None:
    model = Model(["w y | x"], {"x": "w"})
    extension = Extension(model.system)
    extension.differentiate(0)
    new = extension.levels[0][-1]
    assert extension.explicit[new] == frozenset()
    assert model.index["w"] in extension.rows[new]


def test_definitions_only_cannot_be_reduced() -> None:
    model = Model(["x | r", "x | r"], {"x": "v"}, {"r": "v"}, {0: "r", 1: "r"})
    with pytest.raises(StructuralSingularity) as error:
        analyse(model.system)
    assert error.value.over == (Subsystem((0, 1), (model.index["r"],)),)


def test_bound_on_the_number_of_differentiations() -> None:
    n = 14
    chains = {f"x{k}": f"x{k + 1}" for k in range(n)}
    model = Model(["| x0", f"f | x{n}"], chains)
    with pytest.raises(StructuralSingularity) as error:
        analyse(model.system)
    assert error.value.over[0].equations == (0,)


def offsets(signature: np.ndarray) -> tuple[np.ndarray, int]:
    """Smallest dual offsets of the equations and degrees of freedom (Pryce 2001)."""
    cost = np.where(signature < 0, 10**6, -signature)
    rows, columns = linear_sum_assignment(cost)
    value = np.where(signature < 0, -(10**6), signature)
    c = np.zeros(len(signature), dtype=int)
    while True:
        d = (value + c[:, None]).max(axis=0)
        new = d[columns] - value[rows, columns]
        if (new == c).all():
            return c, int(d.sum() - c.sum())
        c = new


def times(plan_differentiated: tuple[int, ...], n: int) -> np.ndarray:
    origin = list(range(n))
    for e in plan_differentiated:
        origin.append(origin[e])
    return np.bincount(origin[n:], minlength=n)


@pytest.mark.parametrize("seed", range(150))
def test_agrees_with_the_signature_method(seed: int) -> None:
    signature, system = random_model(seed)
    c, degrees = offsets(signature)
    if c.max() > 10:
        pytest.skip("more differentiations than allowed")
    plan = analyse(system)
    assert (times(plan.differentiated, len(c)) == c).all()
    assert freedom(plan) == degrees
    derivative, states = plan.system.derivative, set(plan.states)
    assert all(derivative[s] >= 0 for s in states)
    assert not any(derivative[v] in states for v in range(plan.system.n_variables) if v not in states)
