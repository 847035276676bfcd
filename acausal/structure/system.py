"""What the structural analysis sees of a model: integers only."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class System:
    """Incidence of equations and variables; each derivative is a variable of its own.

    Parameters
    ----------
    rows : tuple of tuple of int
        Variables (and derivatives) that occur in each equation.
    explicit : tuple of frozenset of int
        Those that occur linearly with a coefficient made of numbers and parameters only.
    derivative : tuple of int
        Variable that is the time derivative of each variable, or -1; no two variables share one.
    declared : mapping of int to tuple of int
        Variables of the declared expression of the derivative; such a variable has no `derivative`.
    defines : tuple of int
        Declared variable that each equation defines, or -1.
    preference : tuple of int
        Preference of each variable to be a state: -2 never, -1 avoid, 0 default, 1 prefer, 2 always.
    monic : tuple of frozenset of int, optional
        Those of `explicit` whose coefficient is 1 or -1, so that solving for them divides by nothing; default: all.
    pivots : tuple of frozenset of int, optional
        Those of `explicit` whose coefficient is not small beside the others of its equation, so that a state may follow from
        others through it; default: all.
    closures : mapping of int to tuple of int, optional
        Equations that may turn out to be redundant, and the variables of what then takes the place of each: they
        close loops, are differentiated as often as it takes, and hold at every level.

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
