"""Diagram of the parts of a model and their connections, as SVG."""

from __future__ import annotations

from html import escape
from typing import Any

WIDTH, HEIGHT, GAP_X, GAP_Y, MARGIN = 132, 40, 44, 18, 6  # of the boxes and between them, in pixels


def diagram(graph: Any) -> str:
    """Return an SVG with a box for each part and a line for each connection, with their ports as tooltips.

    Parts stand in layers by their distance from the first one.

    Parameters
    ----------
    graph : networkx.MultiGraph
        Of `part_graph`.
    """
    place = _places(graph)
    columns = max((x for x, _ in place.values()), default=0) + 1
    rows = max((y for _, y in place.values()), default=0) + 1
    width = columns * (WIDTH + GAP_X) - GAP_X + 2 * MARGIN
    height = round(rows * (HEIGHT + GAP_Y) - GAP_Y + 2 * MARGIN)
    at = {node: (MARGIN + x * (WIDTH + GAP_X), round(MARGIN + y * (HEIGHT + GAP_Y))) for node, (x, y) in place.items()}
    lines = [_line(at[a], at[b], data) for a, b, data in graph.edges(data=True)]
    boxes = [_box(at[node], node, data["kind"]) for node, data in graph.nodes(data=True)]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" style="max-width:100%" '
        f'font-family="sans-serif" font-size="12">{"".join(lines + boxes)}</svg>'
    )


def _places(graph: Any) -> dict[str, tuple[int, float]]:
    """Return column and row of each part: by breadth-first search, ordered by the mean row of their neighbours."""
    import networkx as nx

    place, below = dict[str, tuple[int, float]](), 0.0
    order = {node: k for k, node in enumerate(graph)}
    for group in sorted(nx.connected_components(graph), key=lambda nodes: min(map(order.__getitem__, nodes))):
        layers = list(nx.bfs_layers(graph, min(group, key=order.__getitem__)))
        tall = max(map(len, layers))
        for x, layer in enumerate(layers):

            def mean(node: str) -> float:
                known = [place[other][1] for other in graph[node] if other in place]
                return sum(known) / len(known) if known else 0.0

            first = below + (tall - len(layer)) / 2
            for y, node in enumerate(sorted(layer, key=lambda node: (mean(node), order[node]))):
                place[node] = x, first + y
        below += tall
    return place


def _line(a: tuple[int, int], b: tuple[int, int], data: dict[str, Any]) -> str:
    (x1, y1), (x2, y2) = sorted([a, b])
    y1, y2 = y1 + HEIGHT // 2, y2 + HEIGHT // 2
    start = x1 + WIDTH
    # Parts of one layer are joined beside it.
    end, bend = (x2, GAP_X // 2) if x2 > x1 else (x2 + WIDTH, GAP_X // 2)
    last = end - bend if x2 > x1 else end + bend
    dashes = ' stroke-dasharray="4 3"' if data["kind"] == "signal" else ""
    tip = escape(f"{data['kind']}: {' - '.join(data['ports'])}")
    return (
        f'<path d="M{start} {y1}C{start + bend} {y1} {last} {y2} {end} {y2}" fill="none" stroke="currentColor" '
        f'stroke-opacity="0.55" stroke-width="1.5"{dashes}><title>{tip}</title></path>'
    )


def _box(at: tuple[int, int], path: str, kind: str) -> str:
    (x, y), middle = at, WIDTH // 2
    name = path.rpartition(".")[2]
    return (
        f'<g transform="translate({x} {y})"><title>{escape(f"{path} ({kind})")}</title>'
        f'<rect width="{WIDTH}" height="{HEIGHT}" rx="5" fill="currentColor" fill-opacity="0.07" stroke="currentColor" '
        f'stroke-opacity="0.5"/><text x="{middle}" y="17" text-anchor="middle" fill="currentColor">{escape(_short(name))}'
        f'</text><text x="{middle}" y="32" text-anchor="middle" fill="currentColor" fill-opacity="0.65" font-size="10">'
        f"{escape(_short(kind))}</text></g>"
    )


def _short(text: str) -> str:
    return text if len(text) <= 19 else f"{text[:18]}…"
