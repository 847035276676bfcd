"""Build the page that plays a document: one self-contained HTML text that needs no network; or its parts."""

from __future__ import annotations

import hashlib
import json
from base64 import b64encode
from functools import cache
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

from acausal.errors import DeclarationError

FOLDER = Path(__file__).with_name("page")
# Files of the viewer, concatenated in this order: definitions that are used while the script loads come first.
SCRIPTS = (
    *("vectors", "data", "turned", "solids", "tube", "curve", "spans", "mesh", "colours", "stage", "run", "views"),
    *("traces", "names", "hover", "clock", "record", "plots", "viewer", "choice", "address", "controls", "main"),
)
# Files of a page that explores, before the viewer starts in the last one.
EXPLORER = ("series", "tree", "explorer")


def html(document: dict[str, Any]) -> str:
    """Return the page that plays a document.

    Parameters
    ----------
    document : dict
        Document of one or several runs. Titles and names may contain any characters; numbers must be finite.

    Returns
    -------
    str
        HTML with style, scripts and document. Its content security policy forbids requests and all scripts except the two that
        it lists by their hashes.

    Raises
    ------
    ValueError
        If the document contains a number that is not finite.
    DeclarationError
        If the package that contains three.js is not installed.
    """
    values = content(document)
    return "".join(values[piece] if k % 2 else piece for k, piece in enumerate(player("explorer" in document)))


def content(document: dict[str, Any]) -> dict[str, str]:
    """Return what a page holds of its document, as HTML by name: `title` and `document`."""
    # In JSON "<" occurs only within strings, where its escape is equivalent: no tag can begin or end.
    data = json.dumps(document, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    return {"title": escape(str(document.get("title") or "animation")), "document": data}


def player(explores: bool = False) -> list[str]:
    """Return the page of any document, or of one that explores: pieces of HTML, every second one a name in `content`."""
    three, viewer = three_js(), script(EXPLORER if explores else ())
    style = part("viewer.css") + (part("explorer.css") if explores else "")
    fixed = {
        "policy": "; ".join(
            (
                "default-src 'none'",
                f"script-src {source_hash(three)} {source_hash(viewer)}",
                f"style-src {source_hash(style)}",
                "base-uri 'none'",
                "form-action 'none'",
            )
        ),
        "style": style,
        "three": three,
        "viewer": viewer,
    }
    # The template contains "@" only around the names of fields. Inserted text is not searched again.
    pieces = [""]
    for k, piece in enumerate(part("index.html").split("@")):
        if k % 2 and piece not in fixed:
            pieces += [piece, ""]
        else:
            pieces[-1] += fixed[piece] if k % 2 else piece
    return pieces


def script(more: tuple[str, ...] = ()) -> str:
    """Return the viewer as one script, with more files before the last one."""
    names = (*SCRIPTS[:-1], *more, SCRIPTS[-1])
    return "(() => {\n" + '"use strict";\n' + "".join(part(f"{name}.js") for name in names) + "})();\n"


@cache
def three_js() -> str:
    """Return three.js r130 with OrbitControls, as one script that defines THREE.

    Raises
    ------
    DeclarationError
        If the package that contains it is not installed.
    """
    try:
        return files("jupyter_threejs_sage").joinpath("static/r130/three.min.js").read_text(encoding="utf-8")
    except (ModuleNotFoundError, FileNotFoundError):
        raise DeclarationError(
            "an animated page needs three.js r130 from the package jupyter-threejs-sage, which is not installed: "
            "python -m pip install 'jupyter-threejs-sage>=130'."
        ) from None


def source_hash(text: str) -> str:
    """Return the source expression of an inline script or style for the content security policy."""
    return f"'sha256-{b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


@cache
def part(name: str) -> str:
    """Return the text of a file of the page."""
    return (FOLDER / name).read_text(encoding="utf-8")
