"""Suggestions for unknown names: existing names that resemble them."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Sequence

LONG = 200  # length of a path, in characters, beyond which similarity is not computed: its cost is quadratic
MOST = 12  # members of a part listed in a message
NEAR = 0.6  # least similarity ratio (difflib) of a suggested name
SLIP = 0.85  # least similarity ratio of a misspelling, which precedes other suggestions
PIECE, WORD = 3, 4  # fewest letters of a contained name and of a shared word: shorter matches are accidental


def nearest(path: str, known: Sequence[str]) -> list[str]:
    """Return up to three existing names that a path may stand for, the likeliest first."""
    near = [name for name in known if name.endswith(f".{path}") or path in (f"self.{name}", f"model.{name}")]
    near += [name for name in known if name.casefold() == path.casefold() and name not in near]
    alike = [name for name in known if _is_near(path, name)]
    near += [name for name in difflib.get_close_matches(path[:LONG], alike, 3, 0.5) if name not in near]
    part, _, own = path.rpartition(".")
    beside = {name.rpartition(".")[2]: name for name in known if name.rpartition(".")[0] == part}
    near += [beside[name] for name in _related(own, beside)[:1] if not near]
    return near[:3]


def most_similar(name: str, known: Iterable[str], share: float = NEAR) -> str:
    """Return the existing name that resembles an unknown one most, "" if none does.

    Misspellings come first, then names with a common word, then other similar names.

    Parameters
    ----------
    name : str
        The unknown name.
    known : iterable of str
        Existing names.
    share : float
        Least similarity ratio of other names, from 0 to 1.
    """
    known = list(known)
    slip, other = (difflib.get_close_matches(name, known, 1, least) for least in (SLIP, share))
    return next(iter([*slip, *_related(name, known), *other]), "")


def _related(name: str, known: Iterable[str]) -> list[str]:
    """Return names that contain `name`, names inside it and names with common words, in this order."""
    own, plain = _words(name), _plain(name)
    found = []
    for k in known:
        words, other = _words(k), _plain(k)
        inside = min(len(k), len(name)) >= PIECE and (plain in other or other in plain)
        shared = sum(len(word) >= WORD for word in own & words)
        if inside or shared:
            found.append((not inside, inside and len(k) < len(name), -shared, abs(len(k) - len(name)), k))
    return [k for *_, k in sorted(found)]


def _plain(name: str) -> str:
    return name.casefold().replace("-", "_")


def _words(name: str) -> set[str]:
    return set(_plain(name).split("_"))


def suggestions(path: str, known: Sequence[str], kind: str = "") -> str:
    """Return the end of the message "there is no `...` in the model": similar names, or the members of the same part.

    Parameters
    ----------
    path : str
        The unknown path.
    known : sequence of str
        Existing paths.
    kind : str
        Class of the part that should contain it, "" if unknown.
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
    """Return the names of the direct members of a part, without indices."""
    start = f"{part}." if part else ""
    rest = (name[len(start) :] for name in known if name.startswith(start))
    return list(dict.fromkeys(name.partition("[")[0] for name in rest if "." not in name))


def _is_near(path: str, name: str) -> bool:
    """Return whether a path is a misspelling of another one."""
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
