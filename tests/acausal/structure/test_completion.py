"""Selection of initial conditions, and order of the integrated unknowns."""

from __future__ import annotations

from acausal.structure import System, analyse, complete
from acausal.structure.ordering import order_unknowns


def test_conditions_are_used_in_order_until_everything_is_determined() -> None:
    # one equation in two variables; the second condition holds the same variable as the first
    done = complete([[0, 1]], [[0], [0], [1]], 3)
    assert done.used == (0,)
    assert done.surplus == (1, 2)
    assert done.free == (2,)


def test_condition_that_the_equations_imply_is_surplus() -> None:
    assert complete([[0], [0, 1]], [[1]], 2).surplus == (0,)


def test_free_variables_are_named() -> None:
    assert complete([], [[1]], 3).free == (0, 2)


def arrow(n: int) -> System:
    """Equation k holds variable k and variable 0; the last equation holds all."""
    rows = (*((k, 0) for k in range(1, n)), tuple(range(n)))
    return System(rows, (frozenset(),) * n, (-1,) * n, {}, (-1,) * n, (0,) * n)


def test_full_row_and_column_come_last() -> None:
    system = arrow(12)
    unknowns, residuals = order_unknowns(system, range(12), range(12), [])
    assert sorted(unknowns) == sorted(residuals) == list(range(12))
    assert unknowns.index(0) >= 10
    for unknown, residual in zip(unknowns, residuals, strict=True):
        assert unknown in system.rows[residual]


def test_plan_pairs_unknowns_with_equations() -> None:
    plan = analyse(arrow(6))
    for unknown, residual in zip(plan.algebraic, plan.residuals, strict=True):
        assert unknown in plan.system.rows[residual]
