"""What an FMU for Model Exchange declares of its equations."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree

from components.fmu.signals import Signal, read_signal


@dataclass(frozen=True)
class Dynamics:
    """States, inputs and outputs of an FMU for Model Exchange, and what it is able to do.

    Attributes
    ----------
    states : tuple of Signal
        Continuous states, in the unit of the FMU.
    derivatives : tuple of int
        Value references of their derivatives.
    inputs, discrete_inputs, outputs, discrete_outputs : tuple of Signal
        Inputs and outputs, of which continuous ones may change at any time.
    needs : tuple of tuple of bool
        For each derivative, then each continuous output: on which continuous inputs it depends.
    indicators : int
        Number of event indicators.
    saves, directional, completes : bool
        Whether it saves its state, has directional derivatives, and is told of the end of each step.
    """

    states: tuple[Signal, ...]
    derivatives: tuple[int, ...]
    inputs: tuple[Signal, ...]
    discrete_inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]
    discrete_outputs: tuple[Signal, ...]
    needs: tuple[tuple[bool, ...], ...]
    indicators: int
    saves: bool
    directional: bool
    completes: bool


def read_dynamics(path: str, found: Any, inputs: tuple[Signal, ...], outputs: tuple[Signal, ...]) -> Dynamics:
    """Read what an FMU for Model Exchange declares.

    Parameters
    ----------
    path : str
        Name of the file.
    found : fmpy.model_description.ModelDescription
        Its description.
    inputs, outputs : tuple of Signal
        Its inputs and outputs.
    """
    with zipfile.ZipFile(path) as file:
        able = ElementTree.fromstring(file.read("modelDescription.xml")).find("ModelExchange")
    assert able is not None
    rates = [unknown.variable for unknown in found.derivatives]
    units = {str(unit.name): unit.baseUnit for unit in found.unitDefinitions}
    states = [read_signal(rate.derivative, found.fmiVersion, units, path, ()) for rate in rates]
    u = tuple(s for s in inputs if s.continuous)
    y = tuple(s for s in outputs if s.kind in ("Real", "Float64"))
    unknowns = {
        unknown.variable.valueReference: unknown.dependencies for unknown in [*found.derivatives, *found.outputs]
    }
    needs = []
    for reference in [*(rate.valueReference for rate in rates), *(s.reference for s in y)]:
        known = unknowns.get(reference)
        named = None if known is None else {variable.valueReference for variable in known}
        needs.append(tuple(named is None or s.reference in named for s in u))
    indicators = len(found.eventIndicators or ()) if found.fmiVersion == "3.0" else found.numberOfEventIndicators
    return Dynamics(
        tuple(s for s in states if s is not None),
        tuple(rate.valueReference for rate in rates),
        u,
        tuple(s for s in inputs if not s.continuous),
        y,
        tuple(s for s in outputs if s.kind not in ("Real", "Float64")),
        tuple(needs),
        int(indicators or 0),
        saves=_is_true(able, "canGetAndSetFMUstate", "canGetAndSetFMUState"),
        directional=_is_true(able, "providesDirectionalDerivative", "providesDirectionalDerivatives"),
        completes=not _is_true(able, "completedIntegratorStepNotNeeded")
        if found.fmiVersion == "2.0"
        else _is_true(able, "needsCompletedIntegratorStep", default="true"),
    )


def _is_true(element: ElementTree.Element, *names: str, default: str = "false") -> bool:
    return next((element.get(name) for name in names if name in element.attrib), default) in ("true", "1")
