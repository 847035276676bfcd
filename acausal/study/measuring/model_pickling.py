"""Send a model to another process, also one of a file that the other process cannot import."""

from __future__ import annotations

import io
import pickle
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import casadi as ca
import cloudpickle

from acausal.errors import DeclarationError
from acausal.language.fields import MISSING, Template
from acausal.language.shipped import symbols, text
from acausal.locks import alone
from acausal.study.measuring.unsendable import unsendable

UNSENDABLE = (TypeError, AttributeError, ValueError, RecursionError, pickle.PicklingError)


@alone
def pack(model: Any, home: str = "") -> bytes:
    """Turn a model that is not built, or values that are given to one, into bytes.

    Classes of a user's own file, and of files beside it, go along; those of packages are imported by the receiver.

    Parameters
    ----------
    model : Component or object
        An instance, such as SpinUp(omega=4).
    home : str
        Module of the class of the model; not needed for a model itself.

    Raises
    ------
    DeclarationError
        If something in it cannot be sent, such as an open file; by its name.
    """
    with _by_value(sys.modules[home or type(model).__module__]):
        try:
            return _sent(model)
        except UNSENDABLE as error:
            what = unsendable(model, _sends) or f"it holds what cannot be sent: {error}"
            name = type(model).__name__ if isinstance(model, Template) else "what is given"
            raise DeclarationError(
                f"{name} cannot be sent to the workers of a study: {what}. Give what can be copied, such as the name of a file "
                "in place of an open one, and make the rest from it in equations() or in a part."
            ) from None


def _sent(value: Any) -> bytes:
    stream = io.BytesIO()
    _Pickler(stream).dump(value)
    return stream.getvalue()


def _sends(value: Any) -> bool:
    try:
        _sent(value)
    except UNSENDABLE:
        return False
    return True


def unpack(data: bytes) -> Any:
    """Return the model, or the values, in this process.

    Parameters
    ----------
    data : bytes
        From `pack`.
    """
    return cloudpickle.loads(data)


class _Pickler(cloudpickle.Pickler):
    """Keeps what the other process has of its own, the same object: symbols and marks of the language."""

    def reducer_override(self, obj: Any) -> Any:
        if isinstance(obj, ca.SX):
            return symbols, (text(obj),)
        if obj is MISSING:
            return "MISSING"
        return super().reducer_override(obj)


@contextmanager
def _by_value(module: ModuleType) -> Iterator[None]:
    """Let classes and functions of a file, and of files beside it that are in no package, be sent as they are."""
    # The script that runs is in the list under two names, and is sent as it is in any case.
    found = {m.__name__: m for m in list(sys.modules.values()) if _beside(m, module) and m.__name__ in sys.modules}
    found.pop("__main__", None)
    for m in found.values():
        cloudpickle.register_pickle_by_value(m)
    try:
        yield
    finally:
        for m in found.values():
            cloudpickle.unregister_pickle_by_value(m)


def _beside(module: ModuleType, main: ModuleType) -> bool:
    own, its = getattr(module, "__file__", None), getattr(main, "__file__", None)
    if not own or not its or getattr(main, "__package__", None):
        return module is main
    return Path(own).parent == Path(its).parent and not getattr(module, "__package__", None)
