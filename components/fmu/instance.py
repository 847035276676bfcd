"""Instances of FMUs by the package fmpy, and values of their variables in SI."""

from __future__ import annotations

import os
import shutil
import tempfile
from contextlib import suppress
from functools import cache
from typing import Any

import numpy as np

from components.fmu.interface import Interface
from components.fmu.signals import CONTINUOUS, Signal


def initialized(interface: Interface, kind: str, time: float, p: Any, u: Any, fmu: Any = None) -> Any:
    """Return a new instance of an FMU after its initialization, or one that is reset.

    Parameters
    ----------
    interface : Interface
        The FMU.
    kind : str
        "CoSimulation" or "ModelExchange".
    time : float
        Start time in s.
    p, u : arrays
        Parameters and inputs in SI.
    fmu : optional
        What to reset.
    """
    if fmu is None:
        from fmpy.simulation import instantiate_fmu

        folder, description = _unpacked(interface.path, os.stat(interface.path).st_mtime_ns)
        fmu = instantiate_fmu(folder, description, kind)
    else:
        fmu.reset()
    set_values(fmu, interface.parameters, p)
    start = {"startTime": time}
    if interface.version == "2.0":
        fmu.setupExperiment(**start)
    fmu.enterInitializationMode(**({} if interface.version == "2.0" else start))
    set_values(fmu, interface.inputs, u)
    fmu.exitInitializationMode()
    return fmu


def end(fmu: Any) -> None:
    """End an instance; None for no instance."""
    if fmu is not None:
        with suppress(Exception):  # an FMU that fails at its end has done its work
            fmu.terminate()
            fmu.freeInstance()


def set_values(fmu: Any, signals: tuple[Signal, ...], values: Any) -> None:
    """Set variables, in SI."""
    for signal, value in zip(signals, values, strict=True):
        number = (float(value) - signal.offset) / signal.factor
        given = number > 0.5 if signal.kind == "Boolean" else number if signal.kind in CONTINUOUS else round(number)
        getattr(fmu, f"set{signal.kind}")([signal.reference], [given])


def get_values(fmu: Any, signals: tuple[Signal, ...]) -> np.ndarray:
    """Return variables, in SI."""
    return np.array([s.factor * float(getattr(fmu, f"get{s.kind}")([s.reference])[0]) + s.offset for s in signals])


@cache
def _unpacked(path: str, changed: int) -> tuple[str, Any]:
    """Return the folder of an FMU, removed at the end of the process, and its description; anew where the file has changed."""
    import atexit

    from fmpy import extract, read_model_description

    folder = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    extract(path, unzipdir=folder)
    return folder, read_model_description(folder, validate=False)
