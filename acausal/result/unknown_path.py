"""The message for a path that does not exist."""

from __future__ import annotations

import re

from acausal.flatten.component_tree import members, walk
from acausal.language.component import Component
from acausal.language.expression import Equation
from acausal.language.pending import PENDING, Pending
from acausal.nearest import suggestions
from acausal.result.files import shown_name

FILES = (".png", ".svg", ".pdf", ".csv")
MOST = 10_000  # statements of one component that are searched
LISTED = 8  # names listed in a message


def unknown_path(path: str, known: list[str], tree: Component | None = None, kind: str = "") -> str:
    """Return the message for a path that does not exist.

    Parameters
    ----------
    path : str
        The path.
    known : list of str
        The existing paths.
    tree : Component, optional
        The bound model, if there is one.
    kind : str
        Without a model, the class of the part that the path names, "" if unknown.
    """
    if not path.strip():
        return "the name of a variable is empty; give its path, such as 'beam.frame_b.r_0'."
    derivative, plain = re.fullmatch(r"der\((.+)\)", path), re.sub(r"[\[(].*", "", path)
    if derivative and derivative[1] in known:
        return f"`{path}` is not a variable of the model. {_of_derivative(derivative[1], known, tree)}"
    part = path.rpartition(".")[0]
    kind = (
        next((type(c).__name__ for c in walk(tree) if part and "[" not in part and c._path == part), "")
        if tree
        else kind
    )
    remedy = suggestions(path, known, kind)
    if remedy == "." and tree:
        remedy = _nearest_part(path, tree)
    if plain in known and plain != path and "]." not in path:
        remedy = f"; indices are whole numbers in brackets, such as `{plain}[0]`."
    if path.endswith(FILES):
        remedy = "; the name of a file is given by path=..."
    return f"there is no `{shown_name(path)}` in the model{remedy}"


def _nearest_part(path: str, tree: Component) -> str:
    """List the parts and ports of the deepest existing part along a path."""
    inside = [c for c in walk(tree) if c._path and path.startswith((f"{c._path}.", f"{c._path}["))]
    if not inside:
        return "."
    owner = max(inside, key=lambda c: len(c._path))
    names = [c._path[len(owner._path) + 1 :] for c in members(owner)]
    return f"; {owner!r} has {', '.join(names[:LISTED])}{', ...' if len(names) > LISTED else '.'}" if names else "."


def _of_derivative(name: str, known: list[str], tree: Component | None) -> str:
    same = _equal_to(tree, f"der({name})") if tree else ""
    if same:
        return f"Read `{same}`, which the model sets equal to it."
    free = f"{re.sub(r'[^0-9A-Za-z_].*', '', name.rpartition('.')[2])}_dot"
    while free in known:
        free += "_"
    return f"Declare one and give it the equation: {free} == der({name})."


def _equal_to(tree: Component, derivative: str) -> str:
    """Return the path of a variable that an equation equates with a derivative, "" if there is none."""
    token = PENDING.set(Pending())
    try:
        for component in walk(tree):
            for statement, _ in zip(component.equations(), range(MOST), strict=False):
                if isinstance(statement, Equation):
                    names = {statement.lhs.name, statement.rhs.name} - {derivative}
                    if len(names) == 1 and derivative in (statement.lhs.name, statement.rhs.name):
                        (other,) = names
                        if other and not other.startswith("der("):
                            return other
    except Exception:
        return ""  # the search only serves a hint
    finally:
        PENDING.reset(token)
    return ""
