"""Names that may have been meant by one that does not exist."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Sequence

LONG = 200  # characters of a path
MOST = 12
NEAR = 0.6  # similarity of two names that differ by a slip
SLIP = 0.85  # similarity of two names of which one is the other misspelt
PIECE, WORD = 3, 4  # letters of a name inside another one, and of a word that two names share: shorter ones are chance


def nearest(path: str, known: Sequence[str]) -> list[str]:
    """Return up to three names that may have been meant by a path, the likeliest first."""
    near = [name for name in known if name.endswith(f".{path}") or path in (f"self.{name}", f"model.{name}")]
    near += [name for name in known if name.casefold() == path.casefold() and name not in near]
    alike = [name for name in known if _is_near(path, name)]
    near += [name for name in difflib.get_close_matches(path[:LONG], alike, 3, 0.5) if name not in near]
    part, _, own = path.rpartition(".")
    beside = {name.rpartition(".")[2]: name for name in known if name.rpartition(".")[0] == part}
    near += [beside[name] for name in _related(own, beside)[:1] if not near]
    return near[:3]


def likeliest(name: str, known: Iterable[str], share: float = NEAR) -> str:
    """Return the name that was probably meant by one that does not exist, "" if none resembles it.

    Slips of spelling come first, then names that have a word in common with it, then others.

    Parameters
    ----------
    name : str
        What does not exist.
    known : iterable of str
        Names that do.
    share : float
        How much of the letters others have in common with it, from 0 to 1.
    """
    known = list(known)
    slip, other = (difflib.get_close_matches(name, known, 1, least) for least in (SLIP, share))
    return next(iter([*slip, *_related(name, known), *other]), "")


def _related(name: str, known: Iterable[str]) -> list[str]:
    """Return names that contain another one, then those inside it, then those that share words with it; the nearest first."""
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
