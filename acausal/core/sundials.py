"""SUNDIALS IDAS, from the library that CasADi's wheels carry."""

from __future__ import annotations

import ctypes
import os
import sys
from functools import cache
from itertools import count, takewhile
from pathlib import Path

import casadi as ca

from acausal.core.library import loaded, why_not

FILE = {"win32": "libcasadi_integrator_idas.dll", "darwin": "libcasadi_integrator_idas.dylib"}.get(
    sys.platform, "libcasadi_integrator_idas.so"
)
REMEDY = 'take method="rosenbrock" or "auto", without max_order'


@cache
def why_no_idas() -> str:
    """Return why IDAS cannot be used, empty if it can."""
    if why := why_not():
        return f"the core is missing: {why}"
    try:
        library = ctypes.CDLL(str(path()))
        # One handle resolves all names: wheels hold each library twice, under two names.
        address = [ctypes.cast(getattr(library, name), ctypes.c_void_p).value for name in _names()]
    except StopIteration:
        return f"CasADi has no {FILE} in {' or '.join(map(str, _folders()))}"
    except OSError as error:
        return f"{FILE} of CasADi cannot be loaded: {error}"
    except AttributeError as error:
        return f"{FILE} of CasADi does not export SUNDIALS 2.6, as on Windows: {error}"
    loaded().ac_ida_load((ctypes.c_void_p * len(address))(*address))
    _kept.append(library)
    return ""


def path() -> Path:
    """Return the library; raise StopIteration if there is none."""
    return next(path for folder in _folders() if (path := folder / FILE).exists())


_kept = list[ctypes.CDLL]()  # unloaded with the process only: the core keeps addresses


def _folders() -> list[Path]:
    """Return where CasADi looks for its plugins."""
    given = [Path(folder) for folder in ca.GlobalOptions.getCasadiPath().split(os.pathsep) if folder]
    return list(dict.fromkeys([*given, Path(ca.__file__).parent]))


def _names() -> list[str]:
    """Return the functions of IDAS that the core calls."""
    return [name.decode() for name in takewhile(bool, map(loaded().ac_ida_function, count()))]
