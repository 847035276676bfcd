"""What happens at one instant: switches flip, variables jump and algebraic unknowns follow until nothing changes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.compiler.constants import Constants
from acausal.compiler.runtime import NO_DERIVATIVE
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.events.follow import follow
from acausal.solve.events.laws import Laws
from acausal.solve.initialization.assembly import refuse_open_loops
from acausal.solve.initialization.mode_search import MOST_TRIED, ModeSearch
from acausal.solve.initialization.newton import algebraic
from acausal.solve.integrate.ladder import Failure
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem

INSTANTS = POLICY.instants
HUGE = np.finfo(float).max / 8  # sums of some of it are finite


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
    """

    def __init__(self, problem: Problem, tolerance: float, span: float, nominal: np.ndarray) -> None:
        self.problem, self.tolerance, self.span, self.nominal = problem, tolerance, span, nominal
        self.guards = problem.compiled.guards
        self.watched = np.array(self.guards.watched, dtype=int)
        self.is_switch = self.watched < self.guards.n_switches
        self.laws = Laws(problem, tolerance, nominal)
        self._clocked = np.array(self.guards.clocked, dtype=bool)

    def width(self, at: Point) -> np.ndarray:
        """How far each watched excess may be off by the tolerance; one of time alone as in a run of 1 s at most."""
        here = at.x, at.z, self.problem.p, at.time, at.constants.vector
        scale = np.nan_to_num(self.guards.scale(*here, self.nominal)[0])
        return self.tolerance * np.where(scale > 0, scale, min(self.span, 1.0))

    def rates(self, at: Point) -> tuple[np.ndarray, np.ndarray]:
        """Watched excesses and their time derivatives."""
        value, rate = self.problem.indicators(Rows.of(at))
        return value[0], rate[0]

    def holds(self, at: Point, crossed: np.ndarray) -> np.ndarray:
        """Which watched conditions hold from now on; what passes 0 just now counts as passed."""
        value, rate = self.rates(at)
        width = self.width(at)
        moving = np.abs(rate) * self.span > INSTANTS.moves * width
        rounding = POLICY.agenda.added * max(self.span, POLICY.agenda.late * abs(at.time))
        reach = np.where(self._clocked, rounding, INSTANTS.short * self.span)
        soon = crossed | (np.abs(value) <= np.abs(rate) * reach)
        near = moving & (np.abs(value) <= width) & soon
        return np.where(near, rate < 0, np.where(value == 0, at.mode, value < 0))

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
            EventConditions whose condition becomes true by the clock.
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
        """
        fires, changed = list(fired or []), self.laws.undecided(at.constants)
        if changed:  # at the start: their conditions mean nothing before
            at = self._decided(at)
            constants = constants and replace(constants, discretes=at.constants.discretes)
        after = constants or at.constants
        moved, tried = list[int](), ModeSearch(range(int(np.sum(self.is_switch))))
        none = np.zeros(len(self.watched), dtype=bool)
        due, crossed, forced = none if due is None else due, none if crossed is None else crossed, ~at.mode
        before = self.rates(at)[0] if due.any() else none
        for _ in range(MOST_TRIED):
            now = np.where(due, forced, self.holds(at, crossed)) if len(self.watched) else at.mode
            flips = self.is_switch & (now != at.mode)
            fires += self.watched[~self.is_switch & now & ~at.mode].tolist()
            if not flips.any() and not fires and after is at.constants:
                return replace(at, mode=now), changed
            moved = self.watched[flips].tolist() + fires
            if flips.any():
                now = self._wanted(tried, at, now, after.discretes)
                fires = [] if tried.cycle else fires  # until switches are found that fit, nothing acts
            try:
                at = self._after(at, now, fires, after)
            except (InitializationError, Failure):
                if not (tried.cycle and flips.any()):
                    raise
            fires, changed, after = [], True, at.constants
            if due.any():
                due = due & (~forced | (np.abs(self.rates(at)[0] - before) <= self.width(at)))
        raise Cycling(moved)

    def _wanted(self, tried: ModeSearch, at: Point, now: np.ndarray, discretes: np.ndarray) -> np.ndarray:
        """Return what holds next: what follows from the values, and where that repeats itself, other switches."""
        current, found = (np.concatenate([one[self.is_switch], at.x, discretes]) for one in (at.mode, now))
        following = tried.next(current, found)
        if following is None:
            raise Cycling(self.watched[self.is_switch][tried.changing].tolist())
        if not tried.cycle:
            return now
        wanted = at.mode.copy()
        wanted[self.is_switch] = following[: len(tried.switches)] > 0
        return wanted

    def _after(self, at: Point, now: np.ndarray, fires: list[int], constants: Constants) -> Point:
        """Return the point after some conditions hold from now on and others act, with constants of the clock."""
        changed = now != at.mode
        flips = self.is_switch & changed
        jumped = self._jump(at, fires, constants.switched(self.watched[flips], now[flips]))
        self._refuse_jumps(at, jumped.constants, self._leeway(at, changed))
        decided = self._decided(jumped, at.constants)
        if fires and (parted := self.laws.parted(decided)) is not decided:
            decided = self._decided(parted)
        return replace(decided, mode=now)

    def _decided(self, at: Point, before: Constants | None = None) -> Point:
        """Return the point with set-valued laws at rest decided, and the algebraic unknowns solved for."""
        return algebraic(self.problem, self.laws.decided(before or at.constants, at))

    def _leeway(self, at: Point, changed: np.ndarray) -> float:
        """Time in which conditions that change move as far as what they compare typically does; none where the clock acts.

        The instant of a condition that is searched is known no better than what it compares. One that changes together with
        another one may be away from its own instant: that counts in full.
        """
        if not (self.guards.differentiated and changed.any()):
            return 0.0
        here = at.x, at.z, self.problem.p, at.time, at.constants.vector
        far = np.nan_to_num(self.guards.scale(*here, self.nominal)[0])
        value, rate = np.nan_to_num(self.rates(at))
        times = (far + np.abs(value) / INSTANTS.jump) / np.maximum(np.abs(rate), np.finfo(float).tiny)
        return min(self.span, float(np.max(times[changed])))

    def _refuse_jumps(self, at: Point, constants: Constants, leeway: float) -> None:
        """Refuse that something jumps of which a derivative is in the equations."""
        if not self.guards.differentiated:
            return
        here = at.x, at.z, self.problem.p, at.time, at.constants.vector
        both = [at.constants.vector, constants.vector]
        found = [np.array(self.guards.continuous(*here, new, self.nominal, leeway)) for new in both]
        (before, size, terms), (after, size_after, terms_after) = np.nan_to_num(found, posinf=HUGE, neginf=-HUGE)
        jumps = np.abs(after - before)
        excess = jumps - INSTANTS.jump * (np.abs(before) + np.abs(after) + size + size_after)
        excess -= INSTANTS.rounding * (terms + terms_after)
        worst = int(np.argmax(excess))
        if excess[worst] > 0:
            raise Failure(
                at.time,
                f"what is differentiated at {self.guards.differentiated[worst]} jumps by {jumps[worst]:.4g}; {NO_DERIVATIVE}",
            )

    def _jump(self, at: Point, fires: list[int], constants: Constants) -> Point:
        """Return the point with states and discrete variables after jumps that are computed from the values before.

        In closed loops the other states follow, by the least change that keeps the loops closed.
        """
        before, discretes, jumped = self.problem.projected(at), constants.discretes.copy(), []
        x = before.x.copy()
        for guard in sorted(fires):  # of statements that set the same variable, the later one counts
            call, places = self.guards.jump(guard)
            values = call(at.x, at.z, self.problem.p, at.time, at.constants.vector)[0]
            if not np.all(np.isfinite(values)):
                raise Failure(
                    at.time,
                    f"{self.guards.guards[guard].origin}: reinit() gives no finite number; check what it divides by, and the "
                    "arguments of sqrt, log, acos",
                )
            for (is_state, place), value in zip(places, values, strict=True):
                (x if is_state else discretes)[place] = value
                jumped += [place] * is_state
        after = replace(at, x=x, constants=replace(constants, discretes=discretes))
        if not jumped or not self.problem.compiled.constraints.size:
            return after
        held = np.array(jumped, dtype=int)
        after, mismatch = follow(self.problem, before, after, held)
        if not mismatch <= POLICY.loops.closed:
            where = ", ".join(dict.fromkeys(str(self.guards.guards[guard].origin) for guard in fires))
            refuse_open_loops(self.problem, after, held, where)
        # From what coordinates were before, an iteration may come to others.
        return self.problem.completed(after)
