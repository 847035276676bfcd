"""How a leg of a run is integrated, and what is tried next where an integrator refuses."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from acausal.policy import POLICY
from acausal.solve.point import Point

RESCUE = POLICY.rescue


@dataclass(frozen=True)
class Way:
    """How to integrate a leg.

    Attributes
    ----------
    method : str
        Name in `METHODS`.
    moves : bool
        Whether the projection on the constraints moves along with them; the states are chosen once if not.
    tolerance : float
        Relative tolerance.
    max_steps : int or None
        Steps between two outputs after which to give up; None for the patience of the run.
    order : int or None
        Highest order of the multistep method; None for the limit of the run.
    """

    method: str
    moves: bool
    tolerance: float
    max_steps: int | None = None
    order: int | None = None


class Kind(Enum):
    """Why an integrator gave up."""

    STEPS = "it took more steps than are allowed between two outputs"
    CORRECTOR = "the equations could not be solved, however short the step"
    ERROR_TEST = "no step was short enough for the tolerance"
    ROUNDING = "the tolerance is smaller than rounding errors"
    WORN = "the coordinates that were chosen for the loops are no longer fit"
    UNFIT = "other constraints of the loops, of some that follow from one another, are to be kept"
    FLAT = "the loops pass a position in which their constraints are not independent"
    APART = "the loops came apart"
    UNSOLVABLE = "the equations have no solution there"
    UNDEFINED = "a condition has no value"
    DIVERGENCE = "states grow without bound"
    LIMIT = "the run is at a limit of steps or seconds"
    OTHER = "no way to go on was found"


@dataclass(frozen=True)
class Refusal:
    """Why and when an integrator gave up.

    Attributes
    ----------
    kind : Kind
        The kind of reason.
    time : float
        Where it had got to, in s.
    at : Point or None
        The last accepted point.
    """

    kind: Kind
    time: float
    at: Point | None = None


class Failure(Exception):
    """A run cannot go on; `time` is where, `reason` what to tell the user, which is all if there is no `kind`.

    `at` is the last accepted point, if the integrator knows one.
    """

    def __init__(self, time: float, reason: str, kind: Kind | None = None, at: Point | None = None) -> None:
        super().__init__(reason)
        self.time, self.reason, self.kind, self.at = time, reason, kind, at

    @classmethod
    def of(cls, refusal: Refusal) -> Failure:
        """Return the failure that a refusal is, if nothing else helps."""
        return cls(refusal.time, refusal.kind.value, refusal.kind, refusal.at)


@dataclass(frozen=True)
class Rescues:
    """What may be changed from one try to the next.

    Attributes
    ----------
    methods : tuple of str
        Methods that may be taken, the first one first; each may solve where the one before it does not, and the last one
        damps vibrations that the others follow.
    projects : bool
        Whether the projection may move where the chosen states become unsuitable.
    loops : bool
        Whether there are constraints; then any refusal except too many steps may be due to the chosen states.
    damps : bool
        Whether vibrations that the outputs cannot show may be damped.
    tolerance : float
        The requested tolerance.
    """

    methods: tuple[str, ...]
    projects: bool
    loops: bool
    damps: bool
    tolerance: float

    def wears(self, refusal: Refusal) -> bool:
        """Whether another choice of states may help."""
        return self.loops and refusal.kind is not Kind.STEPS

    def is_flat(self, way: Way, refusal: Refusal) -> bool:
        """Whether a refusal is due to a flat position of a loop: near it steps of the one-step method get short.

        Where there are vibrations, these may be why.
        """
        many = refusal.kind is Kind.STEPS and way.method == "following"
        return refusal.kind is Kind.FLAT or (many and self.loops and not self.damps)

    @property
    def careful(self) -> str:
        """The method with a Newton iteration, if it may be taken."""
        return "idas" if "idas" in self.methods else self.methods[0]

    def after(self, method: str) -> str:
        """Return the method that follows a refused one; the last one stays."""
        return self.methods[min(self.methods.index(method) + 1, len(self.methods) - 1)]


def next_way(way: Way, refusal: Refusal, rescues: Rescues) -> Way | None:
    """Return the way to go on after a refused one, None if there is none.

    Singular configurations of loops are left to the next method, which begins with chosen states. Where the chosen states became
    unfit, the projection moves. Where many steps follow vibrations that outputs do not show, these are damped. Else the method
    with a Newton iteration takes over.

    Parameters
    ----------
    way : Way
        The refused one.
    refusal : Refusal
        Why.
    rescues : Rescues
        What may be changed.
    """
    if rescues.is_flat(way, refusal):
        other = replace(way, method=rescues.after(way.method), moves=way.moves and not rescues.projects)
        return None if other.method == way.method else other
    changed = replace(way, moves=way.moves or (rescues.projects and rescues.wears(refusal)))
    if refusal.kind is Kind.STEPS and rescues.damps:
        changed = replace(changed, method=rescues.methods[-1])
    elif changed == way and way.method == rescues.methods[0]:
        changed = replace(changed, method=rescues.careful)
    return None if changed == way else changed


def rescue_ways(way: Way, rescues: Rescues) -> list[Way]:
    """Return the ways of one output interval where no way goes on: the other methods, then larger tolerances with all methods."""
    most = max(RESCUE.loosest, rescues.tolerance)
    looser = (min(float(f"{factor * rescues.tolerance:.6g}"), most) for factor in RESCUE.looser)
    return [
        replace(way, method=method, tolerance=tolerance, moves=way.moves or rescues.projects, max_steps=RESCUE.patient)
        for tolerance in dict.fromkeys(looser)
        for method in reversed(rescues.methods)
        if (method, tolerance) != (way.method, way.tolerance)
    ]
