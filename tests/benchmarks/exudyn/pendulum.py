"""The flexible pendulum for Exudyn: root held by coordinate constraints, weight on every element."""

from __future__ import annotations

import numpy as np

from models.pendulum import LENGTH, RHO, A, E, J
from tests.benchmarks.exudyn.cable import Machine, Outputs, Section, Setting, across, angle, beam

GRAVITY, STOP = 9.81, 1.0


def build(how: Setting, elements: int) -> Machine:
    """Beam on the hinge; an even number of elements, because the middle is a node."""
    import exudyn as exu
    from exudyn.itemInterface import LoadMassProportional, MarkerBodyMass

    system = exu.SystemContainer().AddSystem()
    hinge = [True, True, False, False]
    made = beam(system, Section(LENGTH, E, RHO, A, J), elements, 0.0, how.quadrature, groundConstraintsStart=hinge)
    for element in made["elements"]:
        marker = system.AddMarker(MarkerBodyMass(bodyNumber=element))
        system.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=[0, -GRAVITY, 0]))

    def outputs(_times: np.ndarray, rows: dict[str, np.ndarray]) -> Outputs:
        root, middle, tip = (rows[name][:, :2] for name in ("root", "middle", "tip"))
        slope = rows["root"][:, 2:]
        return {
            "swing_angle": angle(slope),
            "tip_deflection": across(root, slope, tip),
            "tip_x": tip[:, 0],
            "tip_y": tip[:, 1],
            "mid_deflection": across(root, tip - root, middle),
        }

    nodes = made["nodes"]
    return Machine(system, {"root": nodes[0], "middle": nodes[elements // 2], "tip": nodes[-1]}, outputs, STOP)
