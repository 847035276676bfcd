"""Connection graph: connection sets, flow balances, spanning tree, cuts and roots."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any

from acausal.errors import ConnectError
from acausal.flatten.origin import Origin, entries, method_origin, with_place
from acausal.flatten.spanning_tree import Cut, spanning_tree
from acausal.language.component import Component, Connector
from acausal.language.connection import Branch, Connect, Root
from acausal.language.signal import CONNECTING, Wire
from acausal.language.source_code import calls
from acausal.language.statement_kinds import misplaced_message, returned_message

# The connectors of a connection set with their signs, -1 for an outside connector.
Balance = tuple[tuple[Connector, int], ...]


@dataclass(frozen=True)
class Graph:
    """Evaluated connections of a model.

    Parameters
    ----------
    same : list of tuple of Connector
        Connectors with common potentials.
    balances : list of tuple of (Connector, int)
        Connection sets: the signed flows of each sum to zero.
    cuts : list of Cut
        Connections that close a loop and keep the residual of an over-determined record.
    roots : list of Connector
        Chosen potential roots.
    unconnected : tuple of str
        Unconnected ports of parts.
    wires : list of (Component, Wire, str)
        Signal connections with their component and line.
    connects : list of (Component, Connect, str)
        Connections of ports, likewise.
    """

    same: list[tuple[Connector, ...]]
    balances: list[Balance]
    cuts: list[Cut]
    roots: list[Connector]
    unconnected: tuple[str, ...]
    wires: list[tuple[Component, Wire, str]]
    connects: list[tuple[Component, Connect, str]]


def build_graph(components: list[Component]) -> Graph:
    """Collect the statements of all connections(); return connection sets, cuts and roots."""
    connects: list[tuple[Component, Connect, str]] = []
    branches: list[Branch] = []
    roots: list[Root] = []
    wires: list[tuple[Component, Wire, str]] = []
    connectors = [c for c in components if isinstance(c, Connector)]
    own = {id(c) for c in connectors}
    for component in components:
        for statement, origin in _connecting(component):
            if isinstance(statement, Connect | Branch | Root):
                _refuse_ports_of_other_models(statement, own, origin)
            if isinstance(statement, Connect):
                connects.append((component, statement, origin.where))
            elif isinstance(statement, Wire):
                wires.append((component, statement, origin.where))
            elif isinstance(statement, Branch):
                branches.append(statement)
            elif isinstance(statement, Root):
                roots.append(statement)
            else:
                raise ConnectError(f"{origin}: {misplaced_message(statement, 'connections')}")
    _refuse_duplicates(connects)
    try:
        cuts, chosen = spanning_tree(connectors, connects, branches, roots)
    except ConnectError:
        _refuse_connections_in_equations(components)
        raise
    for cut in cuts:
        for part in cut.loop:
            part._in_loop = True
    for group in _sets(connectors, [(s.a, s.b) for _, s, _ in connects]):
        for connector in group:
            connector._set = tuple(group)
    cut_ids = {id(cut.statement) for cut in cuts}
    same = _sets(connectors, [(s.a, s.b) for _, s, _ in connects if id(s) not in cut_ids])
    order = {id(c): k for k, c in enumerate(connectors)}
    groups = [tuple(sorted(group, key=lambda c: order[id(c)])) for group in same]
    groups.sort(key=lambda group: order[id(group[0])])
    joined = {id(port) for _, statement, _ in connects for port in (statement.a, statement.b)}
    alone = tuple(c._path for c in connectors if id(c) not in joined and c._owner is not None)
    return Graph(groups, _balances(connectors, connects, order), cuts, chosen, alone, wires, connects)


def _connecting(component: Component) -> list[tuple[Any, Origin]]:
    """Return the statements of a component; while they are formed, inputs and outputs are signals."""
    token = CONNECTING.set(True)
    try:
        return list(_statements(component))
    finally:
        CONNECTING.reset(token)


def _statements(component: Component) -> Iterator[tuple[Any, Origin]]:
    """Return the statements with their origins."""
    if type(component).connections is Component.connections:
        return iter(())
    here = method_origin(component, "connections")
    found = with_place(component.connections, here)
    if found is None:
        raise ConnectError(f"{here}: {returned_message(found, 'connections')}")
    return entries(found if isinstance(found, _ITERABLES) else (found,), here, "connections", nested=_ITERABLES)


_ITERABLES = (Iterator, list, tuple)  # no other iterables: iterating over a string gives strings again


def _refuse_ports_of_other_models(statement: Connect | Branch | Root, own: set[int], origin: Origin) -> None:
    """Raise ConnectError for a port of another built model."""
    for port in (statement.connector,) if isinstance(statement, Root) else (statement.a, statement.b):
        if id(port) not in own:
            raise ConnectError(
                f"{origin}: {port._path} ({type(port).__name__}) belongs to another model. Declare its component in "
                "the class body, and connect the port of that component."
            )


def _refuse_connections_in_equations(components: list[Component]) -> None:
    """Raise ConnectError for connections in equations(), the likely reason for an unconnected part."""
    for component in components:
        word = calls(type(component).equations, "connect", "chain")
        if word:
            raise ConnectError(
                f"{method_origin(component, 'equations')}: equations() yields {word}(...), which belongs to "
                "connections(): write it there."
            )


def _refuse_duplicates(connects: list[tuple[Component, Connect, str]]) -> None:
    seen: dict[frozenset[int], str] = {}
    for component, statement, where in connects:
        pair = frozenset((id(statement.a), id(statement.b)))
        if pair in seen:
            origin = Origin(component._path, type(component).__name__, where)
            raise ConnectError(
                f"{origin}: {statement.a._path} and {statement.b._path} are connected twice, first in {seen[pair]}. "
                "Remove one of the two."
            )
        seen[pair] = where


def _sets(members: list[Any], pairs: list[tuple[Any, Any]]) -> list[set[Any]]:
    """Return the sets of members joined by pairs (union-find, Galler & Fischer 1964)."""
    above = {member: member for member in (*members, *chain.from_iterable(pairs))}

    def top(member: Any) -> Any:
        while above[member] != member:
            above[member] = member = above[above[member]]
        return member

    for a, b in pairs:
        above[top(b)] = top(a)
    sets: dict[Any, set[Any]] = {}
    for member in above:
        sets.setdefault(top(member), set()).add(member)
    return list(sets.values())


def _balances(
    connectors: list[Connector], connects: list[tuple[Component, Connect, str]], order: dict[int, int]
) -> list[Balance]:
    """Return the flow balance of every connection set (Modelica specification, 9.2).

    Outside connectors have negative signs; an unconnected connector is a set of its own.
    """
    joined = [((s.a, s.a._owner is component), (s.b, s.b._owner is component)) for component, s, _ in connects]
    faces = _sets([(c, False) for c in connectors], joined)
    sets = [sorted(s, key=lambda face: order[id(face[0])]) for s in faces]
    sets.sort(key=lambda s: order[id(s[0][0])])
    return [tuple((connector, -1 if outside else 1) for connector, outside in s) for s in sets]
