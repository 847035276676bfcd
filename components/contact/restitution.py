"""Dissipation of a contact from its coefficient of restitution."""

from __future__ import annotations

from typing import Any

from acausal import piecewise, tanh

# (1 - e) / (1 + e) below which a series replaces coth(A) - 1 / A: its first neglected term is below round-off.
SMALL = 0.05


def impact_number(e: Any) -> Any:
    """Return z = chi v for which the force k x^n (1 + chi der(x)) has the restitution e at the impact speed v.

    With m v dv = -k x^n (1 + chi v) dx, the integral of v dv / (1 + chi v) from v to -e v is 0 (Hunt and Crossley 1975):

        z (1 + e) = log((1 + z) / (1 - e z)),

    independent of m, k and n. With z = 2 A / (1 + e) this is coth(A) - 1 / A = (1 - e) / (1 + e), the inverse Langevin
    function, solved for A by Newton's method from Cohen's approximation, whose error is below 5 %.

    Parameters
    ----------
    e : Expr
        Coefficient of restitution, 0 < e <= 1.
    """
    ratio = (1 - e) / (1 + e)
    square = ratio * ratio
    series = ratio * (3 + square * (9 / 5 + square * (297 / 175 + square * (1539 / 875 + square * (126117 / 67375)))))
    safe = piecewise((ratio, ratio > SMALL), SMALL, smooth=True)
    A = safe * (3 - safe * safe) / (1 - safe * safe)
    for _ in range(4):  # quadratic convergence: 0.05^(2^4) is below round-off
        coth = 1 / tanh(A)
        A = A - (coth - 1 / A - safe) / (1 / (A * A) + 1 - coth * coth)
    return 2 * piecewise((A, ratio > SMALL), series, smooth=True) / (1 + e)
