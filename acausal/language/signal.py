"""Signals: inputs and outputs in connections(), before variables exist, and their connections."""

from __future__ import annotations

from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any

# True while connections() of components run.
CONNECTING: ContextVar[bool] = ContextVar("connecting", default=False)


@dataclass(frozen=True, eq=False)
class Signal:
    """An input or output of a built component."""

    owner: Any
    name: str
    causality: str

    def __repr__(self) -> str:
        return f"{self.owner._path}.{self.name}" if self.owner._path else self.name

    def value(self) -> Any:
        """Return the variable, once it exists."""
        return getattr(self.owner, self.name)


@dataclass(frozen=True, eq=False)
class Wire:
    """Connection of an output and an input."""

    a: Any
    b: Any
