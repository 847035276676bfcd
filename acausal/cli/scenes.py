"""Find a scene by its name or in the user's file, and read the values given to it."""

from __future__ import annotations

import ast
import difflib
import sys
import traceback
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, TypeGuard

from acausal.errors import AcausalError, DeclarationError
from acausal.language.component import Model


def scenes() -> Mapping[str, type[Model]]:
    """Return the scenes of `models` by name."""
    from models import SCENES

    return SCENES


def find_scene(name: str) -> type[Model]:
    """Return the class of a scene.

    Parameters
    ----------
    name : str
        Name of a scene of `models`, or "path/to/file.py:ClassName".

    Raises
    ------
    DeclarationError
        If there is none; the message names the nearest ones.
    """
    path, _, cls = name.rpartition(":") if ".py:" in name else (name, "", "")
    if path.endswith(".py"):
        return _of_file(Path(path), cls)
    known = scenes()
    if name not in known:
        near = difflib.get_close_matches(name.lower().replace("_", "-"), known, 1, 0.5)
        mend = f"did you mean `{near[0]}`? " if near else ""
        raise DeclarationError(
            f"there is no scene `{name}`; {mend}Scenes: {', '.join(known)}. "
            "A model of your own is given as path/to/file.py:ClassName."
        )
    return known[name]


def place_in(error: BaseException, path: Path) -> str:
    """Return "file:line" of the innermost line of a file in an error's traceback, "" if there is none."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return f"{path}:{error.lineno}"
    lines = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == str(path)]
    return f"{path}:{lines[-1]}" if lines else ""


def ended(error: SystemExit, path: Path) -> DeclarationError:
    """Return the error for a file that exits while it is read."""
    return DeclarationError(
        f"{place_in(error, path) or path}: the file ends the program here (SystemExit: {error.code}), but it should "
        'only define a model. Put code that runs, sys.exit included, under `if __name__ == "__main__":`.'
    )


def brief(error: BaseException) -> str:
    """Return kind and first line of an error."""
    if isinstance(error, AcausalError):
        return str(error)
    text = error.msg if isinstance(error, SyntaxError) else str(error)
    return f"{type(error).__name__}: {(text.splitlines() or [''])[0]}"


def read_settings(texts: Iterable[str]) -> dict[str, Any]:
    """Read NAME=VALUE pairs.

    Parameters
    ----------
    texts : iterable of str
        VALUE is a number, a word (fem, true, false, None) or a tuple such as 0,0,1.

    Raises
    ------
    DeclarationError
        If a text is not such a pair.
    """
    values: dict[str, Any] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise DeclarationError(f"--set takes NAME=VALUE, such as --set omega=4 or --set beam.E=7e10, not `{text}`.")
        values[name] = _value(value)
    return values


def _value(text: str) -> Any:
    if text.lower() in ("true", "false"):
        return text.lower() == "true"
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        pass
    try:
        return float(text)
    except ValueError:
        return text


def _of_file(path: Path, name: str) -> type[Model]:
    if not path.is_file():
        raise DeclarationError(f"there is no file {path}; a model of your own is given as path/to/file.py:ClassName.")
    module = _load(path.resolve())
    known = {n: c for n, c in vars(module).items() if _is_model(c) and c.__module__ == module.__name__}
    cls = getattr(module, name, None) if name else None
    if _is_model(cls):
        return cls
    if cls is not None:
        raise DeclarationError(f"{name} in {path} is not a Model: class {name}(Model), with Model from acausal.")
    choice = ", ".join(f"{path}:{n}" for n in known) or "none; derive a class from Model"
    what = f"{path} has no class `{name}`" if name else f"{path} needs the name of a class"
    raise DeclarationError(f"{what}; its models: {choice}.")


def _is_model(value: Any) -> TypeGuard[type[Model]]:
    return isinstance(value, type) and issubclass(value, Model)


def _load(path: Path) -> ModuleType:
    """Run a file as a module that can import the files beside it."""
    name = f"scene_{path.stem}"
    module = ModuleType(name)
    module.__file__ = str(path)
    sys.modules[name] = module
    if str(path.parent) not in sys.path:
        sys.path.insert(0, str(path.parent))
    try:
        exec(compile(path.read_bytes(), str(path), "exec"), vars(module))
    except Exception as error:
        raise DeclarationError(f"{place_in(error, path) or path}: {brief(error)}") from error
    except SystemExit as error:
        raise ended(error, path) from None
    return module
