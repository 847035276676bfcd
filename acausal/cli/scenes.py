"""Find a scene by its name or in the user's file."""

from __future__ import annotations

import inspect
import os
import re
import sys
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, TypeGuard

from acausal.cli.faults import brief, exit_error, place_in
from acausal.errors import DeclarationError
from acausal.language.component import Component, Model
from acausal.nearest import most_similar
from acausal.result import shown_name
from acausal.shadowed import shadowed

LIBRARY = "models"  # the package of scenes, an entry by name: this package does not depend on it
FORM = "a model of your own is given as path/to/file.py:ClassName."
_FILE = re.compile(r"(.+?\.py)(?::(.*))?", re.IGNORECASE | re.DOTALL)


def scenes() -> Mapping[str, type[Model]]:
    """Return the scenes of `models` by name."""
    try:
        found = getattr(import_module(LIBRARY), "SCENES", None)
    except ImportError:
        found = None
    if hidden := shadowed():
        raise DeclarationError(hidden)
    if not isinstance(found, Mapping):
        other = getattr(sys.modules.get(LIBRARY), "__file__", None)
        raise DeclarationError(
            f"the scenes are in the package `{LIBRARY}`, but {other or 'something else'} has that name; rename it, or start the "
            "command in another directory."
        )
    return found


def find_scene(name: str) -> type[Model]:
    """Return the class of a scene.

    Parameters
    ----------
    name : str
        Name of a scene of `models`, or "path/to/file.py:ClassName".

    Raises
    ------
    DeclarationError
        If there is none; the message names the most similar one.
    """
    file = _FILE.fullmatch(name)
    if file:
        return _of_file(Path(file[1]), file[2] or "")
    known = scenes()
    if name not in known:
        raise DeclarationError(_no_scene(name, list(known)))
    return known[name]


def file_of(name: str) -> str | None:
    """Return the file of a scene, None if it is one of `models`."""
    file = _FILE.fullmatch(name)
    return file[1] if file else None


def instance(cls: type[Model]) -> Model:
    """Return a model of a class.

    Parameters
    ----------
    cls : type
        The class of the scene; its constructor must need no arguments.
    """
    own = inspect.unwrap(cls.__init__)
    needed = [
        name
        for name, given in list(inspect.signature(own).parameters.items())[1:]
        if given.default is given.empty and given.kind not in (given.VAR_POSITIONAL, given.VAR_KEYWORD)
    ]
    if needed:
        code = getattr(own, "__code__", None)
        place = f"{code.co_filename}:{code.co_firstlineno}: " if code else ""
        name = needed[0]
        raise DeclarationError(
            f"{place}{cls.__name__}(...) needs `{name}`, but the command makes a model without arguments. Declare it in the "
            f"class, {name}: Scalar = parameter(...), and give it by --set {name}=VALUE; or give it a default, {name}=..."
        )
    return cls()


def _no_scene(name: str, known: list[str]) -> str:
    if not name.strip():
        return f"the name of the scene is empty. Scenes: {', '.join(known)}. {FORM[0].upper()}{FORM[1:]}"
    shown, path = shown_name(name), name.partition(":")[0]
    if os.path.isfile(f"{path}.py"):
        return f"there is no scene `{shown}`, but a file {path}.py: name its class, as in {path}.py:ClassName."
    if os.path.lexists(path) or os.sep in path or ".py" in path.lower() or ":" in name:
        return f"`{shown}` is neither a scene nor a model in a file of Python; {FORM}"
    near = most_similar(name.lower().replace("_", "-"), known, 0.5)
    remedy = f"; did you mean `{near}`?" if near else "."
    return f"there is no scene `{shown}`{remedy} Scenes: {', '.join(known)}. {FORM[0].upper()}{FORM[1:]}"


def _of_file(path: Path, name: str) -> type[Model]:
    shown = shown_name(path)
    if not os.path.lexists(path) or "\0" in str(path):
        raise DeclarationError(f"there is no file {shown}; {FORM}")
    if not os.path.isfile(path):
        what = "a directory" if os.path.isdir(path) else "not a file that can be read"
        raise DeclarationError(f"{shown} is {what}; {FORM}")
    module = _load(path.resolve())
    known = [n for n, c in vars(module).items() if _is_model(c) and c.__module__ == module.__name__]
    found = getattr(module, name, None) if name else None
    if _is_model(found) and found is not Model:
        return found
    choice = ", ".join(f"{path}:{n}" for n in known)
    if found is not None:
        raise DeclarationError(f"{name} in {shown} {_other(name, found)}")
    if not known:
        raise DeclarationError(f"{shown} has no model: derive a class from Model.")
    what = f"{shown} has no class `{shown_name(name)}`" if name else f"{shown} needs the name of a class"
    raise DeclarationError(f"{what}; its models: {choice}.")


def _other(name: str, found: Any) -> str:
    """Return why something is not the class of a model, and the remedy."""
    if found is Model:
        return "is the class from which models are derived: class MyModel(Model)."
    if isinstance(found, Model):
        return f"is an instance; give its class, {type(found).__name__}."
    if isinstance(found, type) and issubclass(found, Component):
        return f"is a part, not a Model; use it in one: class MyModel(Model), with {name.lower()} = {name}(...)."
    return f"is not a Model: class {name}(Model), with Model from acausal."


def _is_model(value: Any) -> TypeGuard[type[Model]]:
    return isinstance(value, type) and issubclass(value, Model)


def _load(path: Path) -> ModuleType:
    """Run a file as a module that can import the files beside it."""
    name = f"scene_{path.stem}"
    module = ModuleType(name)
    module.__file__ = str(path)
    try:
        text = path.read_bytes()
    except OSError as error:
        raise DeclarationError(f"cannot read {shown_name(path)}: {error.strerror or error}.") from None
    if b"\0" in text:
        raise DeclarationError(f"{shown_name(path)} is not Python text in UTF-8.")
    sys.modules[name] = module
    if str(path.parent) not in sys.path:
        sys.path.insert(0, str(path.parent))
    try:
        exec(compile(text, str(path), "exec"), vars(module))
    except KeyboardInterrupt:
        raise
    except SystemExit as error:
        raise exit_error(error, path) from None
    except BaseException as error:
        where, text = place_in(error, path) or str(path), brief(error)
        raise DeclarationError(text if text.startswith(where) else f"{where}: {text}") from error
    return module
