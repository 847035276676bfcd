"""Spanning tree of the over-determined connectors: where their records are rooted, and where loops are cut."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from acausal.errors import ConnectError
from acausal.flatten.origin import Origin
from acausal.language.component import Component, Connector
from acausal.language.connection import Branch, Connect, Root


@dataclass(frozen=True)
class Cut:
    """A connection that closes a loop.

    Parameters
    ----------
    statement : Connect
        The connection.
    where : str
        File and line.
    loop : tuple of Component
        Components that the loop passes through, from one side of the cut to the other.
    """

    statement: Connect
    where: str
    loop: tuple[Component, ...]


class _Tree:
    """Breadth first from the roots; what a branch ties together is reached at once, so that no branch is cut.

    What is connected inside a part is reached with the part, so that loops are cut between parts.
    """

    def __init__(
        self, nodes: list[Connector], connects: Iterable[Connect], branches: Iterable[Branch], inner: set[int]
    ) -> None:
        self.inner = inner
        self.links: dict[int, list[tuple[Connector, Connect | None]]] = {id(n): [] for n in nodes}
        for b in branches:
            self.links[id(b.a)].append((b.b, None))
            self.links[id(b.b)].append((b.a, None))
        for c in connects:
            if id(c.a) in self.links:
                self.links[id(c.a)].append((c.b, c))
                self.links[id(c.b)].append((c.a, c))
        self.reached: set[int] = set()
        self.used: set[int] = set()
        self.parent: dict[int, Connector] = {}
        self.queue: deque[Connector] = deque()

    def enter(self, node: Connector) -> None:
        """Reach a node and everything that branches tie to it."""
        stack = [node]
        self.reached.add(id(node))
        while stack:
            here = stack.pop()
            self.queue.append(here)
            for there, statement in self.links[id(here)]:
                if id(statement) in self.inner and id(there) not in self.reached:
                    self.used.add(id(statement))
                    self.reached.add(id(there))
                    self.parent[id(there)] = here
                    stack.append(there)
                elif statement is None and there not in here._parents:
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
        """Reach all that is connected to what is reached."""
        while self.queue:
            here = self.queue.popleft()
            for there, statement in self.links[id(here)]:
                if statement is not None and id(there) not in self.reached:
                    self.used.add(id(statement))
                    self.parent[id(there)] = here
                    self.enter(there)

    def loop(self, cut: Connect) -> tuple[Component, ...]:
        """Components between the two sides of a cut, along the tree."""
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
    """Span the over-determined connectors from the roots; branches are never cut.

    Returns
    -------
    cuts : list of Cut
        The connections that close a loop.
    chosen : list of Connector
        The potential roots that were needed.
    """
    nodes = [c for c in connectors if type(c).residual is not Connector.residual]
    inner = {id(c) for owner, c, _ in connects if owner._path}
    tree = _Tree(nodes, [c for _, c, _ in connects], branches, inner)
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
            f"{_owner_of(lost[0])}: {lost[0]._path} is connected neither to a root such as the World nor to a body that "
            f"can move freely{_also(lost[1:])}. Connect the part, for instance with chain(), or remove it."
        )
    cut = [(c, where) for _, c, where in connects if id(c.a) in tree.links and id(c) not in tree.used]
    return [Cut(c, where, tree.loop(c)) for c, where in cut], chosen


def _owner_of(connector: Connector) -> Origin:
    return Origin.of(connector if connector._owner is None else connector._owner)


def _also(others: list[Connector]) -> str:
    more = ", ..." if len(others) > 5 else ""
    return f" (the same holds for {', '.join(c._path for c in others[:5])}{more})" if others else ""
