"""Functions of CasADi as continuous blocks."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, cos, der, sin, time, variable
from components.blocks import CasadiFunction

X, P = ca.MX.sym("x", 2), ca.MX.sym("p")
LAW = ca.Function("law", [X, P], [P * ca.sin(X[0]) * X[1], ca.mtimes(X, X.T)])


class Called(Model):
    law = CasadiFunction(f=LAW)
    rate: Scalar = variable("derivative of the first output")

    def equations(self):
        yield self.law.u[0] == sin(time)
        yield self.law.u[1] == 2 * cos(time)
        yield self.law.u[2] == 3
        yield self.rate == der(self.law.y[0])


def test_outputs_and_derivatives():
    result = ac.simulate(Called(), stop_time=2)
    t, y = result.time, result["law.y"]
    a, b = np.sin(t), 2 * np.cos(t)
    np.testing.assert_allclose(y, np.column_stack([3 * np.sin(a) * b, a * a, a * b, a * b, b * b]), atol=1e-12)
    exact = 3 * (np.cos(a) * np.cos(t) * b - 2 * np.sin(a) * np.sin(t))
    np.testing.assert_allclose(result["rate"], exact, atol=1e-12)


def test_operations_that_have_no_derivatives():
    curve = ca.interpolant("curve", "bspline", [[0, 1, 2, 3]], [0, 1, 4, 9])
    spline = ca.Function("spline", [X, P], [curve(X[0]) + P])
    with pytest.raises(ac.DeclarationError, match=r"law \(CasadiFunction.*Write a table with table\(x, Table"):
        ac.compile(type("Spline", (Called,), {"law": CasadiFunction(f=spline)})())


def test_other_functions():
    with pytest.raises(ac.DeclarationError, match="it must be a Function"):
        ac.compile(type("Other", (Called,), {"law": CasadiFunction(f=abs)})())
