"""Symbols of components: a box with the ports of its class at both sides, coloured by domain."""

from __future__ import annotations

from html import escape

COLOURS = {
    "multibody": "#5f6b7a",
    "rotational": "#7a7a7a",
    "translational": "#3f8f4f",
    "electrical": "#2f5fd0",
    "thermal": "#c0392b",
    "signal": "#1f3a93",
}
WIDTH, ROW, SIDE, TOP = 150, 24, 130, 14


def symbol(name: str, ports: dict[str, tuple[str, str, bool]]) -> str:
    """Return the symbol of a component as SVG.

    Parameters
    ----------
    name : str
        Name in the box.
    ports : dict of str to (str, str, bool)
        Class, domain and whether it may be absent of each port by name; class "input" and "output" for signals.
    """
    right = [
        p for p, (kind, *_) in ports.items() if kind == "output" or (kind != "input" and p.endswith(("_b", "n", "2")))
    ]
    left = [p for p in ports if p not in right]
    rows = max(len(left), len(right), 2)
    height, middle = rows * ROW + 2 * TOP, SIDE + WIDTH / 2
    marks = [_port(p, ports[p], x, TOP + ROW * (k + 0.5 + (rows - len(names)) / 2))
             for names, x in ((left, SIDE), (right, SIDE + WIDTH)) for k, p in enumerate(names)]  # fmt: skip
    return (
        f'<svg class="symbol" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {2 * SIDE + WIDTH} {height}" role="img" '
        f'width="{2 * SIDE + WIDTH}" font-family="sans-serif" font-size="12"><title>{escape(name)} and its ports</title>'
        f'<rect x="{SIDE}" y="4" width="{WIDTH}" height="{height - 8}" rx="6" fill="currentColor" fill-opacity="0.05" '
        f'stroke="currentColor" stroke-opacity="0.6"/><text x="{middle}" y="{height / 2 + 4}" text-anchor="middle" '
        f'fill="currentColor" font-weight="bold" {_fit(name)}>{escape(name)}</text>{"".join(marks)}</svg>'
    )


def _fit(name: str) -> str:
    return f'textLength="{WIDTH - 16}" lengthAdjust="spacingAndGlyphs"' if len(name) > 17 else ""


def _port(name: str, port: tuple[str, str, bool], x: float, y: float) -> str:
    kind, domain, optional = port
    colour, outside = COLOURS.get(domain, COLOURS["multibody"]), -1 if x == SIDE else 1
    look = f'fill="{"none" if optional else colour}" stroke="{colour}" stroke-width="1.5"'
    if kind in ("input", "output"):
        tip = x + 9 if kind == "output" else x
        mark = f'<path d="M{tip - 9} {y - 5}L{tip} {y}L{tip - 9} {y + 5}z" {look}/>'
    elif domain == "multibody":
        mark = f'<rect x="{x - 4}" y="{y - 6}" width="8" height="12" {look}/>'
    else:
        mark = f'<circle cx="{x}" cy="{y}" r="5" {look}/>'
    anchor = "end" if outside < 0 else "start"
    label = f'<text x="{x + outside * 13}" y="{y + 4}" text-anchor="{anchor}" fill="currentColor">{escape(name)}</text>'
    return f"<g><title>{escape(f'{name}: {kind}')}{', optional' if optional else ''}</title>{mark}{label}</g>"
