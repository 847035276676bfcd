"""What was integrated so far."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np


@dataclass
class Trace:
    """What was integrated: rows of states, algebraic unknowns, integrals of supplied and dissipated power, modes."""

    times: list[np.ndarray] = field(default_factory=list)
    x: list[np.ndarray] = field(default_factory=list)
    z: list[np.ndarray] = field(default_factory=list)
    energy: list[np.ndarray] = field(default_factory=list)
    modes: list[np.ndarray] = field(default_factory=list)
    steps: int = 0
    factorisations: int = 0
    residual_evaluations: int = 0
    calls: int = 0
    choices: int = 0
    seconds: float = 0.0
    before: np.ndarray = field(default_factory=lambda: np.zeros(2))
    methods: dict[str, int] = field(default_factory=dict)
    loosened: list[float] = field(default_factory=list)

    def emptied(self) -> Trace:
        """Return a trace without rows in which the counts go on."""
        names = ("steps", "factorisations", "residual_evaluations", "calls", "choices", "seconds")
        return Trace(**{name: getattr(self, name) for name in names}, methods=dict(self.methods))

    def until(self, time: float) -> Trace:
        """Return the rows before a time, with the same counts."""
        cut = replace(self, times=[], x=[], z=[], energy=[], modes=[])
        for *rows, t in zip(self.x, self.z, self.energy, self.modes, self.times, strict=True):
            n = int(np.searchsorted(t, time))
            for kept, values in zip((cut.x, cut.z, cut.energy, cut.modes, cut.times), (*rows, t), strict=True):
                kept += [values[:n]] * (n > 0)
        return cut

    def count(self, stats: dict, plugin: str) -> int:
        """Add the counts of a call, and return its steps."""
        names = ("nsteps", "nlinsetups", "nfevals") if plugin == "idas" else ("n_steps", "n_jac", "n_rhs")
        steps, factorisations, evaluations = (int(stats.get(name, 0)) for name in names)
        self.calls += 1
        self.steps += steps
        self.factorisations += factorisations
        self.residual_evaluations += evaluations
        self.methods[plugin] = self.methods.get(plugin, 0) + steps
        return steps

    def put(self, call: int, x: np.ndarray, z: np.ndarray, modes: np.ndarray) -> None:
        """Put other values into the last row of a call, if there is one."""
        if len(self.x) >= -call:
            self.x[call][-1], self.z[call][-1] = x, z
            self.modes[call] = np.vstack([self.modes[call][:-1], modes])

    def spend(self, energy: np.ndarray) -> None:
        """Add supplied and dissipated energy to all that follows, and to the last row."""
        if self.energy:
            self.energy[-1][-1] += energy
        else:
            self.before = self.before + energy


@dataclass(frozen=True)
class Stretch:
    """Rows of one call: times, states, algebraic unknowns, integrals of power since its start; modes and steps."""

    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    energy: np.ndarray
    modes: np.ndarray
    steps: int

    def rows(self, first: int, last: int) -> Stretch:
        """Return some of the rows, as if the call had begun at its start all the same."""
        part = slice(first, last)
        return Stretch(self.times[part], self.x[part], self.z[part], self.energy[part], self.modes, self.steps)

    def every(self, parts: int) -> Stretch:
        """Return one row in so many, the last one of each."""
        part = slice(parts - 1, None, parts)
        return Stretch(self.times[part], self.x[part], self.z[part], self.energy[part], self.modes, self.steps)
