"""Derivatives of expressions, of other derivatives, and of variables with declared derivatives."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.flatten.derivatives import Derivatives
from acausal.language.functions import time

a, b = ca.SX.sym("a"), ca.SX.sym("b")


def value(chain: Derivatives, expression: ca.SX, t: float) -> float:
    """With a = sin t, b = exp(2 t) and their derivatives."""
    wave = [np.sin(t), np.cos(t), -np.sin(t), -np.cos(t)]
    known = [[w, 2.0**k * np.exp(2 * t)] for k, w in enumerate(wave)][: len(chain.levels)]
    f = ca.Function("f", [*chain.levels, time.sx], [expression])
    return float(f(*known, t))


def test_of_an_expression_and_of_its_derivative() -> None:
    first, second = ca.SX.sym("first"), ca.SX.sym("second")
    chain = Derivatives(ca.vertcat(a, b), {})
    placeholders, derivatives = chain.resolve([(first, a**2 * b), (second, first + time.sx**3)])
    found = dict(zip(map(str, placeholders.elements()), derivatives.elements(), strict=True))
    t = 0.3
    s, c, e = np.sin(t), np.cos(t), np.exp(2 * t)
    np.testing.assert_allclose(value(chain, found["first"], t), (2 * s * c + 2 * s**2) * e, rtol=1e-14)
    expected = (2 * (c * c - s * s) + 8 * s * c + 4 * s * s) * e + 3 * t**2
    np.testing.assert_allclose(value(chain, found["second"], t), expected, rtol=1e-14)
    assert len(chain.levels) == 3, "as many levels as derivatives"


def test_a_declared_derivative_stands_for_the_symbol() -> None:
    chain = Derivatives(ca.vertcat(a, b), {0: b**2})
    assert str(chain.of(ca.vertcat(3 * a))) == str(ca.vertcat(3 * b**2))
