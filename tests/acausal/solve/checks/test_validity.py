"""expect(): what a component neglects is told once a run, after it, and changes nothing of it."""

import pytest

import acausal as ac
from acausal import (
    AcausalWarning,
    DeclarationError,
    Model,
    Scalar,
    SimulationError,
    der,
    expect,
    parameter,
    sqrt,
    variable,
)


class Swing(Model):
    """Linear pendulum, which is right for small angles."""

    phi0: Scalar = parameter("angle at the start", unit="rad", default=0.5)
    phi: Scalar = variable("angle", unit="rad", start=phi0, fixed=True)
    w: Scalar = variable("der(phi)", unit="rad/s", start=0, fixed=True)

    def equations(self):
        yield self.w == der(self.phi)
        yield der(self.w) == -ac.quantity(9.81, "1/s2") * self.phi

    def validity(self):
        yield expect(self.phi**3 / 6, self.phi, 0.01, "the angle is too large for a linear pendulum")


def test_warns_once_with_time_and_size():
    with pytest.warns(AcausalWarning, match=r"the angle is too large .*up to 4.2 % of it, from t = 0 s on") as caught:
        result = ac.simulate(Swing(), stop_time=5.0)
    assert len(caught) == 1
    assert caught[0].filename == __file__
    assert result.stats["doubts"] == [str(caught[0].message)]


def test_quiet_below_and_for_parameters_of_a_compiled_model(recwarn):
    compiled = ac.compile(Swing())
    assert ac.simulate(compiled, stop_time=5.0, parameters={"phi0": 0.2}).stats["doubts"] == []
    assert not recwarn
    with pytest.warns(AcausalWarning):
        ac.simulate(compiled, stop_time=5.0)


def test_adds_nothing_to_the_system():
    class Plain(Swing):
        def validity(self):
            yield from ()

    reports = [ac.compile(model).report for model in (Swing(), Plain())]
    assert reports[0]["equations_flat"] == reports[1]["equations_flat"]
    assert reports[0]["equations_reduced"] == reports[1]["equations_reduced"]


def test_first_time_of_a_run_that_grows():
    class Grows(Swing):
        def equations(self):
            yield self.w == der(self.phi)
            yield der(self.w) == self.phi * ac.quantity(1.0, "1/s2")

    with pytest.warns(AcausalWarning, match=r"from t = 0.(7|8)\d* s on"):
        ac.simulate(Grows(phi0=0.18), stop_time=4.0)  # cosh(0.8) 0.18 = 0.24


def test_partial_result_of_a_failed_run_is_told():
    class Fails(Swing):
        x: Scalar = variable("falls to 0", unit="1", start=1.0, fixed=True)

        def equations(self):
            yield from super().equations()
            yield der(self.x) == -ac.quantity(1.0, "1/s") / sqrt(self.x)

    with pytest.warns(AcausalWarning, match="too large"), pytest.raises(SimulationError):
        ac.simulate(Fails(), stop_time=5.0)


def test_what_is_no_number_counts_as_nothing():
    class Rests(Swing):
        def validity(self):
            yield expect(self.phi * (self.w / self.w), self.phi, 0.01, "never")

    assert ac.simulate(Rests(phi0=0), stop_time=1.0).stats["doubts"] == []


def test_wrong_statements():
    class Vector(Swing):
        def validity(self):
            yield expect(ac.as_expr((self.phi, self.phi)), self.phi, 0.01, "")

    class Units(Swing):
        def validity(self):
            yield expect(self.w, self.phi, 0.01, "")

    class Equation(Swing):
        def validity(self):
            yield self.w == 0

    for model, kind, message in (
        (Vector, DeclarationError, "two scalars"),
        (Units, ac.UnitsError, "units differ"),
        (Equation, DeclarationError, r"write yield expect\("),
    ):
        with pytest.raises(kind, match=message):
            ac.simulate(model(), stop_time=1.0)
