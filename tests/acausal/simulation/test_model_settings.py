"""What a model tells of its own simulation is taken where nothing is given, from a class, an instance or a property."""

from __future__ import annotations

import numpy as np
import pytest
from typer.testing import CliRunner

import acausal as ac
from acausal import DeclarationError, Model, Scalar, der, output, parameter, piecewise, structural
from acausal.cli.app import app
from acausal.simulation.model_settings import DEFAULTS
from acausal.simulation.settings_checks import checked_task


class Decay(Model):
    stop_time, tolerance, intervals, max_order, method = 0.5, 1e-8, 10, 2, "idas"
    x: Scalar = output("x")

    def equations(self):
        yield der(self.x) == -self.x

    def initial_equations(self):
        yield self.x == 1


def told(model, **given):
    """Stop time, points, tolerance and order limit of a run."""
    result = ac.simulate(model, **given)
    return (result.time[-1], len(result.time), result.stats["tolerance"], result.stats["max_order"])


@pytest.mark.parametrize("of", [lambda m: m, ac.compile])
def test_settings_of_a_class(of):
    assert told(of(Decay())) == (0.5, 11, 1e-8, 2)
    assert told(of(Decay()), stop_time=1, tolerance=1e-4, intervals=3, max_order=5) == (1, 4, 1e-4, 5)
    assert told(of(Decay()), accuracy=1e-2)[2] != 1e-8


@pytest.mark.parametrize("of", [lambda m: m, ac.compile])
def test_settings_of_an_instance_and_a_property(of):
    class Chosen(Decay):
        points: int = structural("points", default=7)
        end: Scalar = parameter("end", unit="s", default=0.25)

        @property
        def intervals(self):
            return self.points - 1

        @property
        def stop_time(self):
            return 2 * self.end

    model = Chosen(points=5)
    model.tolerance = 1e-5
    assert told(of(model))[:3] == (0.5, 5, 1e-5)
    assert told(of(model), parameters={"end": 1})[0] == 2


def test_tolerance_and_accuracy():
    class Accurate(Decay):
        accuracy = 1e-3

    with pytest.raises(DeclarationError, match="accuracy and tolerance are both given"):
        ac.simulate(Accurate())
    assert ac.simulate(Accurate(), tolerance=1e-3).stats["tolerance"] == 1e-3
    Accurate.tolerance = None
    assert ac.simulate(Accurate()).stats["accuracy"] == 1e-3


class Guessed(Decay):
    initial, constraints = "guesses", "projection"

    def initial_equations(self):
        yield from ()


def test_initial():
    assert ac.simulate(Guessed()).stats["method"] == "idas"
    assert ac.linearize(Guessed()).A.item() == pytest.approx(-1)
    with pytest.raises(ac.InitializationError, match="1 start value is missing"):
        ac.simulate(Guessed(), initial="fixed")
    with pytest.raises(DeclarationError, match="initial is 'rest'; it must be one of"):
        ac.simulate(type("M", (Guessed,), {"initial": "rest"})())
    assert ac.study(Guessed(), tolerances=[1e-4], repeats=1, workers=1).rows[0].measurement.steps > 0


@pytest.mark.parametrize(
    ("name", "wrong", "text"),
    [
        ("tolerance", "fine", "tolerance is 'fine'; it must be a number"),
        ("intervals", 2.5, "intervals is 2.5; it must be a whole number"),
        ("method", "rk4", "method is 'rk4'"),
        ("constraints", "none", "constraints is 'none'"),
        ("max_order", 6, "max_order is 6"),
        ("stop_time", -1, "stop_time of M is -1"),
    ],
)
def test_wrong_settings_are_refused(name, wrong, text):
    with pytest.raises(DeclarationError, match=text):
        ac.simulate(type("M", (Decay,), {name: wrong})())


class Clearance(Decay):
    """Fields and constants of other meaning are no settings."""

    tolerance: Scalar = parameter("clearance", unit="m", default=0.02)
    intervals: int = structural("teeth", default=12)
    constraints: Scalar = output("reaction")
    initial = 0.3

    def equations(self):
        yield from super().equations()
        yield self.constraints == self.tolerance

    def accuracy(self):
        return 0.1


@pytest.mark.parametrize("of", [lambda m: m, ac.compile])
def test_other_meanings(of):
    assert told(of(Clearance()))[1:3] == (401, 1e-6)


def test_no_stop_time_at_all():
    class Endless(Decay):
        stop_time = None

    with pytest.raises(DeclarationError, match=r"declares no stop_time; give one: stop_time=2\.0"):
        ac.simulate(Endless())
    assert ac.simulate(Endless(), stop_time=1).time[-1] == 1


def test_command_line(tmp_path):
    (tmp_path / "decay.py").write_text(
        "from acausal import Model, Scalar, der, output\n\n"
        "class Decay(Model):\n"
        "    stop_time, tolerance, intervals, initial = 0.5, 1e-8, 10, 'guesses'\n"
        "    x: Scalar = output('x')\n\n"
        "    def equations(self):\n"
        "        yield der(self.x) == -self.x\n"
    )
    table = tmp_path / "out.csv"
    command = ["simulate", f"{tmp_path / 'decay.py'}:Decay", "--csv", str(table), "--quiet"]

    def rows(*options):
        assert CliRunner().invoke(app, [*command, *options]).exit_code == 0
        return len(table.read_text().splitlines()) - 1

    assert (rows(), rows("--intervals", "4")) == (11, 5)
    assert CliRunner().invoke(app, [*command, "--initial", "fixed"]).exit_code == 2
    assert CliRunner().invoke(app, ["linearize", command[1]]).exit_code == 0


class Fields(Model):
    end: Scalar = parameter("end", unit="s", default=0.5)
    points: Scalar = parameter("points", default=8)
    loose: Scalar = parameter("tolerance", default=1e-5)
    way: str = structural("method", default="idas")
    x: Scalar = output("x")
    later: Scalar = output("x, later")

    def equations(self):
        yield der(self.x) == -self.x
        yield self.later == self.x

    def initial_equations(self):
        yield self.x == 1


class Same(Fields):
    stop_time, tolerance, intervals, method = Fields.end, Fields.loose, Fields.points, Fields.way


class Computed(Fields):
    stop_time, tolerance, intervals = 2 * Fields.end, Fields.loose / 10, Fields.points + 2


class Own(Fields):
    late: Scalar = parameter("end", unit="s", default=0.5)
    stop_time, tolerance = late, late * 1e-4
    intervals = piecewise((4, late > 0.6), 6)


@pytest.mark.parametrize(
    ("model", "name", "before", "after"),
    [
        (Same, "end", (0.5, 9, 1e-5), (0.7, 9, 1e-5)),
        (Computed, "end", (1.0, 11, 1e-6), (1.4, 11, 1e-6)),
        (Own, "late", (0.5, 7, 5e-5), (0.7, 5, 7e-5)),
    ],
)
def test_settings_that_follow_from_fields(model, name, before, after):
    new = {name: 0.7}
    assert told(model())[:3] == pytest.approx(before)
    runs = [told(model(), parameters=new), told(ac.compile(model(), new)), told(model(**new))]
    for run in [*runs, told(ac.compile(model()), parameters=new)]:
        assert run[:3] == pytest.approx(after)


def test_fields_under_a_second_name_follow_the_first_and_can_be_set():
    assert told(Same(), parameters={"stop_time": 0.9, "points": 3, "loose": 1e-3})[:3] == (0.9, 4, 1e-3)
    assert told(Same(end=0.7, stop_time=0.6))[0] == 0.6
    assert ac.simulate(Same(), parameters={"way": "rosenbrock"}).stats["method"] == "rosenbrock"

    class Twice(Fields):
        gain: Scalar = parameter("gain", default=2.0)
        again = gain

        def equations(self):
            yield der(self.x) == -self.x
            yield self.later == self.again

    def last(**values):
        return ac.simulate(Twice(), stop_time=0.1, parameters=values)["later"][-1]

    assert (last(), last(gain=3), last(again=4), last(gain=3, again=4)) == (2, 3, 4, 4)


@pytest.mark.parametrize(
    ("name", "value", "text"),
    [
        ("stop_time", 2 * Fields.x, "stop_time depends on the variable `x`. Compute it from parameters"),
        ("tolerance", Fields.x, "tolerance depends on the variable `x`"),
        ("stop_time", 2 * ac.time, "stop_time of Wrong depends on time"),
        ("stop_time", Fields.end - 1, r"stop_time of Wrong is -0\.5; it must be a number of seconds"),
        ("stop_time", Fields.end > 2, "stop_time of Wrong is a condition; it must be"),
        ("stop_time", property(lambda s: 2 * s.x), "stop_time depends on the variable `x`"),
        ("stop_time", property(lambda s: 2 * s.endd), "has no `endd`; did you mean `end`"),
        ("intervals", Fields.end * 3, r"intervals is 1\.5; it must be a whole number"),
    ],
)
def test_what_a_setting_cannot_follow_from(name, value, text):
    with pytest.raises(DeclarationError, match=text) as caught:
        ac.simulate(type("Wrong", (Fields,), {"stop_time": 1, name: value})())
    assert "object at" not in str(caught.value)


def test_command_line_with_parameters(tmp_path):
    (tmp_path / "decay.py").write_text(
        "from acausal import Model, Scalar, der, output, parameter, variable\n\n"
        "class Decay(Model):\n"
        "    tt: Scalar = parameter('end', unit='s', default=0.5)\n"
        "    stop_time = tt\n"
        "    x: Scalar = variable('x', start=1, fixed=True)\n"
        "    y: Scalar = output('y')\n\n"
        "    def equations(self):\n"
        "        yield der(self.x) == -self.x\n"
        "        yield self.y == self.x\n\n"
        "class Twice(Decay):\n"
        "    stop_time = 2 * Decay.tt\n"
    )
    table = tmp_path / "out.csv"

    def last(name, *settings):
        options = [word for text in settings for word in ("--set", text)]
        command = ["simulate", f"{tmp_path / 'decay.py'}:{name}", "--csv", str(table), "--quiet", *options]
        assert CliRunner().invoke(app, command).exit_code == 0
        return float(table.read_text().splitlines()[-1].split(",")[0])

    assert (last("Decay"), last("Decay", "tt=0.7"), last("Decay", "stop_time=0.9")) == (0.5, 0.7, 0.9)
    assert (last("Twice"), last("Twice", "tt=0.7")) == (1.0, 1.4)


def test_numbers_of_numpy_are_settings():
    given = {"stop_time": np.float64(0.5), "tolerance": np.float64(1e-4), "intervals": np.int64(4)}
    task = checked_task(ac.compile(Decay()), None, dict.fromkeys(DEFAULTS) | given)[0]
    assert [type(number) for number in (task.start_time, task.stop_time, task.tolerance)] == [float] * 3
    assert told(Decay(), **given)[:3] == (0.5, 5, 1e-4)
