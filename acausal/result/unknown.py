"""What is said of a path that does not exist."""

from __future__ import annotations

import re

from acausal.flatten.tree import join, walk
from acausal.language.component import Component
from acausal.language.expression import Equation
from acausal.language.fields import Variable
from acausal.language.functions import PENDING, Pending
from acausal.language.nearest import missing
from acausal.result.files import shown_name

FILES = (".png", ".svg", ".pdf", ".csv")
MOST = 10_000  # statements of one component that are read


def unknown(path: str, known: list[str], tree: Component | None = None) -> str:
    """Return the message for a path that does not exist.

    Parameters
    ----------
    path : str
        What was looked for.
    known : list of str
        What there is.
    tree : Component, optional
        The bound model, if there is one.
    """
    if not path.strip():
        return "the name of a variable is empty; give its path, such as 'beam.frame_b.r_0'."
    derivative, plain = re.fullmatch(r"der\((.+)\)", path), re.sub(r"[\[(].*", "", path)
    if derivative and derivative[1] in known:
        return f"`{path}` is not a variable of the model. {_of_derivative(derivative[1], known, tree)}"
    part = path.rpartition(".")[0]
    kind = next((type(c).__name__ for c in walk(tree) if part and c._path == part), "") if tree else ""
    mend = missing(path, _variables_first(known, part, tree), kind)
    if plain in known and plain != path and "]." not in path:
        mend = f"; indices are whole numbers in brackets, such as `{plain}[0]`."
    if path.endswith(FILES):
        mend = "; the name of a file is given by path=..."
    return f"there is no `{shown_name(path)}` in the model{mend}"


def _variables_first(known: list[str], part: str, tree: Component | None) -> list[str]:
    """The names, the variables of a part before its parameters."""
    owner = next((c for c in walk(tree) if c._path == part), None) if tree else None
    if owner is None:
        return known
    own = {join(part, name) for name, declared in owner.fields.items() if isinstance(declared, Variable)}
    return sorted(known, key=lambda name: name not in own)


def _of_derivative(name: str, known: list[str], tree: Component | None) -> str:
    same = _equal_to(tree, f"der({name})") if tree else ""
    if same:
        return f"Read `{same}`, which the model sets equal to it."
    free = f"{re.sub(r'[^0-9A-Za-z_].*', '', name.rpartition('.')[2])}_dot"
    while free in known:
        free += "_"
    return f"Declare one and give it the equation: {free} == der({name})."


def _equal_to(tree: Component, derivative: str) -> str:
    """Return the path of a variable that an equation sets equal to a derivative, "" if there is none."""
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
        return ""  # a hint, no more
    finally:
        PENDING.reset(token)
    return ""
