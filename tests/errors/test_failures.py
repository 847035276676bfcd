"""A simulation that fails keeps what it has computed; the command line tells it in its exit status."""

import csv

import numpy as np
import pytest
from typer.testing import CliRunner

import acausal as ac
from acausal import Model, Scalar, der, output, time, variable
from acausal.cli import app
from acausal.solve.diagnosis.not_finite import undefined_equations
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from models import SimplePendulum, SliderCrank

FILE = """
from acausal import Model, Scalar, der, fixed, output, variable

class Explosion(Model):
    stop_time = 2.0
    x: Scalar = output("x")
    y: Scalar = variable("y", start=1, fixed=True)

    def equations(self):
        yield der(self.y) == self.y * self.y
        yield self.x == self.y

class Unbalanced(Model):
    x: Scalar = output("x")
"""


class Explosion(Model):
    x: Scalar = output("x")
    y: Scalar = variable("y", start=1, fixed=True)

    def equations(self):
        yield der(self.y) == self.y * self.y
        yield self.x == self.y


class Aging(Model):
    y: Scalar = variable("y", start=1, fixed=True)

    def equations(self):
        yield der(self.y) == -time * self.y


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "own.py"
    path.write_text(FILE)
    return path


def test_what_was_computed_is_kept(capfd):
    with pytest.raises(ac.SimulationError, match=r"stopped at t = (0\.99\d+|1) s[\s\S]*`[xy]`") as caught:
        ac.simulate(Explosion(), stop_time=2)
    part = caught.value.result
    assert 0.98 < part.time[-1] < 1
    np.testing.assert_allclose(part["x"], 1 / (1 - part.time), rtol=1e-2)
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize(("scene", "stop_time"), [(SimplePendulum, 1e160), (SliderCrank, 1e200), (SliderCrank, 1e300)])
def test_a_stop_time_that_is_too_large(scene, stop_time):
    with pytest.raises((ac.SimulationError, ac.InitializationError)) as caught:
        ac.simulate(scene(), stop_time=stop_time)
    text = str(caught.value)
    assert f"stop_time={stop_time:g} is too large" in text
    assert "End the run earlier" in text
    assert "equations above" not in text


def test_an_explosion_in_a_long_run_is_not_put_down_to_its_stop_time():
    with pytest.raises(ac.SimulationError, match=r"stopped at t = (0\.99\d+|1) s[\s\S]*`[xy]`"):
        ac.simulate(Explosion(), stop_time=1e9)


def test_a_number_that_is_not_finite_by_itself_is_told():
    """Here the time itself; no operation is to blame."""
    compiled = ac.compile(Aging())
    problem = Problem(compiled, compiled.parameter_values(None))
    at = Point(np.nan, np.ones(1), np.empty(0), compiled.layout.begin(np.empty(0), 1.0))
    assert "holds a number that is not finite" in undefined_equations(problem, at)


def test_before_the_explosion_all_is_well():
    result = ac.simulate(Explosion(), stop_time=0.5)
    np.testing.assert_allclose(result["x"][-1], 2, rtol=1e-4)


def test_status_and_table_of_a_failure(file, tmp_path):
    table = tmp_path / "x.csv"
    done = CliRunner().invoke(app, ["simulate", f"{file}:Explosion", "--csv", str(table)])
    assert done.exit_code == 1
    assert "the simulation failed" in done.stderr
    assert "Traceback" not in done.output
    with table.open() as rows:
        last = [float(row["time"]) for row in csv.DictReader(rows)][-1]
    assert 0.98 < last < 1


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["spin-upp"], "did you mean `spin-up`?"),
        (["spin-up", "--set", "omgea=3"], "did you mean `omega`"),
        (["spin-up", "--set", "volumes=0"], "it must be a number of at least 1"),
        (["spin-up", "--set", "E=-1"], "it must be greater than 0"),
        (["spin-up", "--stop-time", "-1"], "it must come after start_time"),
        (["spin-up", "--tolerance", "2"], "it must lie between 1e-15 and 1"),
        (["spin-up", "--intervals", "0"], "it must be a whole number of at least 1"),
        (["spin-up", "--max-order", "9"], "it must be a whole number from 1 to 5"),
        (["spin-up", "--method", "rk4"], "it must be one of auto, idas, rosenbrock, resolve"),
        (["spin-up", "--initial", "guess"], "it must be one of fixed, guesses, steady"),
        (["spin-up", "--csv", "/nowhere/x.csv"], "there is no directory /nowhere"),
        (["OWN:Unbalanced"], "Nothing determines `x`"),
    ],
)
def test_wrong_input_ends_with_status_2(file, arguments, said):
    done = CliRunner().invoke(app, ["simulate", *(a.replace("OWN", str(file)) for a in arguments)])
    assert done.exit_code == 2, done.output
    assert said in done.stderr
    assert done.stderr.startswith("Error: ")
    assert "Traceback" not in done.output
