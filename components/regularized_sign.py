"""Regularised sign of a speed."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import cos, piecewise, sin, tanh

KINDS = ("exp", "sine", "linear", "cosine")


def regularized_sign(v: Any, v0: Any, reg: str) -> Any:
    """Return the sign of v, regularised for |v| < v0, or for "exp" within about 0.1 v0.

    Parameters
    ----------
    v, v0 : Expr
        Speed, and speed beyond which the sign is 1 or -1, in the same unit.
    reg : {"exp", "sine", "linear", "cosine"}
        "exp": 2 / (1 + exp(-v / (0.01 v0))) - 1; within v0 "sine": sin(pi/2 v / v0), "linear": v / v0,
        "cosine": sign(v) (1 - cos(pi/2 v / v0)).
    """
    if reg == "exp":
        return tanh(v / (0.02 * v0))
    ratio = v / v0
    turn = np.pi / 2 * ratio
    if reg == "cosine":
        return piecewise((1, ratio > 1), (-1, ratio < -1), (1 - cos(turn), ratio > 0), cos(turn) - 1)
    return piecewise((1, ratio > 1), (-1, ratio < -1), sin(turn) if reg == "sine" else ratio)
