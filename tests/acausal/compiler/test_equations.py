"""Equations in sympy, and the graph of parts."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
import sympy

import acausal as ac
import models
from acausal import Model, chain, connect, fixed, reinit, when
from acausal.compiler.equations.listing import typeset
from acausal.compiler.equations.sympy_expressions import LONG, to_sympy
from components import Body, FixedTranslation, Revolute, World
from components.blocks import Gain, Sine
from components.rotational import Torque

x, y, c = ca.SX.sym("x"), ca.SX.sym("y"), ca.SX.sym("c")
EXPRESSIONS = {
    "arithmetic": ca.vertcat(x + y, x - y, x * y, x / y, -x, x**2, x**1.5, x**y, 2 * x, 1 / x, ca.sqrt(x)),
    "functions": ca.vertcat(*(f(x / 3) for f in (ca.sin, ca.cos, ca.tan, ca.asin, ca.acos, ca.atan, ca.exp, ca.log))),
    "hyperbolic": ca.vertcat(*(f(x) for f in (ca.sinh, ca.cosh, ca.tanh, ca.asinh)), ca.acosh(1 + x), ca.atanh(x / 3)),
    "pieces": ca.vertcat(ca.fabs(-x), ca.sign(-y), ca.floor(x), ca.ceil(y), ca.fmin(x, y), ca.fmax(x, y)),
    "remainders": ca.vertcat(ca.fmod(x, y), ca.fmod(-x, y), ca.copysign(x, -y), ca.hypot(x, y), ca.atan2(x, -y)),
    "series": ca.vertcat(ca.erf(x), ca.log1p(x), ca.expm1(x)),
    "cases": ca.vertcat(ca.if_else(x < y, x, 2 * y), ca.if_else(ca.logic_and(x <= 1, y > 3), c, x), x == y, x != y),
    "logic": ca.vertcat(ca.logic_not(x < y), ca.logic_or(x < 0, y < 0), (x < y) * 3, ca.if_else(c, x, y)),
    "matrix": ca.horzcat(ca.vertcat(x, 1), ca.vertcat(0, x * y)),
}


@pytest.mark.parametrize("kind", EXPRESSIONS)
def test_expressions_have_the_values_of_casadi(kind):
    own = EXPRESSIONS[kind]
    (found,) = to_sympy([own])
    for values in ((0.7, 1.3, 1.0), (2.2, 0.4, 0.0), (1.0, 1.0, 1.0)):
        exact = np.array(ca.Function("f", [x, y, c], [own])(*values))
        read = found.subs(dict(zip((sympy.Symbol(n, real=True) for n in "xyc"), values, strict=True)))
        np.testing.assert_allclose(np.array(read, dtype=float), exact, atol=1e-12)


def test_long_shared_subexpressions_get_names():
    value = x
    for _ in range(40):  # written out: 2^40 operations
        value = ca.sin(value * value + c)
    shared: dict = {}
    (found,) = to_sympy([value], shared=shared)
    numbers = {sympy.Symbol("x", real=True): 0.7, sympy.Symbol("c", real=True): 0.3}
    for symbol, expression in shared.items():
        assert expression.count_ops() <= 3 * LONG
        numbers[symbol] = float(expression.subs(numbers))
    exact = ca.Function("f", [x, c], [value])(0.7, 0.3)
    assert float(found.subs(numbers)) == pytest.approx(float(exact), rel=1e-12)


def test_simple_pendulum_reads_like_its_textbook():
    """r der(w) = -g cos(phi), with phi from the horizontal."""
    compiled = ac.compile(models.SCENES["simple-pendulum"]())
    equations = {str(e.args[0]): e.args[1] for e in compiled.equations(reduced=True).sympy}
    names = ("der(hinge.w)", "hinge.phi", "bar.r[0]", "world.g")
    rate, phi, r, g = (sympy.Symbol(name, real=True) for name in names)
    (solution,) = sympy.solve(equations["0"], rate)
    assert sympy.simplify(solution + g * sympy.cos(phi) / r) == 0
    assert equations["der(hinge.phi)"] == sympy.Symbol("hinge.w", real=True)


def test_equations_of_a_part_are_as_its_class_states_them():
    compiled = ac.compile(models.SCENES["simple-pendulum"]())
    found = compiled.equations("hinge")
    text = repr(found)
    for line in ("    w = der(phi)", "    a = der(w)", "    frame_a.f[2] = -frame_b.f[2]", "    tau = -frame_b.t[2]"):
        assert line in text.splitlines()
    assert "components/revolute.py:" in text
    assert "der(0)" not in text
    assert sympy.Symbol("hinge.tau", real=True) in found[-3].equation.free_symbols | found.sympy[-4].free_symbols
    assert len(compiled.equations()) > len(found)


class Flywheel(Model):
    """A flywheel that a signal drives and an event stops."""

    world, shaft = World(), Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0))
    arm, wheel = FixedTranslation(r=(0.1, 0, 0)), Body(m=1.0, I=np.eye(3))
    motor, gain, signal = Torque(), Gain(k=2.0), Sine(f=1.0)

    def connections(self):
        yield chain(self.world, self.shaft, self.arm, self.wheel)
        yield connect(self.motor.flange, self.shaft.axis)
        yield connect(self.signal.y, self.gain.u)
        yield connect(self.gain.y, self.motor.tau)

    def equations(self):
        yield when(self.shaft.w > 5, reinit(self.shaft.w, 0.0))


def test_graph_has_parts_and_connections():
    compiled = ac.compile(Flywheel())
    graph = compiled.graph()
    assert graph.nodes["shaft"]["kind"] == "Revolute"
    ends = {frozenset(edge[:2]): edge[2] for edge in graph.edges(data=True)}
    assert ends[frozenset(("world", "shaft"))]["ports"] == ("world.frame_b", "shaft.frame_a")
    assert ends[frozenset(("signal", "gain"))]["kind"] == "signal"
    assert set(graph) == {"world", "shaft", "arm", "wheel", "motor", "gain", "signal"}
    chain_ = ac.compile(models.SCENES["spin-up"]()).graph("beam")
    assert "beam.volume[0]" in chain_
    assert chain_.nodes["beam.frame_a"]["kind"] == "port"
    assert chain_.number_of_edges() == len([n for n in chain_ if "volume" in n]) + 1


def test_pictures_of_a_compiled_model():
    compiled = ac.compile(Flywheel())
    assert repr(compiled).startswith("CompiledModel(Flywheel: 2 states")
    html = compiled._repr_html_()
    assert html.count("<rect") == 7
    assert html.count("<path") == compiled.graph().number_of_edges()
    assert "signal: signal.y - gain.u" in html


@pytest.mark.parametrize(
    ("name", "latex"),
    [
        ("hinge.phi", r"\phi_{\mathrm{hinge}}"),
        ("der(hinge.phi)", r"\dot{\phi}_{\mathrm{hinge}}"),
        ("der(der(s))", r"\ddot{s}"),
        ("beam.frame_b.r_0[2]", r"r_{\mathrm{0},\,\mathrm{beam.frame\_b},\,2}"),
        ("loss_power", r"\mathrm{loss}_{\mathrm{power}}"),
        ("der(a*b)", r"\mathrm{der(a*b)}"),
    ],
)
def test_names_are_typeset(name, latex):
    assert typeset(name) == latex


def test_unknown_parts_and_models_of_files(tmp_path):
    compiled = ac.compile(Flywheel())
    for read in (compiled.equations, compiled.graph):
        with pytest.raises(ac.DeclarationError, match="no part `shft` in the model; did you mean `shaft`"):
            read("shft")
    ac.export_dae(compiled, tmp_path / "wheel.dae")
    loaded = ac.load_dae(tmp_path / "wheel.dae")
    assert loaded.equations(reduced=True).sympy == compiled.equations(reduced=True).sympy
    with pytest.raises(ac.DeclarationError, match="its reduced equations only"):
        loaded.equations()
    assert "<pre>" in loaded._repr_html_()


def test_latex_aligns_both_sides():
    text = ac.compile(models.SCENES["simple-pendulum"]()).equations("hinge").latex()
    assert text.startswith("\\begin{aligned}\nw &= \\dot{\\phi} \\\\\n")
    assert text.count("&=") == text.count("\\\\\n") + 1
