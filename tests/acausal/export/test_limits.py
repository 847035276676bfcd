"""What exported models refuse: parameters and start values that `simulate` refuses, in its words."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("fmpy")

import acausal as ac
from acausal import Model, Scalar, chain, der, fixed, output, parameter, require, variable
from components import BodyCylinder, Revolute, World
from tests.acausal.export.hybrid import exported, opened, simulated


class Pipe(Model):
    """A flow through a pipe with walls, which has to be a fast one."""

    stop_time = 1.0
    inner: Scalar = parameter("inner diameter", unit="m", default=1.0, positive=True)
    outer: Scalar = parameter("outer diameter", unit="m", default=2.0)
    drag: Scalar = parameter("drag over mass", unit="1/s", default=1.0)
    least: Scalar = parameter("least speed", unit="m/s", default=2.0)
    v: Scalar = variable("speed", unit="m/s", start=3.0, fixed=True)
    flow: Scalar = output("flow", unit="m3/s")

    def equations(self):
        yield der(self.v) == -self.drag * self.v
        yield self.flow == self.v * self.inner**2

    def requirements(self):
        yield require(self.inner < self.outer, "`inner` is too large")
        yield require(self.v >= self.least, "`v` is too slow")
        yield require(self.outer, lambda outer: "is too great" if outer > 100 else "")


WRONG = {
    "`inner` is too large": {"inner": 2.0},
    "`inner` is -1; it must be greater than 0": {"inner": -1.0},
    "`v` is too slow": {"least": 3.5},
}


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("words", WRONG)
def test_what_simulate_refuses_is_refused(
    words: str, version: int, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    compiled = ac.compile(Pipe())
    path = exported(compiled, tmp_path / "a.fmu", version)
    with pytest.raises(Exception, match=words.partition(" is ")[2].partition(";")[0]):
        ac.simulate(compiled, parameters=WRONG[words])
    for kind in ("CoSimulation", "ModelExchange"):
        with pytest.raises(Exception, match=r"[Ee]rror"):
            simulated(path, kind, 0.1, start_values=WRONG[words])
        assert words in capfd.readouterr().out
    # The bounds themselves.
    simulated(path, "CoSimulation", 0.1, start_values={"inner": 1.999, "least": 3.0})


def test_a_start_value_that_breaks_a_requirement(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = exported(ac.compile(Pipe()), tmp_path / "a.fmu", 3)
    with pytest.raises(Exception, match=r"[Ee]rror"):
        simulated(path, "CoSimulation", 0.1, start_values={"v": 1.0})
    assert "`v` is too slow" in capfd.readouterr().out
    # It is one of the start alone: later on the flow may be slow.
    assert simulated(path, "CoSimulation", 1.0)["flow"][-1] < 2.0


def test_a_parameter_that_is_refused_in_a_run_stays(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = exported(ac.compile(Pipe()), tmp_path / "a.fmu", 3)
    with opened(path, "CoSimulation") as (fmu, description):
        (inner,) = [v.valueReference for v in description.modelVariables if v.name == "inner"]
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        with pytest.raises(Exception, match="fmi3SetFloat64"):
            fmu.setFloat64([inner], [2.5])
        assert "`inner` is too large" in capfd.readouterr().out
        assert fmu.getFloat64([inner]) == [1.0]
        fmu.setFloat64([inner], [1.5])
        fmu.doStep(0.0, 0.1)
        assert fmu.getFloat64([inner]) == [1.5]


def test_a_component_says_what_is_wrong(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    class Pendulum(Model):
        """A pendulum of a pipe."""

        world = World()
        joint = Revolute(phi=fixed(0.1), w=fixed(0))
        rod = BodyCylinder(r=(1, 0, 0), diameter=0.1, inner_diameter=0.05)

        def connections(self):
            yield chain(self.world, self.joint, self.rod)

    path = exported(ac.compile(Pendulum()), tmp_path / "a.fmu", 3)
    with pytest.raises(Exception, match=r"[Ee]rror"):
        simulated(path, "CoSimulation", 0.1, start_values={"rod.inner_diameter": 0.2})
    # Its mass would be negative; the cause is told.
    assert "rod: `inner_diameter` of rod is not less than `diameter`" in capfd.readouterr().out
