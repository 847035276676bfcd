"""Set parameters of a compiled model by path."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.compiler.requirements import Requirements
from acausal.errors import DeclarationError
from acausal.flatten import FlatModel
from acausal.flatten.component_tree import join, walk
from acausal.flatten.field_values import law_of_input, owner_text
from acausal.flatten.instantiate import not_settable
from acausal.flatten.numeric import misshapen, numeric
from acausal.language import fields as f
from acausal.language.driven import Driven
from acausal.language.expression import Expr
from acausal.language.external import External
from acausal.language.quantities import plain
from acausal.language.table import Table
from acausal.language.value_checks import shown
from acausal.symbols import dense, scalars, vec


class _Values(np.ndarray):
    """Values of parameters, with the tables whose numbers are among them, by their places."""

    tables: dict[int, Table | External]

    def __array_finalize__(self, of: Any) -> None:
        self.tables = getattr(of, "tables", {})


class Settable:
    """The parameters of a flat model.

    Parameters
    ----------
    flat : FlatModel
        The model.
    """

    def __init__(self, flat: FlatModel) -> None:
        self.own, self.tree = flat.parameters, flat.tree
        self.requirements = Requirements(flat.tree, flat.parameters.symbols)
        self._accepted: bytes | None = None  # the last values that passed the checks

    def values(self, changes: Mapping[str, Any] | None) -> np.ndarray:
        """Return the values of all free parameters after the changes.

        Raises
        ------
        DeclarationError
            For an unknown name, a structural parameter, a structural zero, a parameter bound to others, or a value out of
            its limits.
        """
        values = self.own.values.copy()
        if self.own.tables:
            values = values.view(_Values)
            values.tables = dict(self.own.tables)
        for path, value in (changes or {}).items():
            self._set(values, path, value)
        if (numbers := values.tobytes()) != self._accepted:
            self._check_limits(values)
            self.requirements.check(values)
            self._accepted = numbers
        return values

    def value(self, path: str) -> Any:
        """Return the value of a parameter (a number or an array), a structural parameter or an effect.

        Raises
        ------
        DeclarationError
            If the path names something else.
        """
        value: Any = self.tree
        try:
            for name in path.replace("[", ".[").split("."):
                value = value[int(name[1:-1])] if name.startswith("[") else getattr(value, name)
        except (AttributeError, IndexError, TypeError, ValueError):
            known = [*self.own.names, *self.own.structural_zeros, *self.own.bound, *self._structural_names]
            raise DeclarationError(not_settable(path, self.tree, known)) from None
        if not isinstance(value, Expr):
            return value
        known = {s.element_hash() for s in scalars(self.own.symbols)}
        if any(s.element_hash() not in known for s in ca.symvar(value.sx)):
            raise DeclarationError(f"`{path}` is a variable; read its values with result[{path!r}].")
        found = Call(ca.Function("value", [self.own.symbols], [ca.densify(value.sx)]))(self.values(None))[0]
        return found.reshape(value.shape, order="F").copy() if value.shape else float(found[0])

    def _set(self, values: Any, path: str, value: Any) -> None:
        """Set the entries of one parameter in the array of all values."""
        if path in self._tables:
            self._set_table(values, path, value)
            return
        _check_kind(path, value)
        own, entries = self.own, self._entries(path)
        index = {name: k for k, name in enumerate(own.names)}
        declared = self.tree.fields.get(path)
        law = law_of_input(self.tree, path) if isinstance(declared, f.Variable) else ""
        array = numeric(plain(value, self._unit(path), f"`{path}`"), None, f"`{path}`", law)
        for name in entries:
            at = tuple(int(k) for k in name[len(path) + 1 : -1].split(",")) if name != path else ()
            if (
                len(at) != array.ndim
                or len(entries) != array.size
                or any(k >= n for k, n in zip(at, array.shape, strict=True))
            ):
                if name == path:
                    raise DeclarationError(misshapen(f"`{path}`", value, array.shape, (), law))
                raise DeclarationError(
                    f"`{path}` has entries such as {name}; a value of shape {array.shape} does not fit."
                )
            entry = float(array[at])
            if name in own.weighing and entry != values[index[name]]:
                raise DeclarationError(f"`{name}` sets nominal values, which are fixed when compiled. {_again(path)}")
            if name in index:
                values[index[name]] = entry
            elif entry != 0:
                raise DeclarationError(
                    f"`{name}` was exactly 0 when compiled and is no longer in the equations (a structural zero). "
                    f"{_again(path)}"
                )

    def is_new_law(self, path: str, value: Any) -> bool:
        """Return whether a value is the law of an input that is constant in this model."""
        declared = self.tree.fields.get(path)
        is_input = isinstance(declared, f.Variable) and declared.causality == "input"
        return is_input and isinstance(value, Table | Driven) and path not in self._tables

    def _set_table(self, values: _Values, path: str, value: Any) -> None:
        """Set the numbers of a table, of the kind that the equations have."""
        place = self._tables[path]
        known = self.own.tables[place]
        if not isinstance(value, Table):
            raise DeclarationError(f"`{path}` is {shown(value)}; it must be a Table.")
        if value.settings != known.settings:
            raise DeclarationError(
                f"`{path}` is {value!r} in place of {known!r}; kind, extrapolation and number of values are fixed when "
                f"compiled. {_again(path)}"
            )
        for own, table in self.own.tables.items():
            if table is known:
                values[own], values.tables[own] = value.number, value

    def _entries(self, path: str) -> list[str]:
        """Return the names of the entries of a parameter; raise DeclarationError if it cannot be set."""
        own, prefix = self.own, path + "["
        entries = [n for n in (*own.names, *own.structural_zeros) if n == path or n.startswith(prefix)]
        if entries:
            return entries
        if path in own.bound:
            raise DeclarationError(f"`{path}` follows {own.bound[path]}; change that, or compile with its own value.")
        if path in self._structural_names:
            raise DeclarationError(f"`{path}` is structural: it is fixed when compiled. {_again(path)}")
        known = [*own.names, *own.structural_zeros, *own.bound, *self._structural_names]
        raise DeclarationError(not_settable(path, self.tree, known))

    def _unit(self, path: str) -> Any:
        """Return the unit of a parameter, or of one of its entries."""
        name, _, entry = path.removesuffix("]").rpartition("[") if path not in self._fields else (path, "", "")
        unit = self._fields[name].unit
        return unit[int(entry.split(",")[0])] if entry and isinstance(unit, tuple) else unit

    @cached_property
    def _tables(self) -> dict[str, int]:
        return {self.own.names[place]: place for place in self.own.tables if place not in self.own.raised}

    @cached_property
    def _fields(self) -> dict[str, Expr]:
        """Parameters and inputs of the model by path."""
        values = ((join(c._path, n), vars(c).get(n)) for c in walk(self.tree) for n in c.fields)
        return {path: value for path, value in values if isinstance(value, Expr)}

    @cached_property
    def _structural_names(self) -> set[str]:
        return {join(c._path, n) for c in walk(self.tree) for n, d in c.fields.items() if isinstance(d, f.Structural)}

    def _check_limits(self, values: np.ndarray) -> None:
        own = self.own
        if not own.limits:
            return
        call, owners, least, positive = self._limits
        found = call(values)[0]
        wrong = np.flatnonzero(~(found >= least) | (positive & ~(found > 0)))
        if wrong.size:
            path, _, declared = own.limits[owners[wrong[0]]]
            if path in own.bound:
                self.requirements.check(values)  # they know the cause, such as a wrong diameter
            bound = "greater than 0" if declared.positive else f"at least {declared.minimum:g}"
            owner = next((c for c in walk(self.tree) if c._path == path.rpartition(".")[0]), self.tree)
            where = f" of {owner_text(owner)}" if owner._path else ""
            raise DeclarationError(
                f"`{path}` ({declared.description}){where} is {found[wrong[0]]:g}; it must be {bound}."
            )

    @cached_property
    def _limits(self) -> tuple[Call, np.ndarray, np.ndarray, np.ndarray]:
        """The limited entries as a function of the parameters; for each its owner, minimum, and whether it must be positive."""
        own = self.own
        column = ca.vertcat(*[dense(vec(sx)) for _, sx, _ in own.limits])
        owners = np.repeat(np.arange(len(own.limits)), [sx.numel() for _, sx, _ in own.limits])
        least = np.array([-np.inf if d.minimum is None else d.minimum for _, _, d in own.limits])[owners]
        positive = np.array([d.positive for _, _, d in own.limits])[owners]
        return Call(ca.Function("limits", [own.symbols], [column])), owners, least, positive


def _check_kind(path: str, value: Any) -> None:
    """Raise DeclarationError for a value that is an expression, a quantity or a dictionary."""
    if isinstance(value, Expr):
        what = f"{value!r}, an expression; a compiled model takes numbers"
        remedy = f"a quantity; give the number alone, in SI units: {{{path!r}: {value!r}}}"
        raise DeclarationError(f"`{path}` is {remedy if value.sx.is_constant() else what}.")
    if isinstance(value, Mapping):
        inner = next(iter(value), "m")
        raise DeclarationError(f'`{path}` is {value!r}; write the whole path of each value: {{"{path}.{inner}": ...}}.')


def _again(path: str) -> str:
    return f"Compile again with it: ac.compile(model, parameters={{{path!r}: ...}})."
