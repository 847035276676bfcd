"""Spanning tree of the over-determined connectors: roots of their records, and cuts of loops."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count
from typing import Any

from acausal.errors import ConnectError
from acausal.flatten.origin import Origin
from acausal.language.component import Component, Connector
from acausal.language.connection import Branch, Connect, Root


@dataclass(frozen=True)
class Cut:
    """A connection that closes a loop, left out of the spanning tree.

    Parameters
    ----------
    statement : Connect
        The connection.
    where : str
        File and line of the connection.
    loop : tuple of Component
        Components that the loop passes through, from one side of the cut to the other.
    """

    statement: Connect
    where: str
    loop: tuple[Component, ...]


class _Tree:
    """Minimum spanning tree (Prim 1957), grown from the roots.

    Branches, which cannot be cut, come first, then the connections stated deepest in the tree of parts, and among these
    the nearest to the root. So a loop is cut at a connection of the outermost component that it passes through.
    """

    def __init__(
        self, nodes: list[Connector], connects: list[tuple[Component, Connect, str]], branches: Iterable[Branch]
    ) -> None:
        self.branches: dict[int, list[Connector]] = {id(n): [] for n in nodes}
        for b in branches:
            self.branches[id(b.a)].append(b.b)
            self.branches[id(b.b)].append(b.a)
        self.links: dict[int, list[tuple[Connector, Connect]]] = {id(n): [] for n in nodes}
        for _, c, _ in connects:
            if id(c.a) in self.links:
                self.links[id(c.a)].append((c.b, c))
                self.links[id(c.b)].append((c.a, c))
        self.depth = {id(c): len(owner._path.split(".")) if owner._path else 0 for owner, c, _ in connects}
        self.reached: set[int] = set()
        self.used: set[int] = set()
        self.parent: dict[int, Connector] = {}
        self.order = count()
        self.waiting: list[tuple[int, int, Connector, Connector, Connect]] = []

    def enter(self, node: Connector) -> None:
        """Add a node, and all nodes joined to it by branches."""
        stack = [node]
        self.reached.add(id(node))
        while stack:
            here = stack.pop()
            for there, statement in self.links[id(here)]:
                heappush(self.waiting, (-self.depth[id(statement)], next(self.order), here, there, statement))
            for there in self.branches[id(here)]:
                if there in here._parents:
                    continue
                if id(there) in self.reached:
                    raise ConnectError(
                        f"{here._path} and {there._path} are joined to each other, or to roots, by two paths without a "
                        "connection that could be cut."
                    )
                self.reached.add(id(there))
                there._parents = (here,)
                self.parent[id(there)] = here
                stack.append(there)

    def grow(self) -> None:
        """Add all nodes that are connected to the tree."""
        while self.waiting:
            *_, here, there, statement = heappop(self.waiting)
            if id(there) not in self.reached:
                self.used.add(id(statement))
                self.parent[id(there)] = here
                self.enter(there)

    def loop(self, cut: Connect) -> tuple[Component, ...]:
        """Return the components between the two sides of a cut, along the tree."""
        up, down = self._ancestors(cut.a), self._ancestors(cut.b)
        while up and down and up[-1] is down[-1]:
            up.pop()
            down.pop()
        owners = [c._owner for c in (*up, *reversed(down)) if c._owner is not None]
        return tuple({id(o): o for o in owners}.values())

    def _ancestors(self, node: Connector) -> list[Connector]:
        found = [node]
        while id(found[-1]) in self.parent:
            found.append(self.parent[id(found[-1])])
        return found


def spanning_tree(
    connectors: list[Connector],
    connects: list[tuple[Component, Connect, str]],
    branches: list[Branch],
    roots: list[Root],
) -> tuple[list[Cut], list[Connector]]:
    """Return the cuts and chosen roots of a spanning tree of the over-determined connectors.

    Returns
    -------
    cuts : list of Cut
        Connections that close a loop.
    chosen : list of Connector
        Potential roots that were needed.
    """
    nodes = [c for c in connectors if type(c).residual is not Connector.residual]
    tree = _Tree(nodes, connects, branches)
    for r in roots:
        if r.priority is None:
            tree.enter(r.connector)
    tree.grow()
    chosen = []
    for r in sorted((r for r in roots if r.priority is not None), key=lambda r: r.priority or 0):
        if id(r.connector) not in tree.reached:
            r.connector._is_root = True
            chosen.append(r.connector)
            tree.enter(r.connector)
            tree.grow()
    lost: list[Any] = [n for n in nodes if id(n) not in tree.reached]
    if lost:
        raise ConnectError(
            f"{_owner_of(lost[0])}: {lost[0]._path} is connected neither to a root such as the World nor to a body "
            f"that can move freely{_also(lost[1:])}. Connect the part, for instance with chain(), or remove it."
        )
    cut = [(c, where) for _, c, where in connects if id(c.a) in tree.links and id(c) not in tree.used]
    return [Cut(c, where, tree.loop(c)) for c, where in cut], chosen


def _owner_of(connector: Connector) -> Origin:
    return Origin.of(connector if connector._owner is None else connector._owner)


def _also(others: list[Connector]) -> str:
    more = ", ..." if len(others) > 5 else ""
    return f" (the same holds for {', '.join(c._path for c in others[:5])}{more})" if others else ""
