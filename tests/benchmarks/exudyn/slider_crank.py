"""The elastic slider-crank for Exudyn: crank, pin and rod, begun anew at 0.7 s where the torque stops."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.benchmarks.exudyn.cable import Machine, Outputs, Section, Setting, across, angle, beam
from tests.benchmarks.slider_crank_by_hand import CRANK, ROD
from tests.benchmarks.slider_crank_methods import STOP, SWITCH


def build(how: Setting, crank_elements: int, rod_elements: int) -> Machine:
    """Crank on the bearing, rod on its pin, slider on the x axis; an even number of elements of the rod."""
    import exudyn as exu
    from exudyn.itemInterface import LoadTorqueVector, MarkerBodyRigid, MarkerNodePosition, ObjectJointRevolute2D

    system = exu.SystemContainer().AddSystem()

    def bar(data: Any, elements: int, x: float, **held: list[bool]) -> dict[str, Any]:
        section = Section(data.length, data.E, data.rho, data.A, data.J)
        return beam(system, section, elements, x, how.quadrature, **held)

    crank = bar(CRANK, crank_elements, 0.0, groundConstraintsStart=[True, True, False, False])
    made = bar(ROD, rod_elements, CRANK.length, groundConstraintsEnd=[False, True, False, False])
    rod = made["nodes"]
    pin = [system.AddMarker(MarkerNodePosition(nodeNumber=node)) for node in (crank["nodes"][-1], rod[0])]
    system.AddObject(ObjectJointRevolute2D(markerNumbers=pin))
    hub = system.AddMarker(MarkerBodyRigid(bodyNumber=crank["elements"][0], localPosition=[0, 0, 0]))

    def torque(_system: Any, t: float, _load: Any) -> list[float]:
        return [0.0, 0.0, 0.01 * (1 - np.exp(-t / 0.167))]

    drive = system.AddLoad(LoadTorqueVector(markerNumber=hub, loadVectorUserFunction=torque))

    def stop_torque(running: Any) -> None:
        running.SetLoadParameter(drive, "loadVectorUserFunction", 0)

    def outputs(_times: np.ndarray, rows: dict[str, np.ndarray]) -> Outputs:
        root, middle, slider = (rows[name][:, :2] for name in ("pin", "middle", "slider"))
        return {
            "crank_angle": angle(rows["bearing"][:, 2:]),
            "slider_position": slider[:, 0],
            "rod_tip_deflection": across(root, rows["pin"][:, 2:], slider),
            "rod_mid_deflection": across(root, slider - root, middle),
        }

    nodes = {"bearing": crank["nodes"][0], "pin": rod[0], "middle": rod[rod_elements // 2], "slider": rod[-1]}
    return Machine(system, nodes, outputs, STOP, (SWITCH,), stop_torque)
