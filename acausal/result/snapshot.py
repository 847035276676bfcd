"""The snapshot of a result: the values of all its quantities by name, without the model."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.component_tree import join, walk
from acausal.language import fields as f
from acausal.language.component import Component, Path
from acausal.language.expression import Expr
from acausal.language.pending import reading
from acausal.result.lookup import Key, Quantity, choose, find, invalid_key, names, not_readable, parse
from acausal.result.unknown_path import unknown_path

# Number of entries that are evaluated in one call.
AT_ONCE = 2000


@dataclass
class Snapshot:
    """Every quantity of a run, in place of a bound model.

    Parameters
    ----------
    model : str
        Name of the model's class.
    quantities : dict of str to Quantity
        The readable quantities; their columns index `values`, then `constants`.
    refused : dict of str to str
        Names that cannot be read, each with the message why.
    values : array, shape (times, n)
        The columns that change with time, without duplicates.
    constants : array, shape (m,)
        The values that do not change.
    """

    model: str
    quantities: dict[str, Quantity]
    refused: dict[str, str]
    values: np.ndarray
    constants: np.ndarray
    lists: dict[str, int] = field(init=False)

    def __post_init__(self) -> None:
        self.lists = _lists([*self.quantities, *self.refused])

    @property
    def names(self) -> list[str]:
        """Paths of all quantities."""
        return list(self.quantities)

    def holds(self, path: str) -> bool:
        """Return whether a path, with or without indices at its end, names one of these quantities."""
        return (
            path in self.quantities
            or path.partition("[")[0] in self.quantities
            or path.rpartition("[")[0] in self.quantities
        )

    def joined(self, other: Snapshot) -> Snapshot:
        """Merge with another snapshot of the same run, whose names are different.

        Parameters
        ----------
        other : Snapshot
            The other snapshot, at the same times.
        """
        width, more, before = self.values.shape[1], other.values.shape[1], len(self.constants)
        quantities = {}
        for kept, own in ((self, True), (other, False)):
            for name, q in kept.quantities.items():
                varies = q.column < kept.values.shape[1]
                shifted = np.where(
                    varies, q.column + (0 if own else width), q.column + (more if own else width + before)
                )
                quantities[name] = replace(q, column=shifted)
        values = np.hstack([self.values, other.values])
        constants = np.concatenate([self.constants, other.constants])
        return Snapshot(self.model, quantities, self.refused | other.refused, values, constants)

    def evaluate(self, places: np.ndarray) -> np.ndarray:
        """Return some columns, shape (times, columns)."""
        width = self.values.shape[1]
        found = np.empty((len(self.values), len(places)))
        varies = places < width
        found[:, varies] = self.values[:, places[varies]]
        found[:, ~varies] = self.constants[places[~varies] - width]
        return found

    def find(self, key: Key) -> Quantity:
        """Return the quantity of a key.

        Raises
        ------
        DeclarationError
            If the name is unknown, or the key is an expression.
        """
        if isinstance(key, Expr):
            remedy = f"result[{key.name!r}]" if key.name in self.quantities else "result['a'] - result['b']"
            raise DeclarationError(
                f"`{key!r}` is an expression of symbols, and this result was loaded without its model: read quantities by "
                f"name and compute with the arrays, as in {remedy}; or simulate again."
            )
        if not isinstance(key, str | Path):
            raise DeclarationError(invalid_key(key))
        try:
            return self._walk(str(key))
        except LookupError:
            raise DeclarationError(unknown_path(str(key), self.names, kind=self._kind(str(key)))) from None

    def _kind(self, path: str) -> str:
        found = re.search(r" is a part \((\w+)\)", self.refused.get(path.rpartition(".")[0], ""))
        return found[1] if found else ""

    def _walk(self, path: str) -> Quantity:
        if path == "time" and path not in self.quantities:
            return Quantity("time", np.empty(1, dtype=int), (), ("s",))  # the result holds its values
        *parents, (last, indices) = parse(path)
        owner = ""
        for name, places in parents:
            owner = self._part(join(owner, name), places)
        name = join(owner, last)
        if name in self.refused:
            raise DeclarationError(self.refused[name])
        if name not in self.quantities:
            many = name in self.lists and not indices
            inside = f"{self._part(name, indices)}{'[' if many else '.'}"
            example = next((n for n in self.quantities if n.startswith(inside)), "")
            if not example:
                raise LookupError
            what = (
                f"a list of {self.lists[name]} parts; name a variable of one"
                if many
                else "a part; name one of its variables"
            )
            raise DeclarationError(f"`{path}` is {what}, such as `{example}`.")
        quantity = self.quantities[name]
        for index in indices:
            try:
                quantity = quantity[index]
            except IndexError:
                raise DeclarationError(
                    f"`{path}` does not exist: `{quantity.name}` has shape {quantity.shape}."
                ) from None
        return quantity

    def _part(self, path: str, indices: list[tuple[int, ...]]) -> str:
        """Return the path of a part, with negative indices counted from the end of its list."""
        if not indices:
            return path
        known = list(range(self.lists.get(path, 0)))
        return f"{path}[{choose(known or None, path, indices)}]"


def take_snapshot(tree: Component, evaluate: Callable[[ca.SX], np.ndarray], times: int) -> Snapshot:
    """Compute all quantities of a run as a snapshot.

    Parameters
    ----------
    tree : Component
        The bound model.
    evaluate : callable
        Function from a column of n expressions to an array of shape (times, n).
    times : int
        Number of times.
    """
    with reading():  # parts share what they observe
        found, refused = _all(tree)
    varying: list[np.ndarray] = []
    constants: list[float] = []
    known: dict[bytes, int] = {}
    places: list[int] = []
    for column in _blocks(found):
        for values in np.ascontiguousarray(np.asarray(evaluate(column), dtype=float).T):
            # Compare bytes, not numbers: a NaN equals itself then.
            constant = values[:1].tobytes() * times == values.tobytes()
            key = values[:1].tobytes() if constant else values.tobytes()
            if key not in known:
                known[key] = ~len(constants) if constant else len(varying)
                if constant:
                    constants.append(float(values[0]))
                else:
                    varying.append(values)
            places.append(known[key])
    numbers = np.array(places, dtype=int)
    numbers[numbers < 0] = len(varying) + ~numbers[numbers < 0]
    kept, first = {}, 0
    for q in found:
        kept[q.name] = Quantity(q.name, numbers[first : first + q.size], q.shape, q.units)
        first += q.size
    table = np.column_stack(varying) if varying else np.empty((times, 0))
    return Snapshot(type(tree).__name__, kept, refused, table, np.array(constants))


def _all(tree: Component) -> tuple[list[Quantity], dict[str, str]]:
    """Return all quantities of a bound model, and the messages for what cannot be read."""
    found, refused = [], {}
    for name in names(tree):
        try:
            found.append(find(tree, name))
        except DeclarationError as error:
            refused[name] = str(error)
    for component in walk(tree):
        for own, declared in component.fields.items():
            if isinstance(declared, f.Structural):
                path = join(component._path, own)
                refused[path] = not_readable(path, getattr(component, own))
    return found, refused


def _blocks(quantities: list[Quantity]) -> Iterator[ca.SX]:
    block: list[ca.SX] = []
    size = 0
    for quantity in quantities:
        block.append(quantity.column)
        size += quantity.size
        if size >= AT_ONCE:
            yield ca.vertcat(*block)
            block, size = [], 0
    if size:
        yield ca.vertcat(*block)


def _lists(paths: list[str]) -> dict[str, int]:
    """Return the number of parts of every list of parts."""
    found: dict[str, int] = {}
    for path in paths:
        owner = ""
        for segment in path.split(".")[:-1]:
            name, _, index = segment.partition("[")
            if index:
                at = join(owner, name)
                found[at] = max(found.get(at, 0), int(index[:-1]) + 1)
            owner = join(owner, segment)
    return found
