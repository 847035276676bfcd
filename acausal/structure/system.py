"""Structure of a model in integers, the input of the structural analysis."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class System:
    """Incidence of equations and variables; each derivative is a variable of its own.

    Parameters
    ----------
    rows : tuple of tuple of int
        Variables, derivatives included, in each equation.
    explicit : tuple of frozenset of int
        Variables that occur linearly with a coefficient of numbers and parameters.
    derivative : tuple of int
        Time derivative of each variable, or -1; no two variables share one.
    declared : mapping of int to tuple of int
        Variables in the declared derivative of a variable; such a variable has no `derivative`.
    defines : tuple of int
        Variable with a declared derivative that each equation defines, or -1.
    preference : tuple of int
        Preference of each variable to be a state: -2 never, -1 avoid, 0 default, 1 prefer, 2 always.
    monic : tuple of frozenset of int, optional
        Subset of `explicit` with coefficient 1 or -1, whose solution needs no division; default: all.
    pivots : tuple of frozenset of int, optional
        Subset of `explicit` whose coefficient is not small relative to the others of its equation, so that it can
        determine a dependent state; default: all.
    closures : mapping of int to tuple of int, optional
        Equations that close loops and may be redundant, with the variables of the substitute of each; they are
        differentiated as often as necessary, and hold at every level.

    """

    rows: tuple[tuple[int, ...], ...]
    explicit: tuple[frozenset[int], ...]
    derivative: tuple[int, ...]
    declared: Mapping[int, tuple[int, ...]]
    defines: tuple[int, ...]
    preference: tuple[int, ...]
    monic: tuple[frozenset[int], ...] = ()
    pivots: tuple[frozenset[int], ...] = ()
    closures: Mapping[int, tuple[int, ...]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("monic", "pivots"):
            if not getattr(self, name):
                object.__setattr__(self, name, self.explicit)
        if not len(self.rows) == len(self.explicit) == len(self.defines):
            raise ValueError("rows, explicit and defines must have one entry an equation")
        if len(self.derivative) != len(self.preference):
            raise ValueError("derivative and preference must have one entry a variable")

    @property
    def n_equations(self) -> int:
        """Number of equations."""
        return len(self.rows)

    @property
    def n_variables(self) -> int:
        """Number of variables, derivatives included."""
        return len(self.derivative)
