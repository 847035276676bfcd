"""FMUs for Co-Simulation as parts: those of this project and of another package, errors of coupling, wrong files."""

from __future__ import annotations

import pickle
import re
import subprocess
import sys
import zipfile
from functools import partial

import numpy as np
import pytest

import acausal as ac
from acausal import Model, quantity
from models import Bricard

pytest.importorskip("fmpy")

from components.fmu import FMU
from tests.components.oscillator import Spring
from tests.components.oscillator import oscillator as exchanging

oscillator = partial(exchanging, powers=[("v", "F")])


@pytest.fixture(scope="module", params=[2, 3])
def spring(request, tmp_path_factory):
    """The spring as an FMU of FMI 2 or 3."""
    path = tmp_path_factory.mktemp("fmu") / "spring.fmu"
    ac.export_fmu(Spring(), path, fmi_version=request.param)
    return path


def test_errors_fall_with_the_step(spring):
    steps, errors, told = (1e-3, 2e-4, 4e-5), [], []
    for step in steps:
        result = ac.simulate(oscillator(spring, step=step), stop_time=1)
        errors.append(np.abs(result["x"] - 0.1 * np.cos(10 * result.time)).max())
        told.append(result["spring.coupling_error"][-1])
    for found in (errors, told):
        orders = np.diff(np.log(found)) / np.diff(np.log(steps))
        np.testing.assert_allclose(orders, 1, atol=0.1)
    # F dv/dt - v dF/dt is 100 W/s at any time; half of it times the step is lost or won.
    np.testing.assert_allclose(told, 50 * np.array(steps), rtol=0.1)


def test_runs_begin_alike(spring):
    model = ac.compile(oscillator(spring, step=1e-3))
    first = ac.simulate(model, stop_time=0.5)["x"]
    np.testing.assert_array_equal(ac.simulate(model, stop_time=0.5)["x"], first)
    other = ac.simulate(model, stop_time=0.5, parameters={"spring.k": 400, "spring.step": 1e-5})
    np.testing.assert_allclose(other["x"], 0.1 * np.cos(20 * other.time), atol=2e-4)
    part = pickle.loads(pickle.dumps(FMU(spring, step=1e-3)))
    assert type(part) is type(FMU(spring, step=1e-3))


def test_it_is_no_part_of_files_and_linear_systems(spring, tmp_path):
    with pytest.raises(ac.ExportError, match="`spring`"):
        ac.export_fmu(oscillator(spring, step=1e-3), tmp_path / "oscillator.fmu")
    with pytest.warns(ac.AcausalWarning, match="`spring`"):
        linear = ac.linearize(oscillator(spring, step=1e-3))
    np.testing.assert_allclose(linear.A, [[0, 1], [0, 0]])


LAG = """
from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real

class Lag(Fmi2Slave):
    def __init__(self, **given):
        super().__init__(**given)
        self.u, self.y, self.T, self.n, self.on = 0.0, 0.0, 0.5, 0, True
        for kind, name in ((Real, "u"), (Boolean, "on")):
            self.register_variable(kind(name, causality=Fmi2Causality.input))
        for kind, name in ((Real, "y"), (Integer, "n")):
            self.register_variable(kind(name, causality=Fmi2Causality.output))
        self.register_variable(Real("T", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))

    def do_step(self, time, step):
        if self.u > 100:
            raise ValueError("out of range")
        self.y += self.on * step * (self.u - self.y) / self.T
        self.n += 1
        return True
"""


@pytest.fixture(scope="module")
def lag(tmp_path_factory):
    """A lag by Euler steps, as an FMU of another package."""
    pytest.importorskip("pythonfmu")
    folder = tmp_path_factory.mktemp("lag")
    (folder / "lag.py").write_text(LAG)
    subprocess.run(
        [sys.executable, "-m", "pythonfmu", "build", "-f", "lag.py"], cwd=folder, check=True, capture_output=True
    )
    return folder / "Lag.fmu"


def with_lag(path, **values):
    """A model of the lag alone."""
    return type("Alone", (Model,), {"lag": FMU(path, on=1, **values), "__module__": __name__})()


def test_an_fmu_of_another_package(lag):
    result = ac.simulate(with_lag(lag, step=0.01, u=1, T=0.25), stop_time=2)
    n = np.floor(result.time / 0.01 + 1e-9)
    np.testing.assert_array_equal(result["lag.n"], n)
    np.testing.assert_allclose(result["lag.y"], 1 - (1 - 0.04) ** n, atol=1e-12)


def test_what_an_fmu_refuses_is_told(lag):
    with pytest.raises(ac.SimulationError, match=r"lag \(FMU.*fmi2DoStep"):
        ac.simulate(with_lag(lag, step=0.01, u=ac.time * 200), stop_time=2)


def test_wrong_files(lag, tmp_path):
    with pytest.raises(ac.DeclarationError, match="declares no step size; give one"):
        FMU(lag)
    with pytest.raises(ac.DeclarationError, match="there is no FMU"):
        FMU(tmp_path / "none.fmu")
    with pytest.raises(ac.DeclarationError, match=r"powers has \('y', 'u'\); .* inputs are u, on, and outputs y, n"):
        FMU(lag, step=0.1, powers=[("y", "u")])
    (tmp_path / "text.fmu").write_text("text")
    with pytest.raises(ac.DeclarationError, match="is no FMU"):
        FMU(tmp_path / "text.fmu")


def changed(path, folder, *pairs):
    """A copy of an FMU with other text in its description."""
    copy = folder / "changed.fmu"
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(copy, "w") as new:
        for name in old.namelist():
            data = old.read(name)
            if name == "modelDescription.xml":
                for was, becomes in pairs:
                    assert was in data
                    data = data.replace(was, becomes)
            new.writestr(name, data)
    return copy


def test_values_are_in_si(lag, tmp_path):
    """An input in degrees Celsius and an output in km/h."""
    units = (
        b'<UnitDefinitions><Unit name="km/h"><BaseUnit m="1" s="-1" factor="0.2777777777777778"/></Unit>'
        b'<Unit name="degC"><BaseUnit K="1" offset="273.15"/></Unit></UnitDefinitions><LogCategories>'
    )
    own = (b'<Real start="0"/>', b'<Real start="0" unit="degC"/>'), (b"<Real/>", b'<Real unit="km/h"/>')
    path = changed(lag, tmp_path, (b"<LogCategories>", units), *own)
    result = ac.simulate(with_lag(path, step=0.01, u=quantity(293.15, "K")), stop_time=10)
    assert result["lag.y"][-1] == pytest.approx(20 / 3.6, rel=1e-8)
    assert result["lag.u"][-1] == 293.15


def test_names_of_the_component_itself_are_avoided(lag, tmp_path):
    path = changed(lag, tmp_path, (b'name="T"', b'name="check"'), (b'name="u"', b'name="step"'))
    result = ac.simulate(with_lag(path, step=0.01, step_=1, check_=0.25), stop_time=0.5)
    assert result["lag.y"][-1] == pytest.approx(1 - 0.96**50)


def test_an_fmu_for_model_exchange_alone(spring, tmp_path):
    with zipfile.ZipFile(spring) as archive:
        element = re.search(rb"<CoSimulation[^>]*(/>|>.*?</CoSimulation>)", archive.read("modelDescription.xml"), re.S)
    with pytest.raises(ac.DeclarationError, match="for Model Exchange; it must be for Co-Simulation"):
        FMU(changed(spring, tmp_path, (element.group(), b"")), step=0.1)


def test_a_run_that_has_to_go_back_tells_why_it_cannot(lag):
    """With these settings one slice of the run would be repeated, with other states."""
    machine = type("Machine", (Bricard,), {"lag": FMU(lag, step=0.01, on=1, u=1), "__module__": __name__})
    with pytest.raises(ac.SimulationError, match=r'has no copy\. Take constraints="projection"'):
        ac.simulate(machine(), intervals=20, constraints="states", method="rosenbrock")
    ac.simulate(machine(), intervals=20, constraints="projection")


def test_without_fmpy_the_message_tells_how_to_install_it(spring, monkeypatch):
    monkeypatch.setitem(sys.modules, "fmpy", None)
    with pytest.raises(ac.DeclarationError, match=r"python -m pip install 'acausal\[fmu\]'"):
        FMU(spring)
