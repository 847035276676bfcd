"""Table of all parts with summary, domains and ports, read from their classes."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType

from acausal import Component, Connector, Record


@dataclass(frozen=True)
class Entry:
    """A part: its name in `components`, class, summary line, domains, and ports with their connectors."""

    name: str
    cls: type[Component]
    line: str
    domain: str
    ports: dict[str, str]

    def __str__(self) -> str:
        return f"{self.name}: {self.line}\n    {self.shown_ports()}"

    def shown_ports(self) -> str:
        """Ports grouped by kind: `flange_a, flange_b: Flange; tau: input in N.m`."""
        kinds = dict.fromkeys(self.ports.values())
        return "; ".join(f"{', '.join(n for n, k in self.ports.items() if k == kind)}: {kind}" for kind in kinds)


class Table(tuple[Entry, ...]):
    """Parts, printed by domain, and displayed as a table in notebooks."""

    __slots__ = ()

    def __repr__(self) -> str:
        domains = dict.fromkeys(entry.domain for entry in self)
        blocks = ["\n".join([domain, *(str(e) for e in self if e.domain == domain)]) for domain in domains]
        return "\n\n".join(blocks)

    def _repr_html_(self) -> str:
        rows = [("part", "summary", "domain", "ports")]
        rows += [(e.name, e.line, e.domain, e.shown_ports()) for e in self]
        cells = ["".join(f"<td>{escape(text)}</td>" for text in row) for row in rows]
        return f"<table>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"


def table(word: str = "") -> Table:
    """Return all parts exported by `components` and its packages, without connectors, records and bases.

    Parameters
    ----------
    word : str
        Select parts whose name or domain contains it, such as "rotational" or "spring".
    """
    found: dict[type, str] = {}
    for prefix, package in _packages():
        for name in package.__all__:
            cls = getattr(package, name)
            if inspect.isclass(cls) and issubclass(cls, Component) and not issubclass(cls, Connector | Record):
                found.setdefault(cls, prefix + name)
    entries = [Entry(name, cls, _line(cls), _domain(cls), _ports(cls)) for cls, name in found.items()]
    selected = [e for e in entries if not e.line.startswith("Base") and word.lower() in f"{e.name} {e.domain}".lower()]
    return Table(sorted(selected, key=lambda e: (e.domain, e.name)))


def _packages() -> Iterator[tuple[str, ModuleType]]:
    """Yield `components` and its packages, each with the prefix of its names."""
    top = import_module("components")
    yield "", top
    for module in iter_modules(top.__path__):
        if module.ispkg:
            yield f"{module.name}.", import_module(f"components.{module.name}")


def _line(cls: type) -> str:
    """Return the first line of the docstring, which begins with "Base" for base classes."""
    return (inspect.getdoc(cls) or "").partition("\n")[0]


def _domain(cls: type[Component]) -> str:
    """Return the domains of the mandatory ports, or of the optional ports if there are no others."""
    connectors = [d.connector for d in cls.fields.values() if d.connector]
    always = [text for text in connectors if not text.endswith("optional")] or connectors
    known = {kind.__name__: kind.domain for kind in _subclasses(Connector) if hasattr(kind, "domain")}
    domains = [known[word] for text in always for word in re.findall(r"\w+", text) if word in known]
    return ", ".join(sorted(set(domains))) or "signal"


def _subclasses(cls: type) -> Iterator[type]:
    for below in cls.__subclasses__():
        yield below
        yield from _subclasses(below)


def _ports(cls: type[Component]) -> dict[str, str]:
    """Return connectors, inputs and outputs by name."""
    ports = {name: d.connector for name, d in cls.fields.items() if d.connector}
    for name, d in cls.fields.items():
        causality = getattr(d, "causality", "")
        if causality in ("input", "output"):
            ports[name] = f"{causality} in {d.unit}" if isinstance(d.unit, str) and d.unit != "1" else causality
    return ports
