"""Laws of one argument that a tape holds, against the expressions that they were made of."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from acausal.core import Tape, laws_of, make_tape
from acausal.instructions import READABLE

X, T, P = ca.SX.sym("x", 2), ca.SX.sym("t"), ca.SX.sym("p", 2)
SINE, PULSE = ca.sin(P[0] * T) + P[1], ca.exp(-((T - P[1]) ** 2))


def tape(column: ca.SX) -> Tape:
    return make_tape(ca.Function("f", [X, T, P], [ca.densify(column)], READABLE), early=(2,))


@pytest.mark.parametrize(
    ("column", "laws"),
    [
        (X[0] * SINE + X[1], [SINE]),
        (ca.vertcat(X[0] * SINE, X[1] + SINE * PULSE, ca.cos(X[0])), [SINE, SINE * PULSE]),
        (ca.vertcat(PULSE, X[0]), [PULSE]),
        (ca.sqrt(X[0] ** 2 + PULSE) * PULSE, [PULSE]),
    ],
)
def test_laws_are_what_meets_the_rest(column, laws) -> None:
    found = laws_of(tape(column), 1, (2,))
    assert found is not None
    p, times = np.array([3.0, 0.5]), np.linspace(0, 2, 30)
    values = found.rows(np.full(2, np.nan), times[:, None], p)
    exact = ca.Function("laws", [T, P], [ca.vertcat(*laws)]).map(30)(times[None], np.tile(p[:, None], 30)).full().T
    assert values.shape == exact.shape
    order, wanted = (np.argsort(a[7]) for a in (values, exact))
    np.testing.assert_array_equal(values[:, order], exact[:, wanted])


def test_without_laws() -> None:
    assert laws_of(tape(ca.vertcat(X[0] * T, X[1] + P[0])), 1, (2,)) is None
    assert laws_of(tape(X[0] * SINE), 1, ()) is None
    assert laws_of(tape(ca.sin(T + X[0])), 1, (2,)) is None
