"""Functions that are called at events: their arguments, and their order."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import casadi as ca

from acausal.flatten.discontinuities import FunctionCall, Guard
from acausal.structure.blt import block_triangular
from acausal.symbols import scalars, stacked


@dataclass(frozen=True, eq=False)
class FunctionCalls:
    """The calls of functions in the order of data flow; in a cycle, and among others, in the order of declaration.

    Parameters
    ----------
    guards : sequence of Guard
        Event conditions.
    resolve : callable
        Returns expressions of the model as a column in x, z, parameters, time and constants.
    discretes : casadi.SX
        Discrete variables among the constants.
    """

    guards: Sequence[Guard]
    resolve: Callable[[list[ca.SX]], ca.SX]
    discretes: ca.SX

    @cached_property
    def _declared(self) -> list[tuple[int, FunctionCall, ca.SX]]:
        return [
            (k, call, self.resolve(list(call.arguments))) for k, guard in enumerate(self.guards) for call in guard.calls
        ]

    @cached_property
    def ordered(self) -> list[tuple[int, FunctionCall]]:
        """Number of the condition, and the call."""
        return [(k, call) for k, call, _ in self._in_order]

    def owners(self, pure: bool = True) -> str:
        """Return the components that call functions, pure ones or not, in the order of declaration."""
        calling = [g for g in self.guards if any(pure or not getattr(c.function, "pure", False) for c in g.calls)]
        return ", ".join(dict.fromkeys(f"`{guard.origin.path}`" for guard in calling))

    @property
    def arguments(self) -> ca.SX:
        """Arguments of all calls, a column."""
        return stacked([column for *_, column in self._in_order])

    @cached_property
    def _in_order(self) -> list[tuple[int, FunctionCall, ca.SX]]:
        discretes = scalars(self.discretes)
        source = {
            discretes[p].element_hash(): k for k, (_, call, _) in enumerate(self._declared) for p in immediate(call)
        }
        read = [{s.element_hash() for s in ca.symvar(column)} for *_, column in self._declared]
        needs = [[k, *(source[h] for h in sorted(own & source.keys()))] for k, own in enumerate(read)]
        blocks = block_triangular(needs, [(k, k) for k in range(len(needs))])
        return [self._declared[k] for block in blocks for k in block.equations]


def immediate(call: FunctionCall) -> set[int]:
    """Return the results that come out at the event of the call."""
    return set(call.results) & set(call.outputs)
