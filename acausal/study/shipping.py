"""Send a model to another process, also one of a file that the other process cannot import."""

from __future__ import annotations

import io
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import casadi as ca
import cloudpickle

from acausal.language.component import Component
from acausal.language.fields import MISSING
from acausal.language.functions import initial, time


def pack(model: Component) -> bytes:
    """Turn a model that is not built into bytes.

    Classes of a user's own file, and of files beside it, go along; those of packages are imported by the receiver.

    Parameters
    ----------
    model : Component
        An instance, such as SpinUp(omega=4).
    """
    stream = io.BytesIO()
    with _by_value(sys.modules[type(model).__module__]):
        _Pickler(stream).dump(model)
    return stream.getvalue()


def unpack(data: bytes) -> Component:
    """Return the model in this process.

    Parameters
    ----------
    data : bytes
        From `pack`.
    """
    return cloudpickle.loads(data)


class _Pickler(cloudpickle.Pickler):
    """Keeps what the other process has of its own, the same object: symbols, functions and marks of the language."""

    def reducer_override(self, obj: Any) -> Any:
        if isinstance(obj, ca.SX):
            return _expression, (ca.Function("e", [time.sx, initial.sx], [obj]).serialize(),)
        if obj is MISSING:
            return "MISSING"
        if isinstance(obj, FunctionType):
            public = getattr(sys.modules.get(obj.__module__), obj.__qualname__, None)
            if getattr(public, "__wrapped__", None) is obj:
                return getattr, (public, "__wrapped__")
        return super().reducer_override(obj)


def _expression(text: str) -> ca.SX:
    found: Any = ca.Function.deserialize(text)(time.sx, initial.sx)
    return found


@contextmanager
def _by_value(module: ModuleType) -> Iterator[None]:
    """Let classes and functions of a file, and of files beside it that are in no package, be sent as they are."""
    found = [m for m in list(sys.modules.values()) if _beside(m, module)]
    for m in found:
        cloudpickle.register_pickle_by_value(m)
    try:
        yield
    finally:
        for m in found:
            cloudpickle.unregister_pickle_by_value(m)


def _beside(module: ModuleType, main: ModuleType) -> bool:
    own, its = getattr(module, "__file__", None), getattr(main, "__file__", None)
    if not own or not its or main.__name__ == "__main__" or getattr(main, "__package__", None):
        return module is main and main.__name__ != "__main__"
    return Path(own).parent == Path(its).parent and not getattr(module, "__package__", None)
