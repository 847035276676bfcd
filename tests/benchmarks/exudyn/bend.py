"""The 45-degree bend: errors of the tip of both programs against the exact rod."""

from __future__ import annotations

from collections.abc import Iterable
from math import pi
from typing import Any

import numpy as np

from components import Section
from tests.benchmarks.exudyn.rod import clamp, rod
from tests.components.beams_in_space.scenes import BEND, bend_error, bent_tip

NAME = "bend of 45 degrees"
RADIUS, FORCE, ANGLE = 100.0, 600.0, pi / 4
SHEAR = 1e8  # N; ten times as much moves the tip of 8 elements by 2e-4 m, with 6 times as many iterations
KINDS = {
    "stiffened": {"geometric_stiffness": True},
    "stiffened, pinned": {"geometric_stiffness": True, "reference": "pinned"},
    "linear": {},
    "linear, pinned": {"reference": "pinned"},
}
COLUMNS = ["elements", "Exudyn", *KINDS]


def exudyn_tip(elements: int) -> np.ndarray:
    """Tip in Exudyn: nodes on the arc, the force in 20 steps."""
    import exudyn as exu
    from exudyn.itemInterface import Force, MarkerNodeRigid

    exu.config.printToConsole = False
    E, EJ, inertia = BEND["E"], BEND["E"] * BEND["J"], BEND["rho"] * BEND["J"]
    section = Section(E * BEND["A"], EJ, EJ, BEND["G"] * BEND["J_t"], BEND["rho"], inertia, inertia, SHEAR, SHEAR)
    system: Any = exu.SystemContainer().AddSystem()
    turned = np.linspace(0, ANGLE, elements + 1)
    places = RADIUS * np.column_stack([np.sin(turned), 1 - np.cos(turned), 0 * turned])
    nodes = rod(system, section, places, turned, RADIUS * ANGLE / elements, quaternions=True)
    clamp(system, nodes[0])
    tip = system.AddMarker(MarkerNodeRigid(nodeNumber=nodes[-1]))
    system.AddLoad(Force(markerNumber=tip, loadVector=[0, 0, FORCE]))
    system.Assemble()
    settings = exu.SimulationSettings()
    settings.staticSolver.numberOfLoadSteps = 20
    settings.staticSolver.verboseMode = 0
    settings.staticSolver.newton.absoluteTolerance = 1e-6
    settings.solution.file.write = False
    system.SolveStatic(settings)
    return np.array(system.GetNodeOutput(nodes[-1], exu.OutputVariableType.Position))


def bend_rows(counts: Iterable[int] = (8, 16)) -> Iterable[list[str]]:
    """Rows of the errors in m, for each number of elements."""
    for count in counts:
        theirs = float(np.linalg.norm(exudyn_tip(count) - bent_tip()))
        yield [str(count), *(f"{e:.3f}" for e in (theirs, *(bend_error(count, **kind) for kind in KINDS.values())))]
