"""Pickling of models for other processes, including models of files that these cannot import."""

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
from acausal.language.pickling import deserialize, serialize
from acausal.locks import exclusive
from acausal.study.measuring.unsendable import unsendable

UNSENDABLE = (TypeError, AttributeError, ValueError, RecursionError, pickle.PicklingError)


@exclusive
def pack(model: Any, home: str = "") -> bytes:
    """Pickle a model before instantiation, or values for one.

    Classes of the user's file, and of files beside it, are pickled by value; those of packages are imported by the receiver.

    Parameters
    ----------
    model : Component or object
        An instance, such as SpinUp(omega=4).
    home : str
        Module of the class of the model; not needed for a model itself.

    Raises
    ------
    DeclarationError
        If something in it cannot be pickled, such as an open file; the message names it.
    """
    with _by_value(sys.modules[home or type(model).__module__]):
        try:
            return _sent(model)
        except UNSENDABLE as error:
            what = unsendable(model, _sends) or f"it contains an object that cannot be sent: {error}"
            name = type(model).__name__ if isinstance(model, Template) else "the given value"
            raise DeclarationError(
                f"{name} cannot be sent to the workers of a study: {what}. Give data that can be copied, such as the name of a "
                "file in place of an open file, and create the rest in equations() or in a part."
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
    """Return the model, or the values, that `pack` pickled.

    Parameters
    ----------
    data : bytes
        From `pack`.
    """
    return cloudpickle.loads(data)


class _Pickler(cloudpickle.Pickler):
    """Pickles symbols and sentinels of the language as references to the receiver's own objects."""

    def reducer_override(self, obj: Any) -> Any:
        if isinstance(obj, ca.SX):
            return deserialize, (serialize(obj),)
        if obj is MISSING:
            return "MISSING"
        return super().reducer_override(obj)


@contextmanager
def _by_value(module: ModuleType) -> Iterator[None]:
    """Pickle classes and functions of a file, and of files beside it outside packages, by value."""
    # The running script is listed under two names; cloudpickle pickles __main__ by value anyway.
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
