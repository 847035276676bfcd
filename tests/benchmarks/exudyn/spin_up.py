"""The spin-up for Exudyn: a generic joint between the ground and the beam's root takes the prescribed angle.

Its offset is a Python function, called once a Newton iteration. A hub with a coordinate constraint, the angle as a Python
or as a symbolic function of Exudyn, takes 12 to 15 % longer: more coordinates cost more than the calls.
"""

from __future__ import annotations

from math import cos, pi
from typing import Any

import numpy as np

from tests.benchmarks.exudyn.cable import Machine, Outputs, Section, Setting, across, beam

SECTION = Section(length=8, E=6.895e10, rho=2767, A=7.299e-5, J=8.214e-9)
RAMP, STOP = 15.0, 20.0


def prescribed(t: float, omega: float) -> float:
    """Angle of the hub in rad."""
    if t >= RAMP:
        return omega * (t - RAMP / 2)
    return omega / RAMP * (t * t / 2 + (RAMP / (2 * pi)) ** 2 * (cos(2 * pi * t / RAMP) - 1))


def build(how: Setting, elements: int, omega: float) -> Machine:
    """Beam on the hub."""
    import exudyn as exu
    from exudyn.itemInterface import GenericJoint, MarkerBodyRigid, ObjectGround

    system = exu.SystemContainer().AddSystem()
    made = beam(system, SECTION, elements, 0.0, how.quadrature)
    ground = system.AddObject(ObjectGround())
    ends = [
        system.AddMarker(MarkerBodyRigid(bodyNumber=body, localPosition=[0, 0, 0]))
        for body in (ground, made["elements"][0])
    ]

    def offset(_system: Any, t: float, _item: int, _parameters: Any) -> list[float]:
        return [0.0, 0.0, 0.0, 0.0, 0.0, prescribed(t, omega)]

    system.AddObject(GenericJoint(markerNumbers=ends, constrainedAxes=[1, 1, 0, 0, 0, 1], offsetUserFunction=offset))

    def outputs(times: np.ndarray, rows: dict[str, np.ndarray]) -> Outputs:
        turned = np.array([prescribed(t, omega) for t in times])
        along, tip = np.column_stack([np.cos(turned), np.sin(turned)]), rows["tip"][:, :2]
        extension = np.sum(along * tip, axis=1) - SECTION.length
        return {"tip_deflection": across(0 * tip, along, tip), "tip_extension": extension}

    return Machine(system, {"tip": made["nodes"][-1]}, outputs, STOP)
