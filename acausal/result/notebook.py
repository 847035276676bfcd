"""Results in notebooks: a summary, and the animation in a frame; one player serves all frames.

The first animation of a notebook also stores the player, the page without its document. A script in the notebook fills the
frames as soon as the player is there; without scripts, or without the player, a frame shows what to do.
"""

from __future__ import annotations

import hashlib
import json
import sys
from html import escape
from typing import Any, Protocol

from acausal.animation.document import document_of, scenes
from acausal.animation.page import content, part, player
from acausal.errors import AcausalError
from acausal.language.component_html import table_html
from acausal.result.animated import Animatable, run_of
from acausal.result.plots import Series

MISSING = (
    "The player of this animation is missing: the output that held it was removed, or the notebook is not trusted. Run this "
    "cell again."
)
_holder: tuple[str, str, str] | None = None  # session, cell and execution of the output that holds the player


class Shown(Animatable, Protocol):
    """The attributes of a result that a notebook shows."""

    def series(self) -> list[Series]:
        """Return the outputs."""
        ...


def result_html(result: Shown) -> str:
    """Return times, warnings and final values of the outputs as HTML, and the animation if something is visible.

    Parameters
    ----------
    result : Result
        The result.
    """
    stats, time = result.stats, result.time
    counts = f"; {stats['states']} states, {stats['steps']} steps, {stats['method']}" if stats["steps"] else ""
    lines = [f"{result!r}{counts}"]
    lines += [f"Stopped: {stats['stopped']}"] if stats.get("stopped") else []
    lines += [f"Warning: {text}" for text in stats["doubts"]]
    text = "".join(f"<p>{escape(line)}</p>" for line in lines)
    series = result.series() if time.size and result.outputs else []
    rows = [(s.name, f"{s.values[-1]:.6g} {s.unit}") for s in series]
    table = table_html(("output", f"at {time[-1]:g} s"), rows) if rows else ""
    return f"{text}{table}{animation_html(result) or ''}"


def animation_html(result: Animatable) -> str | None:
    """Return the animation as a sandboxed frame for a notebook; None if nothing is visible.

    Parameters
    ----------
    result : Result
        The result.
    """
    try:
        values, pieces = content(document_of(scenes({result.title: run_of(result)}))), _code(player())
    except AcausalError:
        return None
    name, frame = _digest(pieces), f"acausal-{_digest(values['document'])}"
    script = f"{part('frame.js').strip()}({_code(frame)}, {_code(name)}, {_code(values)});"
    if _holds_player():
        found = f"(window.acausalPlayers ??= {{}})[{_code(name)}] = {pieces};"
        script = f'{found} dispatchEvent(new Event("acausal-player"));\n{script}'
    return (
        f'<iframe id="{frame}" sandbox="allow-scripts allow-downloads" style="width: 100%; height: 600px; border: 0" '
        f'srcdoc="{escape(f"<p>{MISSING}</p>")}"></iframe><script>{script}</script>'
    )


def _holds_player() -> bool:
    """True if the output that is being made must hold the player.

    So it is once in each session of the notebook, and again where the cell with the player runs again, which replaces its
    output. Outside a notebook, and in Colab, which isolates outputs, each output holds the player.
    """
    global _holder
    shell: Any = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    request = getattr(shell, "get_parent", dict)()
    if not request or "google.colab" in sys.modules:
        return True
    header = request["header"]
    cell = request.get("metadata", {}).get("cellId") or request["content"].get("code", "")
    here = (header["session"], cell, header["msg_id"])
    if _holder is None or here[0] != _holder[0] or (here[1] == _holder[1] and here[2] != _holder[2]):
        _holder = here
        return True
    return False


def _code(value: Any) -> str:
    """Return a value as JavaScript that may stand in HTML."""
    return json.dumps(value).replace("<", "\\u003c")


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]
