"""Interface of an FMU: its inputs, outputs and parameters as fields of a component."""

from __future__ import annotations

import os
from collections.abc import Collection
from dataclasses import dataclass

from acausal import DeclarationError
from components.fmu.dynamics import Dynamics, read_dynamics
from components.fmu.signals import TYPES, Signal, read_signal

KINDS = {"co_simulation": "Co-Simulation", "model_exchange": "Model Exchange"}


@dataclass(frozen=True)
class Interface:
    """What is read of an FMU: its path, version, default step in s, signals, and for Model Exchange its dynamics."""

    path: str
    version: str
    step: float | None
    inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]
    parameters: tuple[Signal, ...]
    dynamics: Dynamics | None = None


def read_interface(path: str | os.PathLike[str], kind: str | None, taken: Collection[str]) -> Interface:
    """Read the interface of an FMU.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    kind : str or None
        "co_simulation" or "model_exchange"; None for the first that it has.
    taken : collection of str
        Names that fields avoid.

    Raises
    ------
    DeclarationError
        The file is no FMU, or not of this kind, or an input or output is not a scalar number; or fmpy is not installed.
    """
    try:
        from fmpy import read_model_description
    except ImportError:
        raise DeclarationError("FMUs as parts need fmpy: python -m pip install 'acausal[fmu]'.") from None
    path = os.path.abspath(path)
    if not os.path.isfile(path):
        raise DeclarationError(f"there is no FMU {os.fspath(path)!r}.")
    try:
        found = read_model_description(path, validate=False)
    except Exception as error:
        raise DeclarationError(f"{os.path.basename(path)!r} is no FMU: {error}.") from error
    has = {"co_simulation": found.coSimulation is not None, "model_exchange": found.modelExchange is not None}
    own = [name for name in KINDS if has[name]]
    kind = kind or next(iter(own), None)
    if found.fmiVersion not in TYPES or kind not in own:
        wanted = KINDS[kind] if kind else " or ".join(KINDS.values())
        raise DeclarationError(
            f"{os.path.basename(path)!r} is FMI {found.fmiVersion} for {' and '.join(KINDS[name] for name in own) or 'neither'}; "
            f"it must be for {wanted} by FMI 2 or 3."
        )
    wanted = {"input": list[Signal](), "output": list[Signal](), "parameter": list[Signal]()}
    units = {str(unit.name): unit.baseUnit for unit in found.unitDefinitions}
    for variable in found.modelVariables:
        if variable.causality in wanted and (signal := read_signal(variable, found.fmiVersion, units, path, taken)):
            wanted[variable.causality].append(signal)
    experiment = found.defaultExperiment
    step = float(experiment.stepSize) if experiment is not None and experiment.stepSize else None
    inputs, outputs, parameters = (tuple(wanted[part]) for part in ("input", "output", "parameter"))
    dynamics = read_dynamics(path, found, inputs, outputs) if kind == "model_exchange" else None
    return Interface(path, found.fmiVersion, step, inputs, outputs, parameters, dynamics)
