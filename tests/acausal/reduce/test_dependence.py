"""Dependence on algebraic unknowns in a chain of three blocks."""

from __future__ import annotations

import casadi as ca
import pytest

from acausal.reduce.dependence import Dependence, solution_levels

x = ca.SX.sym("x")
z = ca.SX.sym("z", 5)
# z1 from x; z0 and z2 together from z1; z4 from z2; z3 by itself.
ALG = ca.vertcat(z[0] + z[2] ** 2 - z[1], z[1] - x, z[4] - z[2], z[0] * z[2] - 1, z[3] - 2)


@pytest.mark.parametrize(
    ("wanted", "unknowns"), [([1], [1]), ([0], [0, 1, 2]), ([4], [0, 1, 2, 4]), ([3], [3]), ([], []), ([3, 1], [1, 3])]
)
def test_needed(wanted, unknowns):
    found, equations = Dependence(ALG, z).needed(wanted)
    assert found.tolist() == unknowns
    for unknown, equation in zip(found, equations, strict=True):
        assert ca.depends_on(ALG[int(equation)], z[int(unknown)])
    assert len(set(equations.tolist())) == len(unknowns)


def test_needing():
    dependence = Dependence(ALG, z)
    assert dependence.needing([1]) == {0, 1, 2, 4}
    assert dependence.needing([2]) == {4}
    assert dependence.needing([4]) == {3}


def test_inside():
    assert Dependence(ALG, z).inside(z[3] * x + ca.sin(z[1])) == {1, 3}


def test_levels_solve_each_unknown_once_after_what_it_needs():
    unknowns, equations = Dependence(ALG, z).needed(range(5))
    J = ca.jacobian(ALG[equations.tolist()], z[unknowns.tolist()])
    found = solution_levels(J, z[unknowns.tolist()])
    assert sorted(v for level in found for v in level.variables) == list(range(5))
    known: set[int] = set()
    for level in found:
        here = set(level.variables)
        for row in level.equations:
            inside = Dependence(ALG, z).inside(ALG[int(equations[row])])
            assert inside <= known | here
        known |= here
    assert [level.linear for level in found if {0, 2} & set(level.variables)] == [False]
