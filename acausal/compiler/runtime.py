"""The run-time object of a compiled model: its equations, events and constraints as the sections of a model file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import casadi as ca
import numpy as np

from acausal.compiler.compiled_model import CompiledModel
from acausal.compiler.core_equations import core_equations, core_motion, core_square, make_motion
from acausal.core import Equations, Square, make_equations, make_square, make_tape
from acausal.core.model_file import equations_sections, ints, tape_bytes
from acausal.instructions import READABLE
from acausal.language.functions import time
from acausal.symbols import dense, picked, stacked

VERSION = 9  # of the file format, as in unit.c
INNER = 4  # role of a parameter that no importer sees, as in instance.h
NOTHING = ca.SX(0, 1)
# Why what is differentiated must not jump, and what to do instead.
NO_DERIVATIVE = (
    "a jump has no derivative. Let the cases of piecewise meet where they switch: a speed by a ramp, "
    "piecewise((0, time < t1), (c * (time - t1), time < t2), c * (t2 - t1)), an angle with its slope as well; "
    "or let a state jump by when(..., reinit(...))"
)


@dataclass(frozen=True, eq=False)
class Runtime:
    """What the run-time takes of a compiled model.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    symbols : casadi.SX
        Parameters of the run-time: those of the model, and maybe others behind them. Without others, tapes and square systems
        are those with which Python evaluates the model.
    watched : list of int
        Conditions that are event indicators.
    levels : sequence of (rows, columns)
        Constraints that are closed together, positions first, and the states that they hold.
    closures : array of int
        Closure of each constraint, -1 where it is always independent.
    energies : bool
        Whether powers are integrated.
    varied : callable
        Returns an expression in which inputs vary with time.
    moves : bool
        Whether the projection of closed loops moves; the states are chosen once if not.
    """

    compiled: CompiledModel
    symbols: ca.SX
    watched: list[int]
    levels: Sequence[tuple[list[int], np.ndarray]]
    closures: np.ndarray
    energies: bool = False
    varied: Callable[[ca.SX], ca.SX] = lambda expression: expression
    moves: bool = True

    def moving(self, expression: ca.SX) -> ca.SX:
        """Return an expression with the projection of the run-time, where inputs vary."""
        projections = self.compiled.reduced.projections
        if projections.choice.numel():
            expression = ca.substitute(expression, projections.moves, self.moves)
        return self.varied(expression)

    @cached_property
    def running(self) -> tuple[ca.SX, ca.SX]:
        """Derivatives of the states, and residuals."""
        running = self.compiled.reduced.running
        return self.moving(running.ode), self.moving(running.alg)

    @property
    def _shares(self) -> bool:
        """Whether what Python evaluates serves the run-time as well."""
        return self.symbols is self.compiled.reduced.p

    @cached_property
    def equations(self) -> Equations:
        """The equations that are integrated."""
        if self._shares:
            return core_equations(self.compiled, self.moves)
        x, z, t, p, c = self._symbols
        return make_equations(x, z, t, p, c, *self.running, self.compiled.reduced.kinks)

    @cached_property
    def sections(self) -> dict[str, bytes]:
        """Sections that follow from the equations, by their tags; those of the start and of the clock are the caller's."""
        c, by_rows = self.compiled.constraints, self._by_rows
        return {
            **equations_sections(self.equations),
            **self._algebraic("settle", range(self.compiled.nz)),
            **by_rows,
            "guards": self.tape(self._excess),
            "scales": self.tape(_entries(self._slopes)),
            "scalesat": _pattern(self._slopes),
            "jumps": self.tape(self._jumps[0]),
            "jumpsto": ints([k for place in self._jumps[1] for k in place]),
            "given": self.tape(self.compiled.guards.calls.arguments),
            "closing": self.tape(ca.vertcat(self._constraints, _entries(self._closing))),
            **self._laws,
            "unbroken": self._continuous,
            "origins": self._origins,
            "coords": self.tape(self._coordinates[0]),
            "coordsto": ints(self._coordinates[1]),
            "closeat": _pattern(self._closing),
            "closures": ints(self.closures),
            "kinds": ints(c.kinds),
            "levels": b"".join(ints([len(rows), len(columns), *rows, *columns]) for rows, columns in self.levels),
            "followat": ints(c.multipliers) + ints(c.kept.T.ravel()),
        }

    def layout(self, counts: tuple[int, int, int], shown: int, timed: int, instants: int, inputs: int) -> bytes:
        """Return the section of numbers; `counts`: of switches, discrete variables and closures among the constants."""
        jumps, constraints = self._jumps[0].numel(), self.compiled.constraints.size
        watched, levels = len(self.watched), len(self.levels)
        return ints([*counts, shown, watched, timed, instants, jumps, constraints, inputs, levels])

    def rules(self, timed: Sequence[int]) -> dict[str, bytes]:
        """Return the sections of conditions, watched ones, then those of time alone, and of the functions that they call.

        Of each condition, the switch that it sets, whether it holds at 0 and acts at the start, its first jump, how many, and
        whether it compares time with discrete variables alone. Of each call, its condition, its first result, and how many.
        """
        guards, found, calls, results = self.compiled.guards, list[int](), list[int](), list[int]()
        first = np.cumsum([0, *(len(guard.jumps) for guard in guards.guards)]).tolist()
        clocked = dict(zip(guards.watched, guards.clocked, strict=True))
        order = [*self.watched, *timed]
        for k in order:
            guard = guards.guards[k]
            switch = k if k < guards.n_switches else -1
            numbers = switch, guard.inclusive, guard.at_start, first[k], len(guard.jumps), clocked.get(k, False)
            found += map(int, numbers)
        for k, call in guards.calls.ordered:
            calls += [order.index(k), len(results) // 2, len(call.results)]
            results += [place for pair in zip(call.outputs, call.results, strict=True) for place in pair]
        return {"rules": ints(found), "calls": ints(calls), "resultto": ints(results)}

    def tape(self, column: ca.SX) -> bytes:
        """Return an expression of x, z, time, parameters and constants as a section holds it."""
        return self._tape(self._symbols, column)

    def _tape(self, arguments: list[ca.SX], column: ca.SX) -> bytes:
        function = ca.Function("tape", arguments, [dense(self.moving(column))], READABLE)
        return tape_bytes(make_tape(function, early=(3, 4)))

    def square(
        self, name: str, residuals: ca.SX, argument: int | None, places: Sequence[int] | np.ndarray
    ) -> dict[str, bytes]:
        """Return equations for some entries of an argument, or where none is given for states and algebraic unknowns."""
        x, z, t, p, c = self._symbols
        residuals, places = self.moving(residuals), np.array(places, dtype=int)
        if argument is None:
            return self._square_sections(name, make_square([p, c, ca.vertcat(x, z), t], 2, residuals, 2, places))
        return self._square_sections(name, make_square([p, c, x, z, t], 2, residuals, argument, places))

    def _square_sections(self, name: str, square: Square) -> dict[str, bytes]:
        return {
            name: tape_bytes(square.tape),
            f"{name}at": ints(square.start) + ints(square.row),
            f"{name}of": ints(square.unknowns),
        }

    @cached_property
    def _symbols(self) -> list[ca.SX]:
        r = self.compiled.reduced
        return [r.x, r.z, time.sx, self.symbols, r.constants]

    def _algebraic(self, name: str, wanted: Iterable[int]) -> dict[str, bytes]:
        """Return the equations that determine some algebraic unknowns and all that these need."""
        unknowns, equations = self.compiled.dependence.needed(wanted)
        if self._shares:
            return self._square_sections(name, core_square(self.compiled, tuple(unknowns.tolist())))
        return self.square(name, picked(self.running[1], equations.tolist()), 3, unknowns)

    @property
    def _by_rows(self) -> dict[str, bytes]:
        """Indicators and energies, with the square systems of the algebraic unknowns that they need."""
        compiled, (x, z, t, p, c) = self.compiled, self._symbols
        parts = [self.moving(part) for part in compiled.guards.motion_of(self.watched)]
        moving, indicators = core_motion(compiled) if self._shares else make_motion([p, c, x, z, t], parts)
        energies = dense(self.moving(ca.vertcat(compiled.powers, compiled.energy))) if self.energies else NOTHING
        powers = make_tape(ca.Function("energies", [p, c, x, z, t], [energies], READABLE), early=(0, 1))
        nothing = make_square([p, c, x, z, t], 2, NOTHING, 3, np.arange(0))
        return {
            **self._algebraic("needed", compiled.dependence.inside(ca.veccat(*parts))),
            **self._algebraic("power", compiled.dependence.inside(energies)),
            **self._square_sections("moving", moving or nothing),
            "watched": tape_bytes(indicators),
            "energies": tape_bytes(powers),
        }

    @property
    def _excess(self) -> ca.SX:
        return picked(self.compiled.guards.excess, self.watched)

    @cached_property
    def _slopes(self) -> ca.SX:
        """Jacobian of the watched excesses by states and algebraic unknowns."""
        return ca.jacobian(self._excess, ca.vertcat(self.compiled.reduced.x, self.compiled.reduced.z))

    @cached_property
    def _jumps(self) -> tuple[ca.SX, list[tuple[int, int]]]:
        guards = self.compiled.guards
        values, places = list[ca.SX](), list[tuple[int, int]]()
        for k in range(len(guards.guards)):
            if guards.guards[k].jumps:
                call, to = guards.jump(k)
                values.append(call.function(*guards.arguments))
                places += [(int(is_state), place) for is_state, place in to]
        return stacked(values), places

    @property
    def _laws(self) -> dict[str, bytes]:
        """Tape of the set-valued laws, whose inputs end with nominal values, and places of their discrete variables."""
        laws, nz = self.compiled.guards.laws, self.compiled.nz
        nominal = ca.SX.sym("nominal", self.compiled.nx + nz)
        column, *slopes, order = NOTHING, ca.SX(nz, 0), ca.SX(nz, 0), np.arange(0)
        if len(laws):
            order = self.compiled.dependence.needed(range(nz))[1]
            column, *slopes = laws.column(nominal, order.tolist())
        return {
            "laws": self._tape([*self._symbols, nominal], column),
            "lawsto": ints(laws.places.ravel()),
            "lawsat": b"".join([ints(np.argsort(order)), *map(_pattern, slopes)]),
        }

    @property
    def _continuous(self) -> bytes:
        """Tape of what is differentiated; its inputs go on with nominal values, new constants and a time span."""
        guards, unknowns = self.compiled.guards, self._symbols[:2]
        nominal, span = ca.SX.sym("nominal", sum(part.numel() for part in unknowns)), ca.SX.sym("span")
        new = ca.SX.sym("new", self.compiled.reduced.constants.numel())
        column = NOTHING
        if guards.differentiated:
            column = ca.vertcat(*guards.continuous.function(*guards.arguments, new, nominal, span))
        return self._tape([*self._symbols, nominal, new, span], column)

    @property
    def _origins(self) -> bytes:
        """Origins of what is differentiated, then what to do where it jumps."""
        differentiated = self.compiled.guards.differentiated
        texts = [*map(str, differentiated), NO_DERIVATIVE] if differentiated else []
        return b"".join(text.encode() + b"\0" for text in texts)

    @property
    def _constraints(self) -> ca.SX:
        running = self.compiled.reduced.running
        return dense(running.constraints) if self.compiled.constraints.size else NOTHING

    @cached_property
    def _closing(self) -> ca.SX:
        return ca.jacobian(self._constraints, self.compiled.reduced.x)

    @cached_property
    def _coordinates(self) -> tuple[ca.SX, list[int]]:
        """Projected coordinates, and the states that stand for them."""
        r = self.compiled.reduced
        place = {v: k for k, v in enumerate(r.plan.states)}
        to = [place[p.state] for p in r.plan.constrained.projections]
        return (dense(r.running.resolve(r.projections.coordinates)) if to else NOTHING), to


def _entries(J: ca.SX) -> ca.SX:
    """Return the entries of a sparse matrix as a column."""
    return stacked(J.nz[:].elements()) if J.nnz() else NOTHING


def _pattern(J: ca.SX) -> bytes:
    """Return the sparsity of a matrix in columns as a section holds it."""
    return ints(J.sparsity().colind()) + ints(J.sparsity().row())
