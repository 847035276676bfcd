"""Names that may have been meant by one that does not exist."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Sequence

LONG = 200  # characters of a path
MOST = 8  # names that are listed
NEAR = 0.6  # similarity of two names that differ by a slip


def nearest(path: str, known: Sequence[str]) -> list[str]:
    """Return up to three names that may have been meant by a path, the likeliest first."""
    near = [name for name in known if name.endswith(f".{path}") or path in (f"self.{name}", f"model.{name}")]
    near += [name for name in known if name.casefold() == path.casefold() and name not in near]
    alike = [name for name in known if _is_near(path, name)]
    near += [name for name in difflib.get_close_matches(path[:LONG], alike, 3, 0.5) if name not in near]
    return near[:3]


def likeliest(name: str, known: Iterable[str], share: float = 0.6) -> str:
    """Return the name that resembles another one most, "" if none resembles it by this share at least."""
    return next(iter(difflib.get_close_matches(name, known, 1, share)), "")


def missing(path: str, known: Sequence[str], kind: str = "") -> str:
    """Return what follows "there is no `...` in the model": names that may be meant, or those of the same part.

    Parameters
    ----------
    path : str
        What does not exist.
    known : sequence of str
        Paths that do.
    kind : str
        Class of the part in which it was looked for, "" if it is not known.
    """
    near = nearest(path, known)
    if near:
        return f"; did you mean {', '.join(f'`{name}`' for name in near)}?"
    part = path.rpartition(".")[0]
    inside = _members(part, known)
    if not inside:
        return "."
    what = (f"{part} ({kind})" if kind else part) if part else "it"
    return f"; {what} has {', '.join(inside[:MOST])}{', ...' if len(inside) > MOST else '.'}"


def _members(part: str, known: Iterable[str]) -> list[str]:
    """Names of what a part itself has, without indices."""
    start = f"{part}." if part else ""
    rest = (name[len(start) :] for name in known if name.startswith(start))
    return list(dict.fromkeys(name.partition("[")[0] for name in rest if "." not in name))


def _is_near(path: str, name: str) -> bool:
    """Whether a path is a name with a slip in one of its parts or several."""
    if len(path) > LONG:
        return False
    mine, other = path.split("."), name.split(".")
    if len(mine) != len(other):
        return len(path) > 4 and difflib.SequenceMatcher(None, path, name).ratio() >= 0.85
    return all(map(_alike, mine, other))


def _alike(one: str, other: str) -> bool:
    one, other = (re.sub(r"\[.*", "", text).casefold() for text in (one, other))
    if one == other:
        return True
    ratio = difflib.SequenceMatcher(None, one, other).ratio()
    return abs(len(one) - len(other)) <= 2 and (ratio >= NEAR or sorted(one) == sorted(other))
