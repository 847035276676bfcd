"""The journal of a study: measurements written to disk at once, so that an interrupted study can continue."""

from __future__ import annotations

import hashlib
import importlib.metadata
import json
import os
import sys
from collections.abc import Iterable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from acausal.errors import DeclarationError, ExportError
from acausal.flatten.component_tree import join, walk
from acausal.language.component import Component
from acausal.language.data import plain
from acausal.language.fields import Structural
from acausal.result import check_writable, read_text
from acausal.result.files import whole
from acausal.study.measuring.case import Case, Measurement
from acausal.study.measuring.run_function import files_of

# Name of the entry of a line that holds the key of its case.
POINT = "point"
# Types of the other entries of a line, except the arrays.
KINDS = {
    f.name: {str: (str,), int: (int,), float: (int, float)}[type(f.default)]
    for f in fields(Measurement)
    if isinstance(f.default, str | int | float)
}


class Journal:
    """Measurements by the key of their case, a line of JSON each.

    Parameters
    ----------
    path : str, Path or None
        Name of the file; None for no journal.
    identity : mapping
        Common data of all cases; a journal of another identity is refused.
    """

    def __init__(self, path: str | Path | None, identity: Mapping[str, Any]) -> None:
        self.path: Path | None = None
        self._found: dict[str, dict[str, Any]] = {}
        if path is None:
            return
        check_writable(path)
        self.path = Path(path).expanduser()
        if self.path.exists() and not self.path.is_file():
            raise ExportError(f"a study cannot keep its cases in {self.path}: it is a device or a pipe; name a file.")
        lines = _lines(self.path) if self.path.exists() else []
        if lines:
            self._load(lines, dict(identity))
        else:
            self._write(dict(identity))

    def __len__(self) -> int:
        return len(self._found)

    def get(self, case: Case) -> Measurement | None:
        """Return the measurement of an earlier session, None if there is none.

        Parameters
        ----------
        case : Case
            A case of this session.
        """
        document = self._found.get(case.key)
        if document is None:
            return None
        values = {name: np.array(column) for name, column in document["values"].items()}
        given = {name: entry for name, entry in document.items() if name != POINT}
        return Measurement(**{**given, "case": case, "times": np.array(document["times"]), "values": values})

    def add(self, measurement: Measurement) -> None:
        """Record a measurement.

        Parameters
        ----------
        measurement : Measurement
            Measurement of a case that is not in the journal yet.
        """
        entries = {name: getattr(measurement, name) for name in KINDS}
        document = {POINT: measurement.case.key, **entries, "times": measurement.times.tolist()}
        document["values"] = {name: np.asarray(column).tolist() for name, column in measurement.values.items()}
        self._write(document)

    def remove(self) -> None:
        """Remove the file of a complete study."""
        if self.path is not None:
            self.path.unlink(missing_ok=True)

    def _load(self, lines: list[str], identity: dict[str, Any]) -> None:
        first = _read(lines[0])
        if not isinstance(first, dict) or not first.keys() & identity.keys():
            raise DeclarationError(_foreign_file(self.path))
        other = [name for name in identity if first.get(name) != json.loads(json.dumps(identity[name]))]
        if other:
            raise DeclarationError(
                f"{self.path} holds cases of another study (other {', '.join(other)}). "
                "Remove it to start again, or give the CSV file another name."
            )
        found = [line for line in map(_read, lines[1:]) if _is_measurement(line)]
        self._found = {line[POINT]: line for line in found}
        # A killed session may leave an incomplete line: its case is measured again.
        if len(found) < len(lines) - 1 and self.path is not None:
            with whole(self.path) as file:
                file.writelines(line + "\n" for line in [lines[0], *map(json.dumps, found)])

    def _write(self, document: dict[str, Any]) -> None:
        if self.path is None:
            return
        try:
            with self.path.open("a", encoding="utf-8") as file:
                file.write(json.dumps(document) + "\n")
                file.flush()
                os.fsync(file.fileno())
        except OSError as error:
            raise ExportError(f"cannot write {self.path}: {error.strerror or error}.") from None


def _lines(path: Path) -> list[str]:
    try:
        return read_text(path).splitlines()
    except DeclarationError as error:
        raise DeclarationError(_foreign_file(path) if "UTF-8" in str(error) else str(error)) from None


def _foreign_file(path: Path | None) -> str:
    return (
        f"{path} is not a journal: a study stores its finished cases in a file of this name. "
        "Move it, or give the CSV file another name."
    )


def identity(model: Component, trees: Iterable[Component], runs: Iterable[Any] = (), **options: Any) -> dict[str, Any]:
    """Return the identity of a study: version, model with a hash of its sources, and common options.

    Parameters
    ----------
    model : Component
        The model, not instantiated.
    trees : iterable of Component
        The model instantiated in every formulation.
    runs : iterable of callable or None
        Integrators of formulations.
    **options
        Common options of all cases.
    """
    classes = {cls for tree in trees for part in walk(tree) for cls in type(part).__mro__}
    files = {getattr(sys.modules.get(cls.__module__), "__file__", None) for cls in classes}
    files |= {name for run in runs for name in files_of(run)}
    digest = hashlib.sha256()
    # The file name of a script from a prompt or from standard input does not exist.
    for name in sorted(file for file in files if file and Path(file).is_file()):
        digest.update(Path(name).read_bytes())
    return {
        "version": importlib.metadata.version("acausal"),
        "model": type(model).__qualname__,
        "source": digest.hexdigest(),
        "values": _arguments(model),
        "data": _data(trees),
        **plain(options),
    }


def _arguments(value: Any) -> Any:
    """Return the arguments of a model and, recursively, of its parts."""
    if isinstance(value, Component):
        return {"": type(value).__qualname__, **{name: _arguments(v) for name, v in sorted(value._values.items())}}
    return [_arguments(v) for v in value] if isinstance(value, list | tuple) else plain(value)


def _data(trees: Iterable[Component]) -> dict[str, list[Any]]:
    """Return the data objects of the models by path, whether given directly or by a file name."""
    found: dict[str, list[Any]] = {}
    for part in (part for tree in trees for part in walk(tree)):
        for name, declared in part.fields.items():
            if isinstance(declared, Structural) and declared.cls not in (None, int, float, str, bool):
                values, value = found.setdefault(join(part._path, name), []), plain(getattr(part, name))
                values += [value] * (value not in values)
    return found


def _read(line: str) -> Any:
    try:
        return json.loads(line)
    except (ValueError, RecursionError):
        return None


def _is_measurement(line: Any) -> bool:
    """Return whether a line has all entries of a measurement, each of its type."""
    if not isinstance(line, dict) or line.keys() != {*KINDS, POINT, "times", "values"}:
        return False
    times, values = line["times"], line["values"]
    return (
        isinstance(line[POINT], str)
        and all(type(line[name]) in kinds for name, kinds in KINDS.items())
        and isinstance(values, dict)
        and all(_are_numbers(column) and len(column) == len(times) for column in (times, *values.values()))
    )


def _are_numbers(column: Any) -> bool:
    return isinstance(column, list) and all(type(number) in (int, float) for number in column)
