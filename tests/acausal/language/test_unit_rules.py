"""Units of sums, products and arrays: only certain contradictions are errors; literals fit any unit."""

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    UnitsError,
    Vector3,
    atan2,
    cos,
    cross,
    der,
    discrete,
    dot,
    exp,
    fixed,
    parameter,
    piecewise,
    quantity,
    reinit,
    sin,
    sqrt,
    time,
    variable,
    when,
)


class Quantities(Model):
    """Variables of many units; nothing of it is solved."""

    x: Scalar = variable("length", unit="m")
    y: Scalar = variable("length", unit="m")
    v: Scalar = variable("speed", unit="m/s")
    E: Scalar = variable("energy", unit="J")
    P: Scalar = variable("power", unit="W")
    F: Scalar = variable("force", unit="N")
    tau: Scalar = variable("torque", unit="N.m")
    phi: Scalar = variable("angle", unit="rad")
    w: Scalar = variable("angular velocity", unit="rad/s")
    q: Scalar = variable("declared without a unit")
    r: Vector3 = variable("position", unit="m")
    f: Vector3 = variable("force", unit="N")
    mixed: Vector3 = variable("length, length, angle", unit=("m", "m", "rad"))
    flag: Scalar = discrete("flag", unit="1")
    L: Scalar = parameter("length", unit="m", default=2.0)
    T: Scalar = parameter("duration", unit="s", default=3.0)
    plain: Scalar = parameter("declared without a unit", default=0.0)


CONTRADICTIONS = {
    "factor left out": lambda m: m.P == m.E,
    "pure number": lambda m: quantity(2, "1") * m.E == m.P,
    "minus": lambda m: m.v == -m.x,
    "sum": lambda m: m.q == m.x + m.v,
    "sum behind a number": lambda m: m.q == 3 * (m.x + m.v),
    "sum in a product": lambda m: m.q == (m.x - m.v) * m.F,
    "parameter": lambda m: m.x == m.v / m.L,
    "sum with a number between": lambda m: m.x + 1 + m.v == 0,
    "power": lambda m: m.x == m.y**2,
    "power of a fraction": lambda m: m.x == m.y**0.5,
    "root": lambda m: m.v == sqrt(m.x),
    "tuple": lambda m: m.r == (m.x, m.v, 0),
    "tuple of one unit": lambda m: m.r == (0, 0, m.F),
    "entries of an array": lambda m: m.mixed == (m.x, m.y, m.F),
    "entries of an array, one number": lambda m: m.mixed == (1.0, m.v, m.phi),
    "case": lambda m: m.x == piecewise((m.v, time < 1), 0),
    "cases": lambda m: m.q == piecewise((m.x, time < 1), m.v),
    "smooth cases": lambda m: m.q == piecewise((m.x, time < 1), m.v, smooth=True),
    "condition": lambda m: m.q == piecewise((1, m.x < m.v), 0),
    "scalar product": lambda m: dot(m.f, m.r) == m.P,
    "sum in a scalar product": lambda m: m.q == dot((m.x, m.v, 0), (m.x, m.v, 0)),
    "vector product": lambda m: m.f == cross(m.r, m.f),
    "derivative": lambda m: m.x == der(m.x),
    "derivative of a tuple": lambda m: m.r == der(ac.as_expr((m.x, 0, 0))),
    "angle of a point": lambda m: m.phi == atan2(m.x, m.v),
    "argument": lambda m: m.q == sin(m.x),
    "quantity": lambda m: quantity(100, "N/m") * m.v == m.F,
    "jump": lambda m: when(m.x < 0, reinit(m.v, -m.x)),
}

RIGHT = {
    **{f"factor {k}": lambda m, k=k: m.tau == -k * m.phi - 400 * m.w for k in (0, 1, -1, 2, 0.5, 0.05, np.float64(3))},
    **{f"divisor {k}": lambda m, k=k: m.x == m.v / k for k in (1, 2, 0.05)},
    **{f"over {k}": lambda m, k=k: m.x == k / m.T for k in (1, 7.5)},
    **{f"vector {k}": lambda m, k=k: m.f == np.array([0.0, 0.0, k]) * m.x for k in (1.0, 0.3)},
    "gains": lambda m: m.q == 2 * m.x + 1 * m.v,
    "cases with factors": lambda m: m.q == piecewise((2 * m.x, time < 1), (0, time < 2), 3 * m.v),
    "number": lambda m: m.x == 2,
    "number in a sum": lambda m: m.x + 1 == 2 * m.y - 3,
    "numbers": lambda m: m.r == (1, 2, 3),
    "numbers in a tuple": lambda m: m.r == (m.x, 2, 0),
    "amplitude": lambda m: m.tau == 10 * sin(m.phi) + 3,
    "amplitude of a ratio": lambda m: 100 * (m.x / m.L) ** 2 == m.F,
    "amplitude of a decay": lambda m: m.tau == 0.01 * (1 - exp(-time / 0.167)),
    "stiffness of an angle": lambda m: m.tau == -20 * m.phi,
    "time": lambda m: m.x == 0.1 * cos(10 * time),
    "unknown": lambda m: m.q * m.E == m.P,
    "unknown parameter": lambda m: m.plain * m.E == m.P,
    "half": lambda m: m.F * m.x / 2 == m.E,
    "rate": lambda m: m.P == 2 * m.E / m.T,
    "zero": lambda m: 0 * m.x == m.P,
    "zero case": lambda m: piecewise((0, m.x < 0), m.f[0]) == m.F,
    "quantity": lambda m: quantity(100, "N/m") * m.x == m.F,
    "entries": lambda m: m.mixed == (m.x, 2 * m.y, m.phi),
    "one of an array": lambda m: m.x == 2 * m.mixed[1],
    "matrix of numbers": lambda m: m.f == np.eye(3) @ m.r,
    "direction": lambda m: m.r == np.array([0, 0.6, 0.8]) * m.x,
    "root": lambda m: m.x == sqrt(2 * m.y**2 + m.x**2),
    "jump": lambda m: when(m.x < 0, reinit(m.v, -0.5 * m.v), reinit(m.flag, 1 - m.flag)),
}


def stated(statement):
    class Stated(Quantities):
        def equations(self):
            yield statement(self)

    return Stated()


@pytest.mark.parametrize("name", CONTRADICTIONS)
def test_contradiction_is_reported_with_its_line(name):
    with pytest.raises(UnitsError) as error:
        ac.compile(stated(CONTRADICTIONS[name]))
    assert "test_unit_rules.py:" in str(error.value)


@pytest.mark.parametrize("name", RIGHT)
def test_what_may_be_right_is_not_reported(name):
    with pytest.raises(ac.AcausalError) as error:  # far too few equations
        ac.compile(stated(RIGHT[name]))
    assert not isinstance(error.value, UnitsError), error.value


def test_message_names_both_sides():
    with pytest.raises(UnitsError, match=r"P is in \[W\], E in \[N.m\], joined by `==`"):
        ac.compile(stated(CONTRADICTIONS["factor left out"]))


class Fall(Model):
    h0: Scalar = parameter("height at the start", unit="m", default=5.0)
    v0: Scalar = parameter("speed at the start", unit="m/s", default=1.0)
    h: Scalar = variable("height", unit="m")
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)

    def equations(self):
        yield der(self.h) == self.v
        yield der(self.v) == -9.81


class Started(Model):
    h0: Scalar = parameter("height at the start", unit="m", default=5.0)
    T: Scalar = parameter("duration", unit="s", default=5.0)


@pytest.mark.parametrize("wrong", [True, False])
def test_start_values(wrong):
    class Given(Started):
        ball = Fall(h=fixed(Started.T if wrong else Started.h0))

    class Own(Fall):
        h: Scalar = variable("height", unit="m", start=(Fall.v0 if wrong else 2 * Fall.h0), fixed=True)

    class Counted(Fall):
        h: Scalar = variable("height", unit="m", start=1, fixed=True)
        top: Scalar = discrete("greatest height", unit="m", start=Fall.v0 if wrong else Fall.h0)

    for model in (Given, Own, Counted):
        if wrong:
            with pytest.raises(UnitsError, match="its start value"):
                ac.compile(model())
        else:
            ac.compile(model())


@pytest.mark.parametrize("wrong", [True, False])
def test_values_of_parameters(wrong):
    class Inner(Model):
        size: Vector3 = parameter("size", unit=("m", "m", "s"), default=(1, 1, 1))

    class Outer(Started):
        inner = Inner(size=(Started.h0, Started.T if wrong else Started.h0, Started.T))

    if wrong:
        with pytest.raises(UnitsError, match="it is given as"):
            ac.compile(Outer())
    else:
        ac.compile(Outer())


class Sliding(Model):
    x: Scalar = variable("x", unit="m", start=0, fixed=True)
    v: Scalar = parameter("speed", unit="m/s", default=1)
    m: Scalar = parameter("mass", unit="kg", default=2)

    def equations(self):
        yield der(self.x) == self.v


@pytest.mark.parametrize(
    ("name", "wrong", "right"),
    [
        ("stored_energy", lambda s: s.x, lambda s: s.m * s.v**2 / 2),
        ("stored_energy", lambda s: s.m * s.v, lambda s: s.v**2 / 2),  # that of a unit mass
        ("supplied_power", lambda s: s.m * s.v**2, lambda s: 9.81 * s.m * s.v),
        ("dissipated_power", lambda s: s.x + 1, lambda s: 0),
        ("seen", ac.observed(lambda s: s.x + s.x**2), ac.observed(lambda s: s.x + s.x**2 / s.x)),
        ("seen", ac.observed(lambda s: s.v - s.x), ac.observed(lambda s: s.absent)),  # told to those who read it
    ],
)
def test_energies_and_observed_quantities(name, wrong, right):
    class Inside(Model):
        part = type("Right", (Sliding,), {name: right})()
        twin = type("Wrong", (Sliding,), {name: wrong})()

    ac.compile(type("Right", (Sliding,), {name: right})())
    with pytest.raises(UnitsError, match=r"twin \(Wrong\), .*test_unit_rules\.py:\d+: units differ"):
        ac.compile(Inside())


def test_an_observed_quantity_that_switches_is_no_part_of_the_model():
    class Seen(Sliding):
        @ac.observed
        def seen(self):
            return piecewise((self.x, self.x > 0.5), 0) + der(self.x) * 0

    assert ac.simulate(Seen(), stop_time=1).stats["events"] == 0


@pytest.mark.parametrize("gains", [(400, 0.05), (100, 1), (0.001 * 5000, 2), (-1, 0.5), (3, 0)])
@pytest.mark.parametrize("written", ["sum", "scalar product", "matrix"])
def test_a_controller_compiles_whatever_the_values_of_its_gains(gains, written):
    laws = {
        "sum": lambda c: -gains[0] * c.phi - gains[1] * c.w,
        "scalar product": lambda c: -dot(gains, (c.phi, c.w)),
        "matrix": lambda c: (-np.array([gains]) @ ac.as_expr((c.phi, c.w)))[0],
    }

    class Controlled(Model):
        phi: Scalar = variable("angle", unit="rad", start=0.1, fixed=True)
        w: Scalar = variable("angular velocity", unit="rad/s", start=0, fixed=True)
        tau: Scalar = variable("torque", unit="N.m")
        J: Scalar = parameter("moment of inertia", unit="kg.m2", default=2)

        def equations(self):
            yield der(self.phi) == self.w
            yield self.J * der(self.w) == self.tau
            yield self.tau == laws[written](self)

    result = ac.simulate(Controlled(), stop_time=0.1)
    np.testing.assert_allclose(result["tau"], -gains[0] * result["phi"] - gains[1] * result["w"], atol=1e-12)
