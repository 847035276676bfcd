"""The incidence of residuals: which coefficients are known before the run."""

from __future__ import annotations

import casadi as ca

from acausal.reduce.incidence import jacobian

x, p, t = ca.SX.sym("x", 3), ca.SX.sym("p"), ca.SX.sym("t")


def test_coefficients_of_numbers_and_parameters_are_explicit() -> None:
    residuals = ca.vertcat(2 * x[0] - p * x[1], x[0] * x[1] + x[2], t * x[2] - x[0], ca.sin(p) * 3 - t)
    found = jacobian(residuals, x, t)
    assert [sorted(row) for row in found.rows] == [[0, 1], [0, 1, 2], [0, 2], []]
    assert {place: str(c) for place, c in found.explicit.items()} == {
        (0, 0): "2",
        (0, 1): "(-p)",
        (1, 2): "1",
        (2, 0): "-1",
    }


def test_what_cancels_is_no_entry() -> None:
    assert jacobian(ca.vertcat(x[0] + x[1] - x[0]), x, t).rows == ((1,),)
