"""Find and load the library, without which nothing is integrated."""

from __future__ import annotations

import ctypes
import os
from ctypes import CFUNCTYPE, POINTER, Structure, byref, c_char_p, c_double, c_int32, c_int64, c_size_t, c_void_p
from functools import cache

import numpy as np

from acausal.core.build.compiling import file_of, own_platform, version

# What switches the library off for runs: whatever it holds, unless it is empty.
WITHOUT = "ACAUSAL_WITHOUT_CORE"
MEND = "with a C compiler or the package ziglang, `python -m acausal.core.build` makes it"


class TapeData(Structure):
    """What the library takes as a tape, see `core.h`."""

    _fields_ = (
        *((name, c_int32) for name in ("constants", "inputs", "results", "runs", "early", "outputs")),
        *((name, c_void_p) for name in ("constant", "kind", "length", "first", "second", "output", "tables")),
    )


class TablesData(Structure):
    """Columns that equations look up, see `core.h`."""

    _fields_ = (("count", c_int32), ("column", c_void_p))


class OperationsData(Structure):
    """What the library takes as the operations of a function, see `core.h`."""

    _fields_ = (("n", c_int32), *((name, c_void_p) for name in ("kind", "first", "second", "late")))


class ArrangedData(Structure):
    """Where the library writes what becomes of them."""

    _fields_ = (
        *((name, c_int32) for name in ("results", "runs", "early")),
        *((name, c_void_p) for name in ("same", "order", "run_kind", "run_length")),
    )


class SquareData(Structure):
    """What the library takes as equations with as many unknowns, see `core.h`."""

    _fields_ = (
        ("n", c_int32),
        ("tape", POINTER(TapeData)),
        *((name, c_void_p) for name in ("start", "row", "unknown")),
    )


# Calls a function at an event: number of the call, and time; returns whether it fails.
CALL = CFUNCTYPE(c_int32, c_int32, c_double)

# Result and arguments of each function; arrays are addresses.
FUNCTIONS = {
    "ac_version": (c_char_p, ()),
    "ac_arrange": (c_int32, (POINTER(OperationsData), POINTER(ArrangedData))),
    "ac_tape_run": (None, (POINTER(TapeData), c_void_p, c_int32, c_int32)),
    "ac_tape_rows": (None, (POINTER(TapeData), c_void_p, c_int32, c_int32, c_void_p, c_void_p, c_void_p, c_void_p)),
    "ac_share_tables": (None, (POINTER(TablesData),)),
    "ac_casadi_call_rows": (None, (c_int32,)),
    "ac_fmu_value": (c_double, (c_void_p, c_int32)),
    "ac_fmu_completed": (c_int32, (c_void_p,)),
    "ac_history_make": (c_void_p, ()),
    "ac_history_begin": (c_int32, (c_void_p, c_double, c_double)),
    "ac_history_free": (None, (c_void_p,)),
    "ac_run_externals": (None, (c_void_p, c_int32, c_void_p)),
    "ac_lu_make": (c_void_p, (c_int32, c_void_p, c_void_p)),
    "ac_lu_factor": (c_int32, (c_void_p, c_void_p)),
    "ac_lu_solve": (None, (c_void_p, c_void_p)),
    "ac_lu_counts": (None, (c_void_p, POINTER(c_int64))),
    "ac_lu_free": (None, (c_void_p,)),
    "ac_settler_make": (c_void_p, (POINTER(SquareData),)),
    "ac_settle_rows": (c_int64, (c_void_p, *[c_int32] * 3, *[c_void_p] * 4, c_double, *[c_void_p] * 2)),
    "ac_settler_least": (c_double, (c_void_p,)),
    "ac_settler_renew": (None, (c_void_p,)),
    "ac_settler_free": (None, (c_void_p,)),
    "ac_ida_function": (c_char_p, (c_int32,)),
    "ac_ida_load": (None, (c_void_p,)),
    "ac_unit_read": (c_void_p, (c_char_p, c_size_t, POINTER(c_int32))),
    "ac_unit_free": (None, (c_void_p,)),
    "ac_instance_make": (c_void_p, (c_void_p,)),
    "ac_instance_free": (None, (c_void_p,)),
    "ac_message": (c_char_p, (c_void_p,)),
    "ac_redundant_laws": (None, (c_void_p, c_void_p)),
    "ac_run_begin": (c_int32, (c_void_p, c_void_p, c_double, *[c_void_p] * 5)),
    "ac_run_go": (c_int32, (c_void_p, c_void_p, c_void_p)),
    "ac_run_happen": (c_int32, (*[c_void_p] * 5, POINTER(c_int32))),
    "ac_run_functions": (None, (c_void_p, CALL, c_void_p, c_void_p)),
    "ac_run_values": (None, (c_void_p,) * 6),
    "ac_run_undefined": (c_double, (c_void_p,) * 3),
}


@cache
def _loaded() -> ctypes.CDLL | str:
    """The library, or why runs do without."""
    return f"it is switched off by {WITHOUT}" if os.environ.get(WITHOUT) else _installed()


@cache
def _installed() -> ctypes.CDLL | str:
    """The library, or why there is none."""
    path = file_of(platform := own_platform())
    if not path.exists():
        return f"it was not built for {platform}; {MEND}"
    try:
        found = ctypes.CDLL(str(path))
        for name, (result, arguments) in FUNCTIONS.items():
            function = getattr(found, name)
            function.restype, function.argtypes = result, arguments
    except (OSError, AttributeError) as error:
        return f"it cannot be loaded: {error}; {MEND}"
    if found.ac_version() != version().encode():
        return f"{path.name} was built from other sources; {MEND}"
    return found


def why_not(runs: bool = True) -> str:
    """Return why there is no library, or why runs do without, as `loaded`; empty where there is one."""
    found = _loaded() if runs else _installed()
    return found if isinstance(found, str) else ""


def address(array: np.ndarray | None) -> int | None:
    """Return where the numbers of an array stand, as the library takes it; in half the time of `array.ctypes.data`."""
    return None if array is None else array.__array_interface__["data"][0]


def loaded(runs: bool = True) -> ctypes.CDLL:
    """Return the library.

    Parameters
    ----------
    runs : bool, optional
        Whether it is to run something, for which it may be switched off; what is exported is made by it in any case.

    Raises
    ------
    RuntimeError
        If there is none.
    """
    found = _loaded() if runs else _installed()
    if isinstance(found, str):
        raise RuntimeError(f"the core cannot be used: {found}")
    return found


class Pool:
    """Memory of the library for some equations: what nothing uses any more is kept for what needs some next.

    In runs of a few milliseconds making it, and choosing pivots that were chosen for the same values before, takes some per cent.

    Parameters
    ----------
    kind : str
        What it is for, as in the names of the functions that make, renew and free it.
    data : Structure
        What the library takes as the equations.
    """

    def __init__(self, kind: str, data: Structure) -> None:
        self._make, self._renew, self._free = (
            getattr(loaded(), f"ac_{kind}_{what}") for what in ("make", "renew", "free")
        )
        self._data, self._idle = data, list[int]()

    def take(self) -> int:
        """Return the address of some for one use at a time: nothing that is found with it depends on the use before."""
        try:
            found = self._idle.pop()  # at once, whatever other threads do
        except IndexError:
            if found := self._make(byref(self._data)):
                return found
            raise MemoryError from None
        self._renew(found)
        return found

    def give(self, memory: int) -> None:
        """Take it back."""
        self._idle.append(memory)

    def __del__(self) -> None:
        for memory in getattr(self, "_idle", ()):
            self._free(memory)
