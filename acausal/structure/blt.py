"""Block lower triangular form."""

from __future__ import annotations

from collections.abc import Iterable
from heapq import heapify, heappop, heappush

import scipy

from acausal.structure.block import Block
from acausal.structure.incidence import Rows, sparse


def block_triangular(rows: Rows, pairs: Iterable[tuple[int, int]]) -> tuple[Block, ...]:
    """Order matched pairs for solution: strongly connected components (Duff & Reid 1978), lowest equation first.

    Parameters
    ----------
    rows : sequence of sequence of int
        Variables of every equation; variables without a pair are known.
    pairs : iterable of (int, int)
        Matched (variable, equation).

    """
    ordered = sorted((equation, variable) for variable, equation in pairs)
    position = {variable: k for k, (_, variable) in enumerate(ordered)}
    needs = [[position[v] for v in rows[e] if v in position] for e, _ in ordered]
    count, labels = scipy.sparse.csgraph.connected_components(sparse(needs, len(needs)), connection="strong")
    members: list[list[int]] = [[] for _ in range(count)]
    for k, label in enumerate(labels.tolist()):
        members[label].append(k)
    return tuple(
        Block(tuple(ordered[k][0] for k in members[label]), tuple(ordered[k][1] for k in members[label]))
        for label in _topological(needs, labels.tolist(), members)
    )


def _topological(needs: list[list[int]], labels: list[int], members: list[list[int]]) -> Iterable[int]:
    """Yield the components in topological order (Kahn 1962), the one with the lowest member first."""
    users: list[list[int]] = [[] for _ in members]
    missing = [0] * len(members)
    for label, needed in zip(labels, needs, strict=True):
        for k in needed:
            if labels[k] != label:
                users[labels[k]].append(label)
                missing[label] += 1
    ready = [(members[label][0], label) for label, count in enumerate(missing) if not count]
    heapify(ready)
    while ready:
        _, label = heappop(ready)
        yield label
        for user in users[label]:
            missing[user] -= 1
            if not missing[user]:
                heappush(ready, (members[user][0], user))
