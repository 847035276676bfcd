"""System extended by derivatives of its equations."""

from __future__ import annotations

from acausal.structure.system import System


class Extension:
    """Mutable copy of `system`; new equations and variables are appended."""

    def __init__(self, system: System) -> None:
        self.rows = list(system.rows)
        self.explicit = list(system.explicit)
        self.monic = list(system.monic)
        self.pivots = list(system.pivots)
        self.derivative = list(system.derivative)
        self.declared = system.declared
        self.defines = list(system.defines)
        self.preference = list(system.preference)
        self.differentiated: list[int] = []
        self.created: list[int] = []
        self.closures = system.closures
        # Successive derivatives of each equation of the system, itself included.
        self.levels = [[e] for e in range(system.n_equations)]

    def rate(self, variable: int) -> int:
        """Return the time derivative of a variable without declared derivative; create it if it is missing."""
        if self.derivative[variable] < 0:
            self.derivative[variable] = self.add_variable(preference=min(self.preference[variable], 0))
            self.created.append(variable)
        return self.derivative[variable]

    def differentiate(self, base: int) -> None:
        """Append one more time derivative of the equation `base` of the system."""
        equation = self.levels[base][-1]
        row, explicit = self.rows[equation], self.explicit[equation]
        rates = {variable: self.rate(variable) for variable in row if variable not in self.declared}
        expressions = [v for variable in row for v in self.declared.get(variable, ())]
        # A rate that also occurs in a coefficient or in a declared expression may occur nonlinearly.
        hidden = set(row).difference(explicit).union(expressions)
        self.rows.append(tuple(dict.fromkeys((*row, *rates.values(), *expressions))))
        solvable = {v: rate for v, rate in rates.items() if v in explicit and rate not in hidden}
        self.explicit.append(frozenset(solvable.values()))
        for kept in (self.monic, self.pivots):
            kept.append(frozenset(rate for v, rate in solvable.items() if v in kept[equation]))
        self.defines.append(-1)
        self.differentiated.append(equation)
        self.levels[base].append(len(self.rows) - 1)

    def differentiate_closure(self, base: int) -> None:
        """Differentiate a closure until it contains a variable without derivative, or no new variable.

        Its substitute is added at that level.
        """
        seen: set[int] = set()
        while not seen.issuperset(row := self.rows[self.levels[base][-1]]):
            if any(v not in self.declared and self.derivative[v] < 0 for v in row):
                break
            seen.update(row)
            self.differentiate(base)
        top = self.levels[base][-1]
        self.rows[top] = tuple(dict.fromkeys((*self.rows[top], *self.closures[base])))
        self.forbid(top)

    def forbid(self, equation: int) -> None:
        """Exclude an equation from explicit solution for a variable."""
        self.explicit[equation] = self.monic[equation] = self.pivots[equation] = frozenset()

    @property
    def lower(self) -> set[int]:
        """Equations whose derivative is in the system."""
        return {e for levels in self.levels for e in levels[:-1]}

    def add_variable(self, derivative: int = -1, preference: int = 0) -> int:
        """Append a variable."""
        self.derivative.append(derivative)
        self.preference.append(preference)
        return len(self.derivative) - 1

    def add_equation(self, row: tuple[int, ...], explicit: tuple[int, ...], monic: tuple[int, ...]) -> int:
        """Append an equation."""
        self.rows.append(row)
        self.explicit.append(frozenset(explicit))
        self.monic.append(frozenset(monic))
        self.pivots.append(frozenset(explicit))
        self.defines.append(-1)
        return len(self.rows) - 1

    def system(self) -> System:
        """Return the extended system."""
        return System(
            tuple(self.rows),
            tuple(self.explicit),
            tuple(self.derivative),
            self.declared,
            tuple(self.defines),
            tuple(self.preference),
            tuple(self.monic),
            tuple(self.pivots),
        )
