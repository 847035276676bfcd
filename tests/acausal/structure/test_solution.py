from __future__ import annotations

import pytest

from acausal.structure import Block, Plan, StructuralSingularity, analyse
from acausal.structure.blt import block_triangular
from acausal.structure.tearing import tear, worthwhile
from tests.acausal.structure.examples import Model, freedom, random_model, rods


def test_blocks_in_order_of_solution() -> None:
    rows = [(0, 1), (1, 2, 3), (3, 4), (4,), (2, 3)]
    blocks = block_triangular(rows, [(0, 0), (1, 1), (3, 2), (4, 3), (2, 4)])
    assert blocks == (Block((3,), (4,)), Block((2,), (3,)), Block((4,), (2,)), Block((1,), (1,)), Block((0,), (0,)))


def test_coupled_equations_share_a_block_and_keep_their_matches() -> None:
    rows = [(0, 1), (1, 2), (2, 0), (2, 3)]
    assert block_triangular(rows, [(1, 0), (2, 1), (0, 2), (3, 3)]) == (Block((0, 1, 2), (1, 2, 0)), Block((3,), (3,)))


def test_independent_equations_keep_the_given_order() -> None:
    rows = [(3,), (1, 2), (1,), (0, 3)]
    blocks = block_triangular(rows, [(3, 0), (2, 1), (1, 2), (0, 3)])
    assert [block.equations[0] for block in blocks] == [0, 2, 1, 3]


def test_observed_are_what_no_state_derivative_needs() -> None:
    model = Model(["u | x'", "x | u", "x | energy", "energy | total", "x power", "u v | power"], {"x": "x'"}, names="x")
    plan = analyse(model.system)
    at = model.index
    assert plan.observed == ((at["energy"], 2), (at["total"], 3))
    assert plan.residuals == (4,)
    assert dict(plan.assigned).keys() == {at["x'"], at["u"], at["power"]}
    assert plan.algebraic == (at["v"],)


def test_what_an_implicit_equation_needs_is_not_observed() -> None:
    model = Model(["x | x'", "x | a", "a b"], {"x": "x'"}, names="x")
    plan = analyse(model.system)
    assert plan.observed == ()
    assert plan.algebraic == (model.index["b"],)
    assert plan.residuals == (2,)


def test_criterion_of_tearing() -> None:
    assert worthwhile(2, 5)
    assert not worthwhile(3, 5)


def chain(n: int) -> Model:
    """a_i = a_{i-1} + c q_i from the ground, f_i = a_i + f_{i+1} from the end, g(f_i, q_i) = 0."""
    equations = [f"| a{i} q{i} " + (f"a{i - 1}" if i else "") for i in range(n)]
    equations += [f"| f{i} a{i} " + (f"f{i + 1}" if i + 1 < n else "") for i in range(n)]
    return Model(equations + [f"f{i} q{i}" for i in range(n)])


def test_tearing_of_a_chain() -> None:
    model = chain(2)
    plan = analyse(model.system)
    assert model.names(plan, plan.algebraic) == ["q0", "q1"]
    assert plan.residuals == (4, 5)
    assert model.names(plan, [v for v, _ in plan.assigned]) == ["a0", "a1", "f1", "f0"]


def test_tearing_of_a_long_chain_does_not_fill() -> None:
    model = chain(40)
    plan = analyse(model.system)
    assert len(plan.algebraic) == 41
    assert entries_after(plan) <= sum(map(len, model.system.rows))
    evaluable(plan)


def test_ring_is_cut_where_the_evaluation_would_be_circular() -> None:
    plan = analyse(Model(["| a b", "| b c", "| c a"]).system)
    assert (len(plan.assigned), len(plan.algebraic)) == (2, 1)
    evaluable(plan)


@pytest.mark.parametrize(("users", "torn"), [(1, True), (2, False)])
def test_substitution_pays_up_to_half_of_what_it_removes(users: int, torn: bool) -> None:
    model = Model(["p q | y", *(f"y z{k}" for k in range(users))])
    blocks = [Block((k,), (v,)) for k, v in enumerate(range(2, 3 + users))]
    assert tear(model.system, blocks) == [(model.index["y"], 0)] * torn


def test_long_equation_is_substituted_where_nothing_uses_its_variable() -> None:
    n = 30
    model = Model([" ".join(f"x{k}" for k in range(n)) + " | s'", *(f"x{k} s" for k in range(n))], {"s": "s'"})
    assert analyse(model.system).assigned == ((model.index["s'"], 0),)


def evaluable(plan: Plan) -> None:
    known = {*plan.states, *plan.algebraic}
    for variable, equation in (*plan.assigned, *plan.observed):
        assert variable in plan.system.explicit[equation]
        assert set(plan.system.rows[equation]) - {variable} <= known
        known.add(variable)
    assert known == set(range(plan.system.n_variables))


def entries_after(plan: Plan) -> int:
    content: dict[int, set[int]] = {}

    def expand(equation: int, but: int = -1) -> set[int]:
        return set().union(*(content.get(v, {v}) for v in plan.system.rows[equation] if v != but))

    for variable, equation in plan.assigned:
        content[variable] = expand(equation, variable)
    return sum(len(expand(e)) for e in plan.residuals)


@pytest.mark.parametrize("seed", range(150))
def test_plans_of_random_systems(seed: int) -> None:
    try:
        plan = analyse(random_model(seed, n=5 + seed % 30, order=seed % 3)[1])
    except StructuralSingularity:
        pytest.skip("more differentiations than allowed")
    rows = plan.system.rows
    known = set(plan.states)
    for block in plan.blocks:
        assert all(v in rows[e] for e, v in zip(block.equations, block.variables, strict=True))
        known.update(block.variables)
        assert all(set(rows[e]) <= known for e in block.equations)
    equations = [e for block in plan.blocks for e in block.equations]
    assert sorted(equations) == list(range(len(rows)))
    assert len(plan.algebraic) == len(plan.residuals)
    solved = [e for _, e in (*plan.assigned, *plan.observed)]
    assert sorted((*plan.residuals, *solved)) == sorted(equations)
    evaluable(plan)
    needed = [e for e in equations if e not in {e for _, e in plan.observed}]
    assert entries_after(plan) <= sum(len(rows[e]) for e in needed)
    rates = {plan.system.derivative[s] for s in plan.states}
    assert not rates & {v for v, _ in plan.observed}


def test_analysis_is_deterministic() -> None:
    assert analyse(rods(30, closed=True).system) == analyse(rods(30, closed=True).system)


@pytest.mark.slow
@pytest.mark.parametrize("closed", [False, True])
def test_long_chain_of_rods(closed: bool) -> None:
    n = 1540
    plan = analyse(rods(n, closed).system)
    assert plan.system.n_equations >= 20_000
    assert len(plan.differentiated) == 4 * closed
    assert freedom(plan) == 2 * n - 4 * closed
    evaluable(plan)
