"""Models with inputs, jumps, switches and instants, and how FMUs of them are run."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import rmtree
from typing import Any

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave

from acausal import Model, Scalar, der, discrete, input, output, parameter, piecewise, reinit, time, variable, when
from acausal.export import export_fmu
from models import FourBar


class Ball(Model):
    """A ball that bounces and counts its impacts."""

    stop_time = 2.0
    e: Scalar = parameter("restitution", default=0.8)
    h: Scalar = variable("height", unit="m", start=1, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)
    height: Scalar = output("height", unit="m")
    n: Scalar = discrete("impacts")
    count: Scalar = output("impacts")

    def equations(self):
        yield der(self.h) == self.v
        yield der(self.v) == -9.81
        yield self.count == self.n
        yield self.height == self.h
        yield when(self.h < 0, reinit(self.v, -self.e * self.v), reinit(self.n, self.n + 1))


class Hybrid(Model):
    """A sampled controller, a load that is switched on, a limit and an input."""

    stop_time = 2.0
    tau: Scalar = parameter("time constant", unit="s", default=0.3)
    late: Scalar = parameter("when the load comes", unit="s", default=0.7)
    step: Scalar = parameter("sample time", unit="s", default=0.11)
    wanted: Scalar = input("wanted value")
    x: Scalar = variable("value", start=0.2, fixed=True)
    y: Scalar = output("limited")
    held: Scalar = discrete("held", start=0)
    due: Scalar = discrete("next sample", unit="s", start=0.05)

    def equations(self):
        load = piecewise((0.0, time < self.late), 1.0)
        yield self.tau * der(self.x) == 2 * self.held + self.wanted - self.x - load
        yield self.y == piecewise((0.9, self.x > 0.9), (self.x, self.x > -0.3), -0.3)
        yield when(time >= self.due, reinit(self.held, self.wanted - self.x), reinit(self.due, self.due + self.step))


class Struck(FourBar):
    """A four-bar whose crank is struck where the coupler joint turns back: all rates of the loop jump."""

    stop_time = 1.5

    def equations(self):
        yield from super().equations()
        yield when(self.j1.phi < -2, reinit(self.j1.w, 0.5 * self.j1.w))
        yield when(time > 0.8, reinit(self.j1.w, self.j1.w + 2))


def exported(model: Any, path: Path, version: int, **options: Any) -> Path:
    """Write a model as an FMU."""
    export_fmu(model, path, fmi_version=version, **options)
    return path


def simulated(path: Path, kind: str, stop: float, intervals: int = 40, **options: Any) -> np.ndarray:
    """Run an FMU."""
    given = {"relative_tolerance": 1e-6, "output_interval": stop / intervals, **options}
    return simulate_fmu(str(path), fmi_type=kind, stop_time=stop, record_events=False, **given)


@contextmanager
def opened(path: Path, kind: str) -> Iterator[tuple[Any, Any]]:
    """An instance of an FMU, and the description."""
    description, folder = read_model_description(str(path)), extract(str(path))
    classes = {
        ("2.0", "CoSimulation"): FMU2Slave,
        ("2.0", "ModelExchange"): FMU2Model,
        ("3.0", "CoSimulation"): FMU3Slave,
        ("3.0", "ModelExchange"): FMU3Model,
    }
    about = description.coSimulation if kind == "CoSimulation" else description.modelExchange
    fmu = classes[description.fmiVersion, kind](
        guid=description.guid, unzipDirectory=folder, modelIdentifier=about.modelIdentifier, instanceName="one"
    )
    try:
        fmu.instantiate()
        if description.fmiVersion == "2.0":
            fmu.setupExperiment(startTime=0.0)
        yield fmu, description
    finally:
        fmu.terminate()
        fmu.freeInstance()
        rmtree(folder, ignore_errors=True)
