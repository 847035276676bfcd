"""Lists of equations, as text and typeset."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, overload

SHARED = "with"  # origin of the equations of shared subexpressions
LISTED = 60  # equations that a text or a notebook shows
DERIVATIVE = re.compile(r"der\((.*)\)")
PATH = re.compile(r"[\w.\[\],]+")
GREEK = frozenset(
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi chi psi omega".split()  # noqa: SIM905
)


class ReadEquation(NamedTuple):
    """An equation of sympy, and the part and line that state it."""

    origin: str
    equation: Any


@dataclass(frozen=True)
class EquationList(Sequence[ReadEquation]):
    """Equations in sympy: printed as text, typeset in notebooks.

    Attributes
    ----------
    entries : tuple of ReadEquation
        Equations, sympy.Eq of scalars or of matrices, and their origins.
    part : str
        Path of the part; texts and formulas name the variables within it.
    """

    entries: tuple[ReadEquation, ...]
    part: str = ""

    def __len__(self) -> int:
        return len(self.entries)

    @overload
    def __getitem__(self, index: int) -> ReadEquation: ...
    @overload
    def __getitem__(self, index: slice) -> EquationList: ...
    def __getitem__(self, index: int | slice) -> ReadEquation | EquationList:
        return replace(self, entries=self.entries[index]) if isinstance(index, slice) else self.entries[index]

    @property
    def sympy(self) -> list[Any]:
        """The equations without their origins."""
        return [one.equation for one in self.entries]

    def latex(self) -> str:
        """Return the equations as one aligned formula in LaTeX."""
        return "\\begin{aligned}\n" + " \\\\\n".join(self.latex_rows()) + "\n\\end{aligned}"

    def latex_rows(self) -> list[str]:
        """Return each equation in LaTeX, with & before its equality sign."""
        import sympy

        rows = []
        for _, equation in self.entries:
            names = {symbol: typeset(self._own(symbol.name)) for symbol in equation.free_symbols}
            rows.append(" &= ".join(sympy.latex(side, symbol_names=names) for side in equation.args))
        return rows

    def __repr__(self) -> str:
        lines, origin = list[str](), ""
        for one in self.entries[:LISTED]:
            if one.origin != origin:
                lines.append(origin := one.origin)
            lines += [f"    {self._own(row)}" for row in _rows(one.equation)]
        more = len(self) - LISTED
        return "\n".join(
            [*lines, *([f'... and {more} more; those of one part: equations("PATH")'] if more > 0 else [])]
        )

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self[:LISTED].latex()}$" if self.entries else ""

    def _own(self, text: str) -> str:
        """Return a text with the names that variables have within the part."""
        return re.sub(rf"(?<![\w.]){re.escape(self.part)}\.", "", text) if self.part else text


def listed(equations: Iterable[ReadEquation], shared: Mapping[Any, Any], part: str) -> EquationList:
    """Return equations followed by those of the symbols that stand for shared subexpressions."""
    import sympy

    more = (ReadEquation(SHARED, sympy.Eq(symbol, value, evaluate=False)) for symbol, value in shared.items())
    return EquationList((*equations, *more), part)


def _rows(equation: Any) -> list[str]:
    """Return an equation as text, one row for each row of a matrix."""
    left, right = equation.args
    if not hasattr(left, "rows"):
        return [f"{left} = {right}"]
    return [f"{_row(a)} = {_row(b)}" for a, b in zip(left.tolist(), right.tolist(), strict=True)]


def _row(entries: list[Any]) -> str:
    return str(entries[0]) if len(entries) == 1 else f"[{', '.join(map(str, entries))}]"


def typeset(name: str) -> str:
    """Return the name of a variable in LaTeX, with part and index below and a dot for each derivative."""
    dots, inner = 0, name
    while found := DERIVATIVE.fullmatch(inner):
        inner, dots = found[1], dots + 1
    if not PATH.fullmatch(inner) or dots > 3:
        return f"\\mathrm{{{_escaped(name)}}}"
    path, _, own = inner.rpartition(".")
    own, _, index = own.partition("[")
    base, *below = own.split("_")
    text = f"\\{base}" if base in GREEK else base if len(base) == 1 else f"\\mathrm{{{base}}}"
    text = f"\\{'d' * dots}ot{{{text}}}" if dots else text
    small = [f"\\mathrm{{{_escaped(part)}}}" for part in (*below, path) if part]
    together = r",\,".join([*small, *([index[:-1]] if index else [])])
    return f"{text}_{{{together}}}" if together else text


def _escaped(text: str) -> str:
    return text.replace("_", "\\_")
