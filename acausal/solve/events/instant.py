"""Event iteration: what happens at one instant, until nothing changes."""

from __future__ import annotations

from dataclasses import replace
from typing import NoReturn

import numpy as np

from acausal.compiler.constants import Constants
from acausal.core import Doubt, Happened, Run
from acausal.errors import InitializationError
from acausal.solve.diagnosis.singularity import undetermined
from acausal.solve.events.redundant_laws import RedundantLaws
from acausal.solve.initialization.assembly import refuse_open_loops
from acausal.solve.initialization.newton import algebraic
from acausal.solve.integrate.core_run import make_run
from acausal.solve.integrate.functions import Functions
from acausal.solve.integrate.ladder import Failure
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem

WHATEVER = 2  # of `crossed` in the core: a condition changes now whatever its value


class Cycling(Exception):
    """The conditions of `guards` do not settle."""

    def __init__(self, guards: list[int]) -> None:
        super().__init__()
        self.guards = guards


class Instants:
    """Changes at single instants of a run.

    Parameters
    ----------
    problem : Problem
        The model.
    tolerance, span : float
        Relative tolerance, and length of the run in s.
    nominal : array
        Typical sizes of states and algebraic unknowns.
    energy : bool, optional
        Whether the run integrates powers.
    functions : Functions, optional
        Functions that are called at events; without them they keep their results.
    """

    def __init__(
        self,
        problem: Problem,
        tolerance: float,
        span: float,
        nominal: np.ndarray,
        energy: bool = False,
        functions: Functions | None = None,
    ) -> None:
        self.problem, self.tolerance, self.span, self.nominal, self.energy = problem, tolerance, span, nominal, energy
        self.guards, self.functions = problem.compiled.guards, functions
        self.watched = np.array(self.guards.watched, dtype=int)
        self.is_switch = self.watched < self.guards.n_switches
        self.redundant = RedundantLaws(problem.compiled)
        self._runs = dict[bool, Run]()

    def rates(self, at: Point) -> tuple[np.ndarray, np.ndarray]:
        """Watched excesses and their time derivatives."""
        value, rate = self.problem.indicators(Rows.of(at))
        return value[0], rate[0]

    def settle(
        self,
        at: Point,
        fired: list[int] | None = None,
        constants: Constants | None = None,
        due: np.ndarray | None = None,
        crossed: np.ndarray | None = None,
    ) -> tuple[Point, bool]:
        """Let everything happen that happens now; return the point after it, and whether anything did.

        Parameters
        ----------
        at : Point
            Just before.
        fired : list of int
            Conditions that become true by the clock.
        constants : Constants
            Those that hold by the clock from now on.
        due : array of bool
            Watched conditions that change now whatever their values; those that become true hold until their values change.
        crossed : array of bool
            Watched conditions that were found to change now.

        Raises
        ------
        Cycling
            If that does not come to an end.
        InitializationError
            If the equations have no solution after it.
        Failure
            If a jump is not allowed, or gives no finite number.
        """
        if not (len(self.guards.guards) or len(self.guards.laws)):
            return at, False
        none = np.zeros(len(self.watched), dtype=bool)
        changes = np.where(none if due is None else due, WHATEVER, none if crossed is None else crossed)
        fires = np.isin(self.guards.timed, fired or [])
        run = self._run(at)
        run.begin(
            *(at.time, at.x, at.z, self.problem.p, at.constants.vector, at.mode), step=0.0, tolerance=self.tolerance
        )
        found = run.happen((constants or at.constants).vector, fires, changes)
        x, z, c, mode, _ = run.values()
        self.redundant.name(run.redundant(len(self.guards.laws)))
        if not (found.changed or found.failed):
            return replace(at, mode=mode), False
        after = Point(at.time, x, z, self.problem.compiled.layout.constants(c), mode)
        if found.failed:
            self._refuse(found, after, run.message)
        return after, True

    def _run(self, at: Point) -> Run:
        """Return the run whose equations have the projection of a point."""
        moves = at.constants.moves is not False
        if moves not in self._runs:
            self._runs[moves] = make_run(
                *(self.problem, at, self.nominal, self.span, self.tolerance),
                energy=self.energy,
                moves=moves,
                functions=self.functions,
            )
        return self._runs[moves]

    def _contradiction(self, guards: list[int]) -> str:
        """Return the message for statements that set one variable to different values."""
        sets = [dict(zip(self.guards.jump(k)[1], self.guards.guards[k].jumps, strict=True)) for k in guards]
        common = sorted(set(sets[0]).intersection(*sets[1:]))
        names = ", ".join(f"`{sets[0][place].target}`" for place in common)
        statements = [
            f"{self.guards.guards[k].origin}, reinit of {', '.join(f'`{jump.target}`' for jump in jumps.values())}"
            for k, jumps in zip(guards, sets, strict=True)
        ]
        return (
            f"{len(guards)} statements set {names} to different values at one instant:\n  "
            + "\n  ".join(statements)
            + "\nJoin them, or let the condition of one exclude that of the other"
        )

    def _refuse(self, found: Happened, at: Point, message: str) -> NoReturn:
        """Raise the error of an iteration that failed at a point."""
        acts = np.array([*self.watched, *self.guards.timed], dtype=int)[found.acts].tolist()
        origins = list(dict.fromkeys(str(self.guards.guards[k].origin) for k in acts))
        match found.why:
            case Doubt.UNSETTLED:
                raise Cycling(acts)
            case Doubt.DISCONTINUOUS:
                raise Failure(at.time, message.partition(" s: ")[2].removesuffix("."))
            case Doubt.NO_NUMBER:
                raise Failure(
                    at.time,
                    f"{origins[0]}: reinit() gives no finite number; check what it divides by, and the arguments of sqrt, "
                    "log, acos",
                )
            case Doubt.APART:
                jumps = [place for k in acts for is_state, place in self.guards.jump(k)[1] if is_state]
                refuse_open_loops(self.problem, at, np.unique(jumps), ", ".join(origins))
            case Doubt.CONTRADICTION:
                raise Failure(at.time, self._contradiction(acts))
            case Doubt.FUNCTION if self.functions:
                self.functions.refuse()
        if text := undetermined(self.problem, algebraic(self.problem, at)):
            raise Failure(at.time, text)
        raise InitializationError("Newton's method does not converge")
