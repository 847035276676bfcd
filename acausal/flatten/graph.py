"""Graph of connections: which potentials are one variable, which flows balance, where records are cut and rooted."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from networkx.utils import UnionFind

from acausal.errors import ConnectError
from acausal.flatten.origin import Origin, line_of, with_place
from acausal.language.component import Component, Connector
from acausal.language.connection import Branch, Connect, Root


@dataclass(frozen=True)
class Graph:
    """What the connections of a model say.

    Parameters
    ----------
    same : list of tuple of Connector
        Connectors whose potentials are one variable.
    balances : list of tuple of (Connector, int)
        Connection sets: the signed flows of each sum to zero.
    cuts : list of Connect
        Connections that keep the residual of an over-determined record.
    roots : list of Connector
        Potential roots that were chosen.
    unconnected : tuple of str
        Ports of parts that nothing is connected to.
    """

    same: list[tuple[Connector, ...]]
    balances: list[tuple[tuple[Connector, int], ...]]
    cuts: list[Connect]
    roots: list[Connector]
    unconnected: tuple[str, ...]


def build_graph(components: list[Component]) -> Graph:
    """Collect the statements of all connections() and derive sets, spanning tree, cuts and roots."""
    connects: list[tuple[Component, Connect, str]] = []
    branches: list[Branch] = []
    roots: list[Root] = []
    for component in components:
        for statement, where in _statements(component):
            if isinstance(statement, Connect):
                connects.append((component, statement, where))
            elif isinstance(statement, Branch):
                branches.append(statement)
            elif isinstance(statement, Root):
                roots.append(statement)
            else:
                raise ConnectError(
                    f"{Origin(component._path, type(component).__name__, where)}: connections() yields {statement!r}; "
                    "yield connect(...), chain(...), branch(...), root(...) or potential_root(...)."
                )
    _refuse_doubles(connects)
    connectors = [c for c in components if isinstance(c, Connector)]
    cuts, chosen = _spanning_tree(connectors, [c for _, c, _ in connects], branches, roots)
    cut_ids = {id(c) for c in cuts}
    same = UnionFind(connectors)
    for _, statement, _ in connects:
        if id(statement) not in cut_ids:
            same.union(statement.a, statement.b)
    order = {id(c): k for k, c in enumerate(connectors)}
    groups = [tuple(sorted(group, key=lambda c: order[id(c)])) for group in same.to_sets()]
    groups.sort(key=lambda group: order[id(group[0])])
    joined = {id(port) for _, statement, _ in connects for port in (statement.a, statement.b)}
    alone = tuple(c._path for c in connectors if id(c) not in joined and c._owner is not None)
    return Graph(groups, _balances(connectors, connects, order), cuts, chosen, alone)


def _statements(component: Component) -> Iterator[tuple[Any, str]]:
    """Yield each statement with the line that it comes from."""
    here = Origin.of(component)
    said = with_place(component.connections, here)
    stack = [iter(said if isinstance(said, Iterable) else (said,))]
    while stack:
        item = with_place(lambda: next(stack[-1], _END), here)
        if item is _END:
            stack.pop()
        elif isinstance(item, Iterable):
            stack.append(iter(item))
        else:
            yield item, line_of(stack[0]) or here.where


_END: Any = object()


def _refuse_doubles(connects: list[tuple[Component, Connect, str]]) -> None:
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


def _balances(
    connectors: list[Connector], connects: list[tuple[Component, Connect, str]], order: dict[int, int]
) -> list[tuple[tuple[Connector, int], ...]]:
    """Flow balance of every connection set; an outside connector counts negatively, an unconnected one is a set alone.

    Modelica specification, 9.2.
    """
    faces: UnionFind = UnionFind((c, False) for c in connectors)
    for component, statement, _ in connects:
        a, b = ((port, port._owner is component) for port in (statement.a, statement.b))
        faces.union(a, b)
    sets = [sorted(s, key=lambda face: order[id(face[0])]) for s in faces.to_sets()]
    sets.sort(key=lambda s: order[id(s[0][0])])
    return [tuple((connector, -1 if outside else 1) for connector, outside in s) for s in sets]


def _spanning_tree(
    connectors: list[Connector], connects: list[Connect], branches: list[Branch], roots: list[Root]
) -> tuple[list[Connect], list[Connector]]:
    """Span the over-determined connectors breadth first from the roots; branches are never cut.

    Returns the connections that close a loop, and the potential roots that were needed.
    """
    nodes = [c for c in connectors if type(c).residual is not Connector.residual]
    links: dict[int, list[tuple[Connector, Connect | None]]] = {id(n): [] for n in nodes}
    for b in branches:
        links[id(b.a)].append((b.b, None))
        links[id(b.b)].append((b.a, None))
    for c in connects:
        if id(c.a) in links:
            links[id(c.a)].append((c.b, c))
            links[id(c.b)].append((c.a, c))
    reached: set[int] = set()
    tree: set[int] = set()
    queue: deque[Connector] = deque()

    def enter(node: Connector) -> None:
        """Reach a node and everything that branches tie to it."""
        stack = [node]
        reached.add(id(node))
        while stack:
            here = stack.pop()
            queue.append(here)
            for there, statement in links[id(here)]:
                if statement is None and there not in here._parents:
                    if id(there) in reached:
                        raise ConnectError(
                            f"{here._path} and {there._path} are tied to each other, or to roots, in two ways without a "
                            "connection between them that could be cut."
                        )
                    reached.add(id(there))
                    there._parents = (here,)
                    stack.append(there)

    def grow() -> None:
        while queue:
            here = queue.popleft()
            for there, statement in links[id(here)]:
                if statement is not None and id(there) not in reached:
                    tree.add(id(statement))
                    enter(there)

    for r in roots:
        if r.priority is None:
            enter(r.connector)
    grow()
    chosen = []
    for r in sorted((r for r in roots if r.priority is not None), key=lambda r: r.priority or 0):
        if id(r.connector) not in reached:
            r.connector._is_root = True
            chosen.append(r.connector)
            enter(r.connector)
            grow()
    lost = [n for n in nodes if id(n) not in reached]
    if lost:
        raise ConnectError(
            f"{_owner_of(lost[0])}: {lost[0]._path} has no connection to a root such as the World, nor to a body that "
            f"could move freely{_also(lost[1:])}. Connect the part, for instance with chain(), or remove it."
        )
    return [c for c in connects if id(c.a) in links and id(c) not in tree], chosen


def _owner_of(connector: Connector) -> Origin:
    return Origin.of(connector if connector._owner is None else connector._owner)


def _also(others: list[Connector]) -> str:
    more = ", ..." if len(others) > 5 else ""
    return f" (nor have {', '.join(c._path for c in others[:5])}{more})" if others else ""
