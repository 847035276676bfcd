"""Benchmark: the elastic slider-crank with Exudyn, the mark of another program for accuracy against time.

    python -m tests.benchmarks.slider_crank_exudyn [REFERENCE.npz]

Planar ANCF cable elements, 3 for the crank and 8 for the rod (geometrically exact, unlike one floating frame), index-3
generalised-alpha with fixed steps (spectral radius 0.8), Newton tolerances raised to 1e-5, started again at 0.7 s where
the torque stops. Errors are the largest of 401 points against a converged run of the same program (kept in the file,
made where it is missing), in parts of the range.
Exudyn is optional: pip install ".[benchmark]".
"""

from __future__ import annotations

import importlib.util
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from tests.benchmarks.slider_crank_by_hand import CRANK, ROD, Section

SWITCH, STOP, INTERVALS = 0.7, 1.6, 400
REFERENCE = Path(tempfile.gettempdir()) / "slider_crank_exudyn.npz"
CONVERGED = {"crank_elements": 12, "rod_elements": 32, "step": 2e-5}


@dataclass(frozen=True)
class Mechanism:
    """System of Exudyn, its nodes at crank pin, rod's middle and slider, and the marker that takes the torque."""

    system: Any
    nodes: tuple[int, int, int]
    hub: int


@dataclass(frozen=True)
class Run:
    """Slider position and deflection of the rod's middle at the output times, and the time and counts of the solver."""

    slider: np.ndarray
    middle: np.ndarray
    solve_seconds: float
    steps: int = 0
    factorisations: int = 0


def build(crank_elements: int, rod_elements: int) -> Mechanism:
    """Assemble crank, pin, rod and slider; the torque is added by `simulate`."""
    import exudyn as exu
    from exudyn.beams import GenerateBeamElementsAlongLine
    from exudyn.itemInterface import Cable2D, MarkerBodyRigid, MarkerNodePosition, ObjectJointRevolute2D

    system = exu.SystemContainer().AddSystem()

    def beam(section: Section, elements: int, x: float, root: list[bool], tip: list[bool]) -> dict[str, Any]:
        element = Cable2D(
            massPerLength=section.rho * section.A,
            bendingStiffness=section.E * section.J,
            axialStiffness=section.E * section.A,
        )
        ends, held = (
            ([x, 0, 0], [x + section.length, 0, 0]),
            {"groundConstraintsStart": root, "groundConstraintsEnd": tip},
        )
        return GenerateBeamElementsAlongLine(system, *ends, elements, element, **held)

    free, pinned, sliding = [False] * 4, [True, True, False, False], [False, True, False, False]
    crank = beam(CRANK, crank_elements, 0.0, pinned, free)
    rod = beam(ROD, rod_elements, CRANK.length, free, sliding)["nodes"]
    pin = [system.AddMarker(MarkerNodePosition(nodeNumber=node)) for node in (crank["nodes"][-1], rod[0])]
    system.AddObject(ObjectJointRevolute2D(markerNumbers=pin))
    hub = system.AddMarker(MarkerBodyRigid(bodyNumber=crank["elements"][0], localPosition=[0, 0, 0]))
    return Mechanism(system, (rod[0], rod[rod_elements // 2], rod[-1]), hub)


def _settings(start: float, stop: float, step: float) -> Any:
    """Solver settings of one smooth part."""
    import exudyn as exu

    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    integration.startTime, integration.endTime = start, stop
    integration.numberOfSteps = round((stop - start) / step)
    integration.generalizedAlpha.spectralRadius = 0.8
    # the default tolerances cost Newton iterations that change no digit of the results
    integration.newton.relativeTolerance, integration.newton.absoluteTolerance = 1e-5, 1e-8
    integration.newton.useModifiedNewton = True
    integration.adaptiveStep = False
    integration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = STOP / INTERVALS
    return settings


def simulate(mechanism: Mechanism, step: float) -> Run:
    """Integrate from rest, with the torque until 0.7 s and on from there without it."""
    import exudyn as exu
    from exudyn.itemInterface import LoadTorqueVector, SensorNode

    system = mechanism.system
    on = [1.0]

    def torque(_system: Any, t: float, _load: Any) -> list[float]:
        return [0.0, 0.0, on[0] * 0.01 * (1 - np.exp(-t / 0.167))]

    system.AddLoad(LoadTorqueVector(markerNumber=mechanism.hub, loadVectorUserFunction=torque))
    position = exu.OutputVariableType.Position
    sensors = [
        system.AddSensor(SensorNode(nodeNumber=node, outputVariableType=position, storeInternal=True))
        for node in mechanism.nodes
    ]
    system.Assemble()
    seconds, traces, counts = 0.0, [], np.zeros(2, int)
    for start, stop, on[0] in ((0.0, SWITCH, 1.0), (SWITCH, STOP, 0.0)):
        begun = time.process_time()
        system.SolveDynamic(_settings(start, stop, step), updateInitialValues=True)
        seconds += time.process_time() - begun
        done = system.sys["dynamicSolver"].it
        counts += [done.currentStepIndex - 1, done.newtonJacobiCount]
        traces.append([system.GetSensorStoredData(sensor).copy() for sensor in sensors])
    pin, middle, slider = (
        np.vstack([trace[k][int(part > 0) :] for part, trace in enumerate(traces)]) for k in range(3)
    )
    chord, across = slider[:, 1:3] - pin[:, 1:3], middle[:, 1:3] - pin[:, 1:3]
    away = (chord[:, 0] * across[:, 1] - chord[:, 1] * across[:, 0]) / np.hypot(*chord.T)
    return Run(slider[:, 1], away, seconds, *counts.tolist())


def reference(path: Path) -> Run:
    """Read the converged run, or make it."""
    if not path.exists():
        print(f"making {path}: {CONVERGED}")
        run = simulate(build(CONVERGED["crank_elements"], CONVERGED["rod_elements"]), CONVERGED["step"])
        np.savez(path, slider=run.slider, middle=run.middle, seconds=run.solve_seconds)
    kept = np.load(path)
    return Run(kept["slider"], kept["middle"], float(kept["seconds"]))


def main(path: Path = REFERENCE) -> None:
    """Print CPU time and errors."""
    if importlib.util.find_spec("exudyn") is None:
        print('Exudyn is not installed, so there is nothing to compare with: pip install ".[benchmark]"')
        return
    exact = reference(path)
    table = Table("step [s]", "CPU time [s]", "slider / range", "mid deflection / range")
    for step in (2e-3, 2e-4):
        run = simulate(build(3, 8), step)
        errors = [np.abs(a - b).max() / np.ptp(b) for a, b in ((run.slider, exact.slider), (run.middle, exact.middle))]
        table.add_row(f"{step:g}", f"{run.solve_seconds:.2f}", *(f"{e:.1e}" for e in errors))
    Console(width=100).print(table)


if __name__ == "__main__":
    main(*(Path(argument) for argument in sys.argv[1:2]))
