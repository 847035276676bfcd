"""The page that plays a document: one HTML text with everything inside, which asks nothing of the network."""

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
# In this order they make one script: what is used while it is read stands before.
SCRIPTS = (
    *("vectors", "data", "solids", "tube", "curve", "spans", "mesh", "colours", "stage", "run", "views", "traces"),
    *("names", "hover", "clock", "record", "plots", "viewer", "choice", "address", "controls", "main"),
)


def html(document: dict[str, Any]) -> str:
    """Return the page that plays a document.

    Parameters
    ----------
    document : dict
        What `acausal.animation` collected of one or several runs. Its title and names may hold any characters; its numbers
        are finite.

    Returns
    -------
    str
        One HTML text with style, scripts and document inside. Its policy forbids everything else: no address is asked, and
        no script runs but the two that are named in it by their hashes.

    Raises
    ------
    ValueError
        If the document holds a number that is not finite.
    DeclarationError
        If the package that contains three.js is not installed.
    """
    three, viewer, style = three_js(), script(), part("viewer.css")
    # In JSON "<" stands within strings only, where it may be written by its number: no tag can begin or end.
    data = json.dumps(document, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    fields = {
        "policy": "; ".join(
            (
                "default-src 'none'",
                f"script-src {hashed(three)} {hashed(viewer)}",
                f"style-src {hashed(style)}",
                "base-uri 'none'",
                "form-action 'none'",
            )
        ),
        "title": escape(str(document.get("title") or "animation")),
        "style": style,
        "document": data,
        "three": three,
        "viewer": viewer,
    }
    first, *pieces = part("index.html").split("@")
    # The template holds names of fields between @ and @, and no other @; what is put in is not looked at again.
    return first + "".join(fields[piece] if k % 2 == 0 else piece for k, piece in enumerate(pieces))


def script() -> str:
    """Return the viewer as one script."""
    return "(() => {\n" + '"use strict";\n' + "".join(part(f"{name}.js") for name in SCRIPTS) + "})();\n"


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


def hashed(text: str) -> str:
    """Return how the page's policy names a script or style that stands in it."""
    return f"'sha256-{b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


@cache
def part(name: str) -> str:
    """Return the text of one of the page's files."""
    return (FOLDER / name).read_text(encoding="utf-8")
