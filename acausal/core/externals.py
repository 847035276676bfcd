"""Functions of other libraries in CasADi's expressions."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from functools import cache
from typing import Any

import casadi as ca
import numpy as np

from acausal.core.build.compiling import file_of, own_platform
from acausal.core.columns import COLUMNS
from acausal.core.library import address, loaded
from acausal.instructions import EXTERNAL, SLOPE, slope_place
from acausal.symbols import scalars, stacked

VALUE = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_void_p, ctypes.c_int32)
PREPARE = ctypes.CFUNCTYPE(ctypes.c_int32)
MARK = -1.0  # of a function among the columns
FMI_FUNCTIONS = (
    *("set_time", "set_states", "get_derivatives", "get_indicators"),
    *("set_real", "get_real", "completed", "directional"),
)


class ExternalData(ctypes.Structure):
    """What the library takes as a function, see `core.h`."""

    _fields_ = (
        ("count", ctypes.c_double),
        ("arguments", ctypes.c_int32),
        ("argument", ctypes.c_void_p),
        ("value", ctypes.c_void_p),
        ("completed", ctypes.c_void_p),
        ("parts", ctypes.c_int32),
    )


def external_data(argument: np.ndarray, value: Any, completed: Any = None) -> ExternalData:
    """Return what the library takes as a function, which lasts as long as its arguments and the functions of C."""
    functions = (ctypes.cast(function, ctypes.c_void_p).value for function in (value, completed))
    return ExternalData(MARK, len(argument), address(argument), *functions)


class FmuData(ctypes.Structure):
    """What the library takes as an FMU for Model Exchange, see `exchanged_fmu.c`."""

    _fields_ = (
        ("function", ExternalData),
        *((name, ctypes.c_int32) for name in ("version", "states", "inputs", "outputs", "indicators")),
        *((name, ctypes.c_int32) for name in ("completes", "wanted", "ready", "set", "known")),
        ("prepare", PREPARE),
        *((name, ctypes.c_void_p) for name in ("instance", *FMI_FUNCTIONS)),
        *((name, ctypes.c_void_p) for name in ("known_ref", "unknown_ref", "nominal")),
        *((name, ctypes.c_void_p) for name in ("now", "values", "slopes", "before", "known_slope")),
    )


@cache
def _function(n: int, values: int) -> ca.Function:
    """Return a function for expressions: of the number, which value, and n arguments."""
    number, place, *arguments = given = [ca.SX.sym(f"a{k}") for k in range(n + 2)]
    slope = _never_inlined(f"{SLOPE}_{n}_{values}", given, [ca.SX.zeros(1, 1) for _ in given])
    name = f"{EXTERNAL}_{n}_{values}"
    slopes = [slope(number, slope_place(name, place, k), *arguments) for k in range(n)]
    return _never_inlined(name, given, [ca.SX.zeros(1, 1), ca.SX.zeros(1, 1), *slopes])


def _never_inlined(name: str, given: list[ca.SX], slopes: list[ca.SX]) -> ca.Function:
    options: dict[str, Any] = {
        **{"never_inline": True, "enable_forward": False, "enable_reverse": False, "jac_penalty": 0},
        "custom_jacobian": ca.Function(f"jac_{name}", [*given, ca.SX.sym("result")], slopes),
    }
    return ca.Function(name, given, [_caller(len(given))(stacked(given))], options)


@cache
def _caller(rows: int) -> ca.Function:
    _ = COLUMNS.address
    loaded(runs=False).ac_casadi_call_rows(rows)
    return ca.external("ac_casadi_call", str(file_of(own_platform())))


def values_of(number: ca.SX, arguments: ca.SX, places: Sequence[int], values: int) -> ca.SX:
    """Return some of the values of a function, a column.

    Parameters
    ----------
    number : casadi.SX
        Number of the function.
    arguments : casadi.SX
        A column; the largest float where any number will do.
    places : sequence of int
        Which values.
    values : int
        How many the function has.
    """
    function, given = _function(arguments.numel(), values), scalars(arguments)
    return stacked([function(number, place, *given) for place in places])
