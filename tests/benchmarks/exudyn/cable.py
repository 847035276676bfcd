"""Planar cable elements of Exudyn (absolute nodal coordinates, geometrically exact), and its integration in time.

Index-3 generalised-alpha with fixed steps; `rod` has the elements in space. What was tried to make it fast: dense and
sparse linear solvers, spectral radii, full and modified Newton, tolerances, and the three rules of quadrature; the best of
each is the default or stands in the scene.
"""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

Outputs = dict[str, np.ndarray]


@dataclass(frozen=True)
class Setting:
    """How Exudyn integrates.

    Attributes
    ----------
    step : float
        Fixed step in s.
    radius : float
        Spectral radius: 1 keeps all vibrations, 0 damps those at the step's frequency at once.
    modified : bool
        Keep the Jacobian as long as the iterations contract.
    absolute, relative : float
        Tolerances of the Newton iteration; the default of 1e-10 is never reached by stiff beams.
    quadrature : int
        2 is the cheapest rule and has the best axial strain, 0 the full one.
    each_step : bool
        Evaluate the Jacobian anew at each step, if it is kept at all.
    sparse : bool
        Sparse linear solver instead of the dense one.
    elements : int
        Elements of a leg, in scenes where they depend on the setting.
    """

    step: float
    radius: float = 0.8
    modified: bool = False
    absolute: float = 1e-6
    quadrature: int = 2
    relative: float = 1e-5
    each_step: bool = False
    sparse: bool = False
    elements: int = 0

    @property
    def label(self) -> str:
        """Name for tables; what stands after its comma is common to the points of a curve."""
        if self.elements:
            return f"{self.elements} elements, step {self.step:g} s"
        return f"{self.step:g} s, radius {self.radius:g}"


@dataclass(frozen=True)
class Section:
    """Straight beam: length in m, modulus in Pa, density in kg/m3, area in m2 and second moment of area in m4."""

    length: float
    E: float
    rho: float
    A: float
    J: float


@dataclass(frozen=True)
class Machine:
    """An assembled system.

    Attributes
    ----------
    system : MainSystem
        Of Exudyn.
    nodes : dict of str to int
        Nodes whose coordinates are recorded.
    outputs : callable
        Outputs of the scene from time and coordinates of each recorded node: (x, y, dx/ds, dy/ds) of cables, shape (times, 4),
        place and rotation vector of rods, shape (times, 6).
    stop : float
        End in s.
    breaks : tuple of float
        Times at which the integration is begun anew.
    at_break : callable
        What happens to the system there.
    """

    system: Any
    nodes: dict[str, int]
    outputs: Callable[[np.ndarray, dict[str, np.ndarray]], Outputs]
    stop: float
    breaks: tuple[float, ...] = ()
    at_break: Callable[[Any], None] = lambda system: None


@dataclass(frozen=True)
class Run:
    """Outputs at the times that steps and grid share, CPU seconds of the solver alone, and its counts."""

    times: np.ndarray
    outputs: Outputs
    seconds: float
    steps: int
    factorisations: int
    iterations: int


def has_exudyn() -> bool:
    """Whether the other program is there."""
    return importlib.util.find_spec("exudyn") is not None


def beam(system: Any, section: Section, elements: int, x: float, quadrature: int, **held: list[bool]) -> dict[str, Any]:
    """Add a beam along x; `groundConstraintsStart` and `groundConstraintsEnd` hold x, y, dx/ds, dy/ds of its ends."""
    from exudyn.beams import GenerateBeamElementsAlongLine
    from exudyn.itemInterface import Cable2D

    element = Cable2D(
        massPerLength=section.rho * section.A,
        bendingStiffness=section.E * section.J,
        axialStiffness=section.E * section.A,
        useReducedOrderIntegration=quadrature,
    )
    ends = [x, 0, 0], [x + section.length, 0, 0]
    return GenerateBeamElementsAlongLine(system, *ends, elements, element, **held)


def _settings(start: float, stop: float, period: float, how: Setting) -> Any:
    """Settings of one smooth part, which writes no files."""
    import exudyn as exu

    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    integration.startTime, integration.endTime = start, stop
    integration.numberOfSteps = round((stop - start) / how.step)
    integration.generalizedAlpha.spectralRadius = how.radius
    integration.newton.relativeTolerance, integration.newton.absoluteTolerance = how.relative, how.absolute
    integration.newton.useModifiedNewton = how.modified
    integration.newton.modifiedNewtonJacUpdatePerStep = how.each_step
    integration.adaptiveStep = False
    integration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = max(period, how.step)
    settings.parallel.numberOfThreads = 1
    if how.sparse:
        settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    return settings


def simulate(machine: Machine, how: Setting, intervals: int) -> Run:
    """Integrate from the start to the end, anew after each break; a `SolverError` of Exudyn passes through."""
    import exudyn as exu
    from exudyn.itemInterface import SensorNode

    # a failure is told by the error that it raises
    exu.config.printToConsole = False
    system, period = machine.system, machine.stop / intervals
    kind: Any = exu.OutputVariableType.CoordinatesTotal
    sensors = {
        name: system.AddSensor(SensorNode(nodeNumber=node, outputVariableType=kind, storeInternal=True))
        for name, node in machine.nodes.items()
    }
    system.Assemble()
    seconds, parts, counts = 0.0, [], np.zeros(3, int)
    for start, stop in pairwise((0.0, *machine.breaks, machine.stop)):
        if start:
            machine.at_break(system)
        settings = _settings(start, stop, period, how)
        begun = time.process_time()
        system.SolveDynamic(settings, updateInitialValues=True)
        seconds += time.process_time() - begun
        done = system.sys["dynamicSolver"].it
        counts += [done.currentStepIndex - 1, done.newtonJacobiCount, done.newtonStepsCount]
        parts.append({name: system.GetSensorStoredData(sensor).copy() for name, sensor in sensors.items()})
    rows = {name: np.vstack([part[name][int(k > 0) :] for k, part in enumerate(parts)]) for name in sensors}
    times = next(iter(rows.values()))[:, 0]
    return Run(times, machine.outputs(times, {n: r[:, 1:] for n, r in rows.items()}), seconds, *counts.tolist())


def across(root: np.ndarray, direction: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Distance of a point, in m, to the left of the line through the root along a direction; each of shape (times, 2)."""
    away = point - root
    return (direction[:, 0] * away[:, 1] - direction[:, 1] * away[:, 0]) / np.hypot(*direction.T)


def angle(slope: np.ndarray) -> np.ndarray:
    """Angle of a direction of shape (times, 2) in rad, not wrapped."""
    return np.unwrap(np.arctan2(slope[:, 1], slope[:, 0]))
