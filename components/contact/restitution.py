"""The dissipation of a contact that gives a coefficient of restitution."""

from __future__ import annotations

from typing import Any

from acausal import piecewise, tanh

# (1 - e) / (1 + e) below which a series is used: the last term of the series is then below rounding.
SMALL = 0.05


def impact_number(e: Any) -> Any:
    """Return z = chi v for which the force k x^n (1 + chi der(x)) returns a body at e v that arrives at v.

    With m v dv = -k x^n (1 + chi v) dx, the integral of v dv / (1 + chi v) from v to -e v is 0 (Hunt and Crossley 1975):

        z (1 + e) = log((1 + z) / (1 - e z)),

    whatever m, k and n are. With z = 2 A / (1 + e) this is coth(A) - 1 / A = (1 - e) / (1 + e), solved for A by Newton's
    method from Cohen's approximation, whose error is below 5 %.

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
    for _ in range(4):  # 5 % to the power 2^4 is below rounding
        coth = 1 / tanh(A)
        A = A - (coth - 1 / A - safe) / (1 / (A * A) + 1 - coth * coth)
    return 2 * piecewise((A, ratio > SMALL), series, smooth=True) / (1 + e)
