"""Lookup of quantities: from a key (path, attribute or expression) to the symbols of the bound model."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Any, Protocol

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.component_tree import join, walk
from acausal.language import fields as f
from acausal.language.component import Component, Path
from acausal.language.expression import Equation, Expr
from acausal.language.functions import time
from acausal.language.value_checks import shown, shown_or_kind
from acausal.result.unknown_path import unknown_path
from acausal.symbols import vec

Key = str | Path | Expr
READABLE = (f.Variable, f.Parameter, f.Observed)
_SEGMENT = re.compile(r"([^\W\d]\w*)((?:\[[^\]]*\])*)")
_INDEX = re.compile(r"\[\(?\s*(-?\d{1,9}(?:\s*,\s*-?\d{1,9})*)\s*,?\s*\)?\]")


@dataclass(frozen=True, eq=False)
class Quantity:
    """A quantity of a result.

    Parameters
    ----------
    name : str
        Name as the user writes it.
    column : casadi.SX, shape (n, 1), or array of int, shape (n,)
        The entries in column-major order: expressions, or columns of a snapshot.
    shape : tuple of int
        Shape as in numpy.
    units : tuple of str
        Declared unit of each entry, "" if unknown.
    declared : bool
        Whether the name alone determines the expression.
    """

    name: str
    column: Any
    shape: tuple[int, ...]
    units: tuple[str, ...]
    declared: bool = True

    def __getitem__(self, index: tuple[int, ...]) -> Quantity:
        places = np.arange(len(self.units)).reshape(self.shape, order="F")
        at = np.asarray(places[index])
        picked = at.ravel(order="F").tolist()
        name = f"{self.name}[{','.join(map(str, index))}]"
        return Quantity(name, self.column[picked], at.shape, tuple(self.units[k] for k in picked))

    @property
    def size(self) -> int:
        """Number of entries."""
        return int(np.prod(self.column.shape))

    @property
    def entries(self) -> list[tuple[tuple[int, ...], str, str]]:
        """Index, name and unit of each entry, the last index varying fastest."""
        units = np.array(self.units, dtype=object).reshape(self.shape, order="F")
        return [
            (i, self.name + (f"[{','.join(map(str, i))}]" if i else ""), str(units[i])) for i in np.ndindex(self.shape)
        ]


class Catalogue(Protocol):
    """The readable quantities of a result without a bound model."""

    @property
    def names(self) -> list[str]:
        """Paths of all quantities."""
        ...

    def find(self, key: Key) -> Quantity:
        """Return the quantity of a key."""
        ...


Tree = Component | Catalogue


def names(tree: Tree) -> list[str]:
    """Return the paths of all variables, parameters and observed quantities of a bound model."""
    if not isinstance(tree, Component):
        return list(tree.names)
    return [
        join(component._path, name)
        for component in walk(tree)
        for name, declared in component.fields.items()
        if isinstance(declared, READABLE) and (name in vars(component) or isinstance(declared, f.Observed))
    ]


def match(tree: Tree, patterns: Iterable[str]) -> list[str]:
    """Return the names that match a pattern, in the order of the model.

    Parameters
    ----------
    tree : Component or Catalogue
        The bound model, or the catalogue of a loaded result.
    patterns : iterable of str
        Paths in which `*` stands for any text and `?` for any character; brackets are literal.

    Raises
    ------
    DeclarationError
        If a pattern matches nothing.
    """
    known, found = names(tree), {}
    for pattern in patterns:
        if not isinstance(pattern, str):
            raise DeclarationError(invalid_key(pattern))
        # Brackets are indices here, not fnmatch's character sets.
        matched = [name for name in known if fnmatchcase(name, pattern.replace("[", "[[]"))]
        if not matched and ("*" in pattern or "?" in pattern):
            raise DeclarationError(f"no variable of the model matches `{pattern}`; * stands for any text.")
        found.update(dict.fromkeys(matched or [find(tree, pattern).name]))
    return list(found)


def find(tree: Tree, key: Key) -> Quantity:
    """Return the quantity of a key.

    Raises
    ------
    DeclarationError
        If the model has no such variable; the message names the nearest ones.
    """
    if not isinstance(tree, Component):
        return tree.find(key)
    if isinstance(key, Expr):
        return _of_expression(tree, key)
    if not isinstance(key, str | Path):
        raise DeclarationError(invalid_key(key))
    try:
        return _walk(tree, str(key))
    except LookupError:
        raise DeclarationError(unknown_path(str(key), names(tree), tree)) from None


def _of_expression(tree: Component, expr: Expr) -> Quantity:
    column = vec(ca.densify(expr.sx))
    try:
        declared = _walk(tree, expr.name)
        if _symbols(declared.column) == _symbols(column):
            return declared
    except (LookupError, DeclarationError):
        pass  # a derivative or another expression
    return Quantity(expr.name or repr(expr), column, expr.shape, _units(expr.unit, expr), declared=False)


def _symbols(column: ca.SX) -> list[int]:
    return [column[k].element_hash() for k in range(column.numel())]


def _walk(tree: Component, path: str) -> Quantity:
    """Follow a path; raise LookupError if it does not exist."""
    if path == "time" and path not in tree.fields:
        return Quantity("time", time.sx, (), ("s",))
    owner: Any = tree
    *parents, (last, indices) = parse(path)
    for name, places in parents:
        owner = choose(_member(owner, name), name, places)
    value = _member(owner, last)
    declared = owner.fields[last]
    if not isinstance(declared, READABLE):
        raise DeclarationError(not_readable(path, choose(value, last, indices)))
    quantity = quantity_of(owner, last, declared, value)
    for index in indices:
        try:
            quantity = quantity[index]
        except IndexError:
            raise DeclarationError(f"`{path}` does not exist: `{quantity.name}` has shape {quantity.shape}.") from None
    return quantity


def parse(path: str) -> list[tuple[str, list[tuple[int, ...]]]]:
    """Split a path into names with their indices."""
    steps = []
    for segment in path.split("."):
        found = _SEGMENT.fullmatch(segment.strip())
        texts = re.findall(r"\[[^\]]*\]", found[2]) if found else []
        indices = [_INDEX.fullmatch(text) for text in texts]
        if found is None or None in indices:
            raise LookupError
        steps.append((found[1], [tuple(int(k) for k in index[1].split(",")) for index in indices if index]))
    return steps


def choose(value: Any, name: str, indices: list[tuple[int, ...]]) -> Any:
    """Return the part at the given indices of a list of parts."""
    for index in indices:
        if not isinstance(value, list):
            raise LookupError
        if not -len(value) <= index[0] < len(value):
            raise DeclarationError(f"`{name}[{index[0]}]` does not exist: `{name}` has {len(value)} parts, from 0.")
        value = value[index[0]]
    return value


def _member(owner: Any, name: str) -> Any:
    if not isinstance(owner, Component) or name not in owner.fields:
        raise LookupError
    observed = isinstance(owner.fields[name], f.Observed)
    value = getattr(owner, name) if observed else vars(owner).get(name)
    if value is None and not isinstance(owner.fields[name], f.Structural):
        raise LookupError
    return value


def quantity_of(owner: Component, name: str, declared: f.Field, expr: Expr) -> Quantity:
    """Return a member of a bound component as a quantity.

    Parameters
    ----------
    owner : Component
        The component.
    name : str
        The member.
    declared : Field
        Its declaration.
    expr : Expr
        Its value.
    """
    unit = declared.unit(owner) if callable(declared.unit) else declared.unit
    units = _units(expr.unit if unit is None else unit, expr)
    return Quantity(join(owner._path, name), vec(ca.densify(expr.sx)), expr.shape, units)


def _units(unit: Any, expr: Expr) -> tuple[str, ...]:
    """Return the unit of each entry; a unit given per row applies to all columns."""
    rows, columns = expr.sx.shape
    if unit is None:
        return ("",) * (rows * columns)
    each = list(unit) if isinstance(unit, list | tuple) else [unit] * rows
    return tuple(str(u) or "1" for u in each) * columns


def check_columns(tree: Tree, keys: Iterable[Key]) -> None:
    """Raise DeclarationError if a column of a table would have the name of the time column.

    Parameters
    ----------
    tree : Component or Snapshot
        As in a result.
    keys : iterable of str, Path or Expr
        The other columns.
    """
    if has_time(tree) and any(find(tree, key).name.partition("[")[0] == "time" for key in keys):
        raise DeclarationError(
            "a table cannot hold the variable `time`: its first column has that name. Rename the variable of the model, for "
            "instance to `clock`."
        )


def has_time(tree: Any) -> bool:
    """Return whether the model itself declares a quantity named `time`."""
    return "time" in (tree.fields if isinstance(tree, Component) else tree.quantities)


def not_readable(path: str, value: Any) -> str:
    """Return the message for a member that does not vary with time."""
    if isinstance(value, list):
        return (
            f"`{path}` is a list of {len(value)} parts; name a variable of one, such as `{path}[0].{_example(value)}`."
        )
    if isinstance(value, Component):
        kind = type(value).__name__
        return f"`{path}` is a part ({kind}); name one of its variables, such as `{path}.{_example([value])}`."
    return f"`{path}` is structural and does not vary with time; its value is {shown_or_kind(value)}."


def _example(parts: list[Component]) -> str:
    inside = [name for part in parts[:1] for name in names(part)]
    return inside[0].removeprefix(f"{parts[0]._path}.") if inside else "..."


def invalid_key(key: object) -> str:
    """Return the message for a key that is not a path."""
    text = shown(key)
    for kind, word in ((f.Field, "a field of the class"), (Equation, "an equation")):
        text = word if isinstance(key, kind) else text
    remedy = "; give several one by one." if isinstance(key, list | tuple | set) else "."
    return f"a result is read by a path such as 'beam.frame_b.r_0', not by {text}{remedy}"
