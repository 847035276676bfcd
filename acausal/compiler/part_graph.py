"""Graph of the parts of a model and their connections."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.component_tree import members, walk
from acausal.language.component import Connector
from acausal.language.expression import Expr


def part_graph(raw: CollectedStatements, part: str) -> Any:
    """Return the parts in a part as nodes and their connections as edges.

    Parameters
    ----------
    raw : CollectedStatements
        The model.
    part : str
        Path of the part, "" for the whole model.

    Returns
    -------
    networkx.MultiGraph
        Nodes are paths; each has the name of its class as `kind`. Edges have the paths of both ports as `ports`, `kind`, the
        class of the ports or "signal", and `where`, the line. Ports of the part itself are nodes, too.
    """
    import networkx as nx

    graph = nx.MultiGraph()
    (whole,) = (component for component in walk(raw.build.root) if component._path == part)
    for component in members(whole):
        if not isinstance(component, Connector):
            graph.add_node(component._path, kind=type(component).__name__)
    for a, b, kind, where in _connections(raw):
        ends = [_node(path, part) for path in (a, b)]
        if all(ends) and ends[0] != ends[1]:
            for end, path in zip(ends, (a, b), strict=True):
                graph.add_node(end, **({} if end in graph else {"kind": "port" if path == end else ""}))
            graph.add_edge(*ends, ports=(a, b), kind=kind, where=where)
    return graph


def _connections(raw: CollectedStatements) -> Iterator[tuple[str, str, str, str]]:
    for _, statement, where in raw.graph.connects:
        yield statement.a._path, statement.b._path, type(statement.a).__name__, where
    for _, wire, where in raw.graph.wires:
        yield _path(wire.a), _path(wire.b), "signal", where


def _path(signal: Any) -> str:
    return signal.name or "" if isinstance(signal, Expr) else str(signal)


def _node(path: str, part: str) -> str:
    """Return the path of the part directly in `part` that has the port, of the port if it is one of `part`, or ""."""
    if part and not path.startswith(f"{part}."):
        return ""
    own = path[len(part) + 1 :] if part else path
    return f"{part}.{own.partition('.')[0]}" if part else own.partition(".")[0]
