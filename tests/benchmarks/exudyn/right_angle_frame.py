"""The right-angle frame for Exudyn: the legs have a node each at the elbow, held together by a joint.

The force is a Python function. As a symbolic function of Exudyn, with a restart after the pulse, with a stiff spring as
the joint, or with coordinate constraints at the root, a run takes the same time within 3 %.
"""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from models.right_angle_frame import LEG
from tests.benchmarks.exudyn.cable import Machine, Outputs, Setting
from tests.benchmarks.exudyn.rod import clamp, rod

LENGTH, STOP = 10.0, 10.0


def build(how: Setting) -> Machine:
    """Frame of `how.elements` a leg."""
    import exudyn as exu
    from exudyn.itemInterface import Force, GenericJoint, MarkerNodeRigid

    system: Any = exu.SystemContainer().AddSystem()
    n = how.elements
    along, still = np.linspace(0, LENGTH, n + 1), np.zeros(n + 1)
    first = rod(system, LEG, np.column_stack([along, still, still]), still, LENGTH / n)
    second = rod(system, LEG, np.column_stack([still + LENGTH, along, still]), still + pi / 2, LENGTH / n)
    clamp(system, first[0])
    back = [[0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]  # a quarter turn about z
    elbow = system.AddMarker(MarkerNodeRigid(nodeNumber=first[-1]))
    system.AddObject(
        GenericJoint(markerNumbers=[elbow, system.AddMarker(MarkerNodeRigid(nodeNumber=second[0], localHT=back))])
    )

    def pulse(_system: Any, t: float, _load: Any) -> list[float]:
        return [0.0, 0.0, 50 * max(0.0, 1 - abs(t - 1))]

    given: Any = {"loadVectorUserFunction": pulse}
    system.AddLoad(Force(markerNumber=elbow, **given))

    def outputs(_times: np.ndarray, rows: dict[str, np.ndarray]) -> Outputs:
        return {name: row[:, :3] for name, row in rows.items()}

    return Machine(system, {"elbow": first[-1], "tip": second[-1]}, outputs, STOP)
