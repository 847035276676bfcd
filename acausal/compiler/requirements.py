"""Requirements of the components of a model on its parameters, and on its variables at the start."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.errors import AcausalError, DeclarationError, caution
from acausal.flatten.component_tree import walk
from acausal.flatten.origin import Origin, located_statements
from acausal.language.component import Component
from acausal.language.statement_kinds import error_of, misplaced_message
from acausal.language.validity_statements import Requirement
from acausal.symbols import scalars, stacked

Stated = tuple[Any, Origin]


class Requirements:
    """Requirements of the components of a bound model.

    Parameters
    ----------
    tree : Component
        The bound model.
    parameters : casadi.SX
        Its free parameters.
    """

    def __init__(self, tree: Component, parameters: ca.SX) -> None:
        self.tree, self.parameters = tree, parameters
        self._accepted: np.ndarray | None = None  # the last values that passed the check

    @cached_property
    def stated(self) -> list[Stated]:
        """All requirements with their origins, those of a component before those of its parts."""
        return statements(self.tree, "requirements", Requirement)

    @cached_property
    def _split(self) -> tuple[list[Stated], list[Stated]]:
        free = {s.element_hash() for s in scalars(self.parameters)}
        of_parameters, of_variables = [], []
        for item in self.stated:
            inside = all(s.element_hash() in free for s in ca.symvar(item[0].sx))
            if item[0].warning and not inside:
                raise DeclarationError(
                    f"{item[1]}: require(..., warning=True) takes parameters alone, and no variables."
                )
            (of_parameters if inside else of_variables).append(item)
        return of_parameters, of_variables

    @property
    def of_parameters(self) -> list[Stated]:
        """Requirements on parameters alone."""
        return self._split[0]

    @property
    def at_start(self) -> list[Stated]:
        """Requirements on variables."""
        return self._split[1]

    @cached_property
    def _call(self) -> Call:
        column = stacked([r.sx for r, _ in self.of_parameters])
        return Call(ca.Function("requirements", [self.parameters], [ca.densify(column)]))

    def check(self, values: np.ndarray) -> None:
        """Raise DeclarationError if parameters violate a requirement; warn of unusual values.

        Only requirements whose values changed since the last successful check are checked.
        """
        if not self.of_parameters:
            return
        found = self._call(values)[0].copy()
        changed = np.ones(len(found), dtype=bool) if self._accepted is None else found != self._accepted
        broken = _broken(self.of_parameters, found, changed)
        if wrong := next((text for requirement, text in broken if not requirement.warning), None):
            raise DeclarationError(wrong)
        self._accepted = found
        if unusual := list(dict.fromkeys(text for _, text in broken)):
            caution("\n".join(unusual))


def statements(tree: Component, method: str, kind: type | tuple[type, ...]) -> list[Stated]:
    """Return the statements that the components of a bound model yield in a method, with their origins."""
    found: list[Stated] = []
    for component in walk(tree):
        if getattr(type(component), method) is not getattr(Component, method):
            for statement, origin in located_statements(component, method):
                if not isinstance(statement, kind):
                    raise error_of(statement)(f"{origin}: {misplaced_message(statement, method)}")
                found.append((statement, Origin.of(component)))
    return found


def refuse(stated: list[Stated], values: np.ndarray, kind: type[AcausalError]) -> None:
    """Raise an error for the first requirement that `values` violate."""
    for _, text in _broken(stated, values, np.ones(len(values), dtype=bool)):
        raise kind(text)


def _broken(stated: list[Stated], values: np.ndarray, changed: np.ndarray) -> list[tuple[Requirement, str]]:
    """Return the violated requirements among those that changed, each with its message.

    A violation is not repeated for a part of the component that has the same value.
    """
    found, at, seen = list[tuple[Requirement, str]](), 0, list[tuple[str, Any]]()
    for requirement, origin in stated:
        own = slice(at, at := at + requirement.sx.numel())
        if not changed[own].any() or not (problem := requirement.broken(values[own])):
            continue
        what = requirement.problem, values[own].tobytes()
        if not any(origin.path.startswith(f"{path}.") and what == other for path, other in seen):
            found.append((requirement, f"{origin}: {problem}."))
        seen.append((origin.path, what))
    return found
