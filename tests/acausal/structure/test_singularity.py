from __future__ import annotations

import pytest

from acausal.structure import StructuralSingularity, Subsystem, analyse, components, decompose
from acausal.structure.incidence import transpose
from acausal.structure.matching import augment, maximum_matching
from tests.acausal.structure.examples import Model, random_model


def test_augmenting_path_shifts_the_matching_or_reports_what_it_saw() -> None:
    rows = [[0, 1], [1, 2], [0, 1, 2]]
    right_of, left_of = [0, 1, -1], [0, 1, -1]
    search = augment(2, rows, right_of, left_of)
    assert search.found
    assert sorted(right_of) == [0, 1, 2]
    assert all(left_of[right] == left for left, right in enumerate(right_of))
    stuck = augment(1, [[0], [0]], [0, -1], [0])
    assert (stuck.found, stuck.left, stuck.right) == (False, [1, 0], [0])


def test_closed_vertices_are_not_entered() -> None:
    assert augment(0, [[0]], [-1], [-1], exhausted={0}).right == []


def test_coarse_decomposition() -> None:
    rows = [[0], [0], [1, 2], [2, 1], [3, 4, 1]]
    parts = decompose(rows, 5)
    assert parts.over == Subsystem((0, 1), (0,))
    assert parts.well == Subsystem((2, 3), (1, 2))
    assert parts.under == Subsystem((4,), (3, 4))


def test_components_smallest_first() -> None:
    rows = [[0, 1], [0, 1], [0, 1], [2], [2]]
    assert components(rows, decompose(rows, 3).over) == (Subsystem((3, 4), (2,)), Subsystem((0, 1, 2), (0, 1)))


def test_too_many_equations_smallest_part_first() -> None:
    model = Model(["x y", "x y", "x y", "z", "z", "u"])
    with pytest.raises(StructuralSingularity) as error:
        analyse(model.system)
    at = model.index
    assert error.value.over == (Subsystem((3, 4), (at["z"],)), Subsystem((0, 1, 2), (at["x"], at["y"])))
    assert error.value.under == ()


def test_too_few_equations_reports_the_lowest_of_a_chain() -> None:
    model = Model(["x w a f", "b"], {"x": "w", "w": "a"}, names="lonely")
    with pytest.raises(StructuralSingularity) as error:
        analyse(model.system)
    at = model.index
    assert error.value.over == ()
    assert error.value.under == (Subsystem((), (at["lonely"],)), Subsystem((0,), (at["x"], at["f"])))


def test_singular_although_counts_match() -> None:
    model = Model(["x", "x", "y z"])
    with pytest.raises(StructuralSingularity) as error:
        analyse(model.system)
    assert error.value.over == (Subsystem((0, 1), (0,)),)
    assert error.value.under == (Subsystem((2,), (1, 2)),)


def test_two_equations_for_one_chain_are_too_many() -> None:
    with pytest.raises(StructuralSingularity) as error:
        analyse(Model(["x", "v", "f"], {"x": "v"}).system)
    assert error.value.over == (Subsystem((0, 1), (0,)),)


def test_equation_without_variables() -> None:
    with pytest.raises(StructuralSingularity) as error:
        analyse(Model(["", "x"]).system)
    assert error.value.over == (Subsystem((0,), ()),)


@pytest.mark.parametrize("seed", range(20))
def test_decomposition_of_random_systems(seed: int) -> None:
    rows = random_model(seed)[1].rows[: 8 + seed % 5]
    rows, n = (*rows, rows[0], rows[0]), random_model(seed)[1].n_variables
    parts = decompose(rows, n)
    matching = maximum_matching(rows, n)
    assert len(parts.well.equations) == len(parts.well.variables)
    deficit = len(parts.over.equations) - len(parts.over.variables)
    assert deficit == matching.variable_of.count(-1)
    assert all(set(rows[e]) <= set(parts.over.variables) for e in parts.over.equations)
    columns = transpose(rows, n)
    assert all(set(columns[v]) <= set(parts.under.equations) for v in parts.under.variables)
    for part in (parts.over, parts.well, parts.under):
        assert sorted(e for p in components(rows, part) for e in p.equations) == list(part.equations)
        assert sorted(v for p in components(rows, part) for v in p.variables) == list(part.variables)
