"""Formulas of the site as MathML, which browsers draw by themselves: without scripts, fonts or a network."""

from __future__ import annotations

import re
from html import escape
from typing import Any

from latex2mathml.converter import convert
from sphinx.util.logging import getLogger


def mathml(latex: str, display: str = "inline") -> str:
    """Return a formula in MathML."""
    latex = latex.replace("{aligned}", "{align*}")
    # Words stay whole, with their underscores.
    latex = re.sub(r"\\mathrm\{((?:[\w. ]|\\_){2,})\}", lambda word: f"\\text{{{word[1].replace(chr(92), '')}}}", latex)
    try:
        found = convert(latex, display=display)
    except Exception as error:  # latex2mathml has many kinds; in a parallel build they would pass unseen
        found = f"{type(error).__name__}: \\"
    if "<mi>&</mi>" in found or "\\" in found:
        getLogger(__name__).warning("this formula cannot be typeset: %s", latex)
    return found


def setup(app: Any) -> dict[str, bool]:
    """Add the renderer `mathml`, html_math_renderer of Sphinx."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True}


def _inline(writer: Any, node: Any) -> None:
    from docutils import nodes

    writer.body.append(mathml(node.astext()))
    raise nodes.SkipNode


def _block(writer: Any, node: Any) -> None:
    from docutils import nodes

    number = f'<span class="eqno">({escape(str(node["number"]))})</span>' if node.get("number") else ""
    writer.body.append(f'<div class="math">{number}{mathml(node.astext(), "block")}</div>\n')
    raise nodes.SkipNode
