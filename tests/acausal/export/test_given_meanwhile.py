"""Values that are set between steps of Co-Simulation, and far from those of the file, against closed forms and `simulate`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("fmpy")

import acausal as ac
from acausal import (
    Model,
    Scalar,
    chain,
    der,
    discrete,
    fixed,
    guess,
    input,
    output,
    parameter,
    piecewise,
    reinit,
    time,
    variable,
    when,
)
from components import Body, FlexibleBeam, Revolute, World, rotational
from tests.acausal.export.hybrid import exported, opened, simulated
from tests.acausal.solve.integrate.test_branches import ENDS


class Switched(Model):
    """Laws that switch by the clock, by a state, by a parameter and by what is given."""

    limit: Scalar = parameter("limit of x", default=1.0)
    instant: Scalar = parameter("limit of time", default=1.0)
    size: Scalar = parameter("size", default=0.1)
    u: Scalar = input("what is given")
    x: Scalar = variable("time", fixed=True)
    by_state: Scalar = variable("for how long", fixed=True)
    by_clock: Scalar = variable("for how long", fixed=True)
    by_size: Scalar = variable("for how long", fixed=True)
    below: Scalar = variable("for how long", fixed=True)
    n: Scalar = discrete("how often u rose beyond 0.5")

    def equations(self):
        yield der(self.x) == 1
        yield der(self.by_state) == piecewise((1, self.x > self.limit), 0)
        yield der(self.by_clock) == piecewise((1, time > self.instant), 0)
        yield der(self.by_size) == piecewise((1, self.size > 0.5), 0)
        yield der(self.below) == piecewise((1, self.x < self.u), 0)
        yield when(self.u > 0.5, reinit(self.n, self.n + 1))


class Constant(Switched):
    """The same without an input, so that steps lead across communication points."""

    u: Scalar = parameter("what is given", default=-1.0)


def stepped(model: Model, version: int, times: list[float], changes: dict[float, dict[str, float]], path: Path):
    """Values at the last of some communication points, after changes at some of them."""
    with opened(exported(model, path / "a.fmu", version), "CoSimulation") as (fmu, description):
        fmu.enterInitializationMode(**({"startTime": 0.0} if version == 3 else {}))
        fmu.exitInitializationMode()
        references = {v.name: v.valueReference for v in description.modelVariables}
        get, put = (fmu.getReal, fmu.setReal) if version == 2 else (fmu.getFloat64, fmu.setFloat64)
        for begin, end in zip([0.0, *times[:-1]], times, strict=True):
            for name, value in changes.get(begin, {}).items():
                put([references[name]], [value])
            fmu.doStep(begin, end - begin)
        return {name: get([references[name]])[0] for name in ("by_state", "by_clock", "by_size", "below", "n")}


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("model", [Switched, Constant])
@pytest.mark.parametrize("step", [2.0, 0.5, 0.1])
def test_what_is_set_in_a_run_acts_at_once(step, model, version, tmp_path):
    def at(name: str, when: float, value: float) -> dict[str, float]:
        times = np.union1d(np.arange(1, 1 + round(2.3 / step)) * step, [when, 2.3]).tolist()
        return stepped(model(), version, [t for t in times if t <= 2.3], {when: {name: value}}, tmp_path)

    # Before the change from 1 s on, or not at all; events are located to a hundredth of the tolerance of 1e-6.
    assert at("limit", 1.5, 2.0)["by_state"] == pytest.approx(0.5 + 0.3, abs=1e-7)
    assert at("instant", 1.5, 2.0)["by_clock"] == pytest.approx(0.5 + 0.3, abs=1e-7)
    assert at("instant", 0.5, 0.2)["by_clock"] == pytest.approx(1.8, abs=1e-7)
    assert at("instant", 0.5, 1.7)["by_clock"] == pytest.approx(0.6, abs=1e-7)
    assert at("size", 1.5, 2.0)["by_size"] == pytest.approx(0.8, abs=1e-7)
    found = at("u", 1.0, 1.2)
    assert (found["below"], found["n"]) == (pytest.approx(0.2, abs=1e-7), 1)


class Sagging(Model):
    """In equilibrium, whatever the load is."""

    initial = "steady"
    load: Scalar = parameter("load", unit="kg", default=1.0)
    world = World()
    hinge = Revolute(use_axis_flange=True, phi=guess(0.2))
    spring = rotational.Spring(c=200)
    beam = FlexibleBeam(length=1, E=2.1e11, rho=7850, A=1e-4, J=1e-9, elements=2, beta=1e-3, geometric_stiffness=True)
    tip = Body(m=load)
    phi: Scalar = output("angle", unit="rad")
    deflection: Scalar = output("of the tip", unit="m")

    def connections(self):
        yield chain(self.world, self.hinge, self.beam, self.tip)
        yield chain(self.hinge.support, self.spring, self.hinge.axis)

    def equations(self):
        yield self.phi == self.hinge.phi
        yield self.deflection == self.beam.node_deflection[-1, 1]


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_an_exported_equilibrium_is_that_of_the_parameters(kind, tmp_path):
    path = exported(Sagging(), tmp_path / "a.fmu", 3)
    for load in (1.0, 3.0):
        rest = ac.simulate(Sagging(), stop_time=0.1, intervals=1, parameters={"load": load}, tolerance=1e-8)
        found = simulated(path, kind, 0.1, 10, relative_tolerance=1e-8, start_values={"load": load})
        for name in ("phi", "deflection"):
            np.testing.assert_allclose(found[name], rest[name][0], atol=1e-6)


class Fall(Model):
    height: Scalar = parameter("at the start", unit="m", default=1.0)
    h: Scalar = variable("height", unit="m")
    v: Scalar = variable("speed", unit="m/s", fixed=True)
    now: Scalar = output("height", unit="m")

    def equations(self):
        yield der(self.h) == self.v
        yield der(self.v) == -9.81
        yield self.now == self.h

    def initial_equations(self):
        yield self.h == self.height * (1 + time)


def test_a_start_may_be_far_from_that_of_the_file(tmp_path):
    path = exported(Fall(), tmp_path / "a.fmu", 3)
    for height in (-1e6, 0.0, 1e3, 1e6):
        found = simulated(path, "CoSimulation", 1.0, 10, start_values={"height": height})
        np.testing.assert_allclose(found["now"][[0, -1]], [height, height - 9.81 / 2], rtol=1e-12, atol=1e-9)
    found = simulated(path, "CoSimulation", 5001.0, 10, start_time=5000.0)
    assert found["now"][0] == pytest.approx(5001.0)


@pytest.mark.parametrize("intervals", [1, 10, 100])
@pytest.mark.parametrize("case", range(len(ENDS)))
def test_an_exported_model_ends_where_its_solution_does(case, intervals, tmp_path):
    model = ENDS[case][0]

    class Shown(type(model)):
        shown: Scalar = output("what follows")

        def equations(self):
            yield from super().equations()
            yield self.shown == self.z

    path = exported(
        Shown(x=fixed(-2.0 if case < 3 else 0.0), z=guess(-2.0 if case < 3 else 0.0)), tmp_path / "a.fmu", 3
    )
    with pytest.raises(Exception, match=r"DoStep failed"):
        simulated(path, "CoSimulation", 5.0, intervals)


class Settling(Model):
    """A mass that a spring and a damper hold."""

    x: Scalar = variable("position", start=5)
    v: Scalar = variable("speed")

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == 2 - self.x - self.v


def test_default_experiment_and_start_may_be_given(tmp_path):
    import fmpy

    path = tmp_path / "a.fmu"
    ac.export_fmu(Settling(), path, initial="steady", stop_time=3.0, tolerance=1e-8)
    told = fmpy.read_model_description(str(path)).defaultExperiment
    assert (float(told.stopTime), float(told.tolerance)) == (3.0, 1e-8)
    np.testing.assert_allclose(fmpy.simulate_fmu(str(path), output=["x"])["x"], 2.0, atol=1e-9)
    with pytest.raises(ac.DeclarationError, match=r"initial is 'still'; it must be one of fixed, guesses, steady"):
        ac.export_fmu(Settling(), path, initial="still")
    with pytest.raises(
        ac.DeclarationError, match=r"has no argument `method`; declare it in the class of the model, method = 'idas'"
    ):
        ac.export_fmu(Settling(), path, method="idas")  # pyright: ignore[reportCallIssue]
