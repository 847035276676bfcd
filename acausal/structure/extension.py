"""A system that grows by the derivatives of its equations."""

from __future__ import annotations

from acausal.structure.system import System


class Extension:
    """Mutable copy of `system`; new equations and variables are appended."""

    def __init__(self, system: System) -> None:
        self.rows = list(system.rows)
        self.explicit = list(system.explicit)
        self.monic = list(system.monic)
        self.derivative = list(system.derivative)
        self.declared = system.declared
        self.defines = list(system.defines)
        self.preference = list(system.preference)
        self.differentiated: list[int] = []
        self.created: list[int] = []

    def rate(self, variable: int) -> int:
        """Time derivative of an undeclared variable, created if it is missing."""
        if self.derivative[variable] < 0:
            self.derivative[variable] = len(self.derivative)
            self.derivative.append(-1)
            self.preference.append(min(self.preference[variable], 0))
            self.created.append(variable)
        return self.derivative[variable]

    def differentiate(self, equation: int) -> int:
        """Append the time derivative of `equation` and return its index."""
        row, explicit = self.rows[equation], self.explicit[equation]
        rates = {variable: self.rate(variable) for variable in row if variable not in self.declared}
        expressions = [v for variable in row for v in self.declared.get(variable, ())]
        # A rate that also occurs in a coefficient or in a declared expression need not be linear.
        hidden = set(row).difference(explicit).union(expressions)
        self.rows.append(tuple(dict.fromkeys((*row, *rates.values(), *expressions))))
        solvable = {v: rate for v, rate in rates.items() if v in explicit and rate not in hidden}
        self.explicit.append(frozenset(solvable.values()))
        self.monic.append(frozenset(rate for v, rate in solvable.items() if v in self.monic[equation]))
        self.defines.append(-1)
        self.differentiated.append(equation)
        return len(self.rows) - 1

    def system(self) -> System:
        """The extended system."""
        return System(
            tuple(self.rows),
            tuple(self.explicit),
            tuple(self.derivative),
            self.declared,
            tuple(self.defines),
            tuple(self.preference),
            tuple(self.monic),
        )
