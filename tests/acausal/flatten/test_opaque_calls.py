"""Opaque CasADi calls raise errors; calls of elementary operations are expanded."""

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal import DeclarationError, Expr, Model, Scalar, der, output, piecewise, reinit, variable, when

GRID = np.linspace(0, 10, 11)
TABLES = [ca.interpolant("table", kind, [GRID], GRID**2) for kind in ("linear", "bspline")]


class Tabled(Model):
    x: Scalar = variable("ramp", start=1, fixed=True)
    y: Scalar = output("value")

    def equations(self):
        yield der(self.x) == 1
        yield from self.use(lambda x: Expr(FUNCTION[0](x.sx)))


FUNCTION: list = [None]
USES = {
    "equation": lambda m, f: [m.y == f(m.x)],
    "raw": lambda m, f: [m.y == 2 * FUNCTION[0](m.x.sx) + m.x],
    "derivative": lambda m, f: [m.y == der(f(m.x))],
    "case": lambda m, f: [m.y == piecewise((f(m.x), m.x > 2), 0)],
    "condition": lambda m, f: [m.y == piecewise((1, f(m.x) > 2), 0)],
    "jump": lambda m, f: [m.y == m.x, when(m.x > 2, reinit(m.x, f(m.x)))],
}


def using(use):
    class Used(Tabled):
        def use(self, f):
            yield from USES[use](self, f)

    return Used()


@pytest.mark.parametrize("table", TABLES)
@pytest.mark.parametrize("use", USES)
def test_interpolant_is_refused_with_its_line(use, table):
    FUNCTION[0] = table
    with pytest.raises(DeclarationError, match=r"test_opaque_calls\.py:\d+: an expression calls a CasADi .*Table"):
        ac.compile(using(use))


def test_energy_is_refused():
    class Stored(Tabled):
        def use(self, f):
            yield self.y == self.x

        def stored_energy(self):
            return Expr(TABLES[0](self.x.sx))

    with pytest.raises(DeclarationError, match=r"stored_energy\(\): an expression calls"):
        ac.compile(Stored())


def test_function_of_elementary_operations_is_written_out():
    b = ca.MX.sym("b")
    FUNCTION[0] = ca.Function("square", [b], [ca.if_else(b > 0, b**2, 0)])
    result = ac.simulate(using("equation"), stop_time=2.5)
    assert result["y"][-1] == pytest.approx(3.5**2, abs=1e-6)
