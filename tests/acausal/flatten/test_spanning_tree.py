"""Spanning trees of random graphs of connectors, against the number of independent circuits."""

from __future__ import annotations

from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import networkx as nx
import numpy as np
import pytest

import acausal as ac
from acausal.flatten.spanning_tree import spanning_tree


class Node:
    """What the tree sees of a connector."""

    residual = None

    def __init__(self, k: int) -> None:
        self._path, self._origin = f"part[{k}].frame", "line"
        self._owner, self._parents, self._is_root = None, (), False


def span(graph: nx.MultiGraph, roots: dict[int, int | None]) -> tuple[list[Any], list[Any], list[Node]]:
    nodes = [Node(k) for k in graph]
    connects = [(SimpleNamespace(_path=""), SimpleNamespace(a=nodes[u], b=nodes[v]), "line") for u, v in graph.edges()]
    given = [SimpleNamespace(connector=nodes[k], priority=priority) for k, priority in roots.items()]
    return (*spanning_tree(nodes, connects, [], given), nodes)  # type: ignore[arg-type]


@pytest.mark.parametrize("seed", range(10))
def test_as_many_cuts_as_independent_circuits(seed: int) -> None:
    rng = np.random.default_rng(seed)
    graph = nx.MultiGraph(nx.gnm_random_graph(12, int(rng.integers(12, 30)), seed=seed))
    graph.add_edges_from(pairwise(range(12)))
    cuts, chosen, nodes = span(graph, {0: None, 5: 2})
    assert len(cuts) == graph.number_of_edges() - graph.number_of_nodes() + 1
    assert chosen == [], "a potential root is not needed where there is a root"
    place = {id(node): k for k, node in enumerate(nodes)}
    for cut in cuts:
        graph.remove_edge(place[id(cut.statement.a)], place[id(cut.statement.b)])
    assert nx.is_tree(graph)


def test_each_piece_without_a_root_takes_its_first_potential_root() -> None:
    graph = nx.MultiGraph([(0, 1), (1, 2), (3, 4), (4, 5), (5, 3)])
    cuts, chosen, nodes = span(graph, {0: None, 4: 3, 5: 1})
    assert len(cuts) == 1
    assert chosen == [nodes[5]]
    assert [node._is_root for node in nodes] == [False] * 5 + [True]


def test_what_no_root_reaches_is_refused() -> None:
    with pytest.raises(ac.ConnectError, match=r"part\[2\].frame is connected neither to a root"):
        span(nx.MultiGraph([(0, 1), (2, 3)]), {0: None})
