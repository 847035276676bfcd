"""The flat model: all unknowns and equations of a model, simplified, with their names and origins."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import casadi as ca
import numpy as np

from acausal.flatten.discontinuities import Guard, Law, Promise
from acausal.flatten.origin import Origin
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.symbols import stacked
from acausal.units import Dimension


@dataclass(frozen=True)
class Initial:
    """A condition of the initial system: residual, what it says, where, and whether closed loops override it."""

    residual: ca.SX
    text: str
    origin: Origin
    soft: bool = False


@dataclass(frozen=True)
class FlatClosure:
    """A residual that closes a loop, or a constraint that a part states.

    Parameters
    ----------
    row : int
        The residual.
    dual : casadi.SX
        Flow that works on it, undetermined where the residual is redundant.
    loop : int
        Number of its loop, -1 for a constraint of a part.
    statement : int
        Number of the equation of arrays that it is an entry of: these have one unit.
    """

    row: int
    dual: ca.SX
    loop: int
    statement: int


@dataclass(frozen=True)
class Loop:
    """A loop that is cut: the connection, its components, and which of its closures were redundant.

    Parameters
    ----------
    a, b : str
        Paths of the two connected ports.
    where : str
        File and line of the connection.
    parts : tuple of str
        Paths of the components in the loop that move in themselves.
    constraints : int
        Scalar equations that close it.
    dropped : int
        Those that became 0 = 0.
    undetermined : tuple of str
        Flows that were left undetermined by them and are 0.
    kind : str
        What kind of loop it is.
    """

    a: str
    b: str
    where: str
    parts: tuple[str, ...]
    constraints: int
    dropped: int
    undetermined: tuple[str, ...]
    kind: str


@dataclass(frozen=True)
class FlatUnknowns:
    """Scalar unknowns; derivatives that occur are unknowns of their own.

    Parameters
    ----------
    symbols : casadi.SX
        The unknowns, a column.
    names : tuple of str
        Name of each in the user's words.
    derivative : tuple of int
        Unknown -> the unknown that is its time derivative, or -1.
    declared : mapping of int to casadi.SX
        Unknowns with a declared derivative.
    preference : tuple of int
        How much each is wanted as a state.
    nominal : array
        Typical size of each.
    sized : array of bool
        Whether that is declared.
    units : tuple of Dimension or None
        Unit of each, None where it is not known.
    start : casadi.SX
        Start value of each, in parameters.
    guessed : array of bool
        Whether an instance gives that.
    eliminated : (casadi.SX, casadi.SX)
        Symbols of the model that were removed, and what they are, in remaining unknowns.
    """

    symbols: ca.SX
    names: tuple[str, ...]
    derivative: tuple[int, ...]
    declared: Mapping[int, ca.SX]
    preference: tuple[int, ...]
    nominal: np.ndarray
    sized: np.ndarray
    units: tuple[Dimension | None, ...]
    start: ca.SX
    guessed: np.ndarray
    eliminated: tuple[ca.SX, ca.SX]


@dataclass(frozen=True)
class FlatEquations:
    """Scalar equations.

    Parameters
    ----------
    residuals : casadi.SX
        What is 0, a column.
    origins : tuple of Origin
        Where each residual comes from.
    defines : tuple of int
        Residual -> the unknown with a declared derivative that it defines, or -1.
    initial : tuple of Initial
        Fixed start values and initial equations.
    redundant : tuple of Origin
        Redundant equations.
    eliminated_by : callable
        From a residual to the equations that gave the unknowns that were removed from it.
    repeats : callable
        Redundant equations that close no loop, each followed by those that gave its unknowns.
    """

    residuals: ca.SX
    origins: tuple[Origin, ...]
    defines: tuple[int, ...]
    initial: tuple[Initial, ...]
    redundant: tuple[Origin, ...]
    eliminated_by: Callable[[int], tuple[Origin, ...]]
    repeats: Callable[[], tuple[tuple[Origin, ...], ...]]


@dataclass(frozen=True)
class FlatParameters:
    """Free parameters, and what is known of the others.

    Parameters
    ----------
    symbols : casadi.SX
        Scalar free parameters, a column.
    names : tuple of str
        Name of each.
    values : array
        Value of each.
    weighing : tuple of str
        Those that nominal values depend on.
    limits : tuple of (str, casadi.SX, Parameter)
        Paths of bounded parameters, what they are in free ones, and their declarations with the bounds.
    bound : mapping of str to str
        Parameters that follow others, and what they follow.
    structural_zeros : tuple of str
        Entries that were exactly 0 and have no symbol.
    """

    symbols: ca.SX
    names: tuple[str, ...]
    values: np.ndarray
    weighing: tuple[str, ...]
    limits: tuple[tuple[str, ca.SX, f.Parameter], ...]
    bound: Mapping[str, str]
    structural_zeros: tuple[str, ...]


@dataclass(frozen=True)
class FlatDiscontinuities:
    """What changes at instants, and what must not.

    Parameters
    ----------
    switches : tuple of casadi.SX
        Symbols of the switches.
    guards : tuple of Guard
        Conditions that are watched: one for each switch, which is 1 while it holds, then one for each statement of
        jumps.
    discretes : tuple of (casadi.SX, casadi.SX)
        Symbols of the discrete variables, and their values at the start.
    continuous : tuple of (casadi.SX, Origin)
        Expressions that der() differentiates and that switches change: they must not jump.
    promises : tuple of Promise
        Laws that are declared smooth.
    laws : tuple of Law
        Set-valued laws.
    """

    switches: tuple[ca.SX, ...]
    guards: tuple[Guard, ...]
    discretes: tuple[tuple[ca.SX, ca.SX], ...]
    continuous: tuple[tuple[ca.SX, Origin], ...]
    promises: tuple[Promise, ...]
    laws: tuple[Law, ...]

    @property
    def constants(self) -> ca.SX:
        """Symbols that are constant between instants: switches, then discrete variables."""
        return stacked([*self.switches, *[symbol for symbol, _ in self.discretes]])


@dataclass(frozen=True)
class FlatLoops:
    """Loops that are cut, the residuals that close them and the constraints that parts state; `folded` became 0 = 0 of these."""

    cuts: tuple[Loop, ...]
    closures: tuple[FlatClosure, ...]
    folded: tuple[Origin, ...] = ()

    @property
    def of_parts(self) -> list[int]:
        """Places of the constraints of parts among the closures."""
        return [k for k, closure in enumerate(self.closures) if closure.loop < 0]


@dataclass(frozen=True)
class FlatModel:
    """A model as one list of scalar unknowns and one list of scalar equations.

    Parameters
    ----------
    unknowns, equations, parameters, discontinuities, loops
        What the model consists of.
    energies : mapping of str to casadi.SX
        Stored energy, dissipated and supplied power of the whole model, in original symbols.
    unconnected : tuple of str
        Ports of parts that nothing is connected to.
    tree : Component
        The bound model, whose attributes hold the original symbols.
    counts : mapping of str to int
        Sizes on the way here.
    """

    unknowns: FlatUnknowns
    equations: FlatEquations
    parameters: FlatParameters
    discontinuities: FlatDiscontinuities
    loops: FlatLoops
    energies: Mapping[str, ca.SX]
    unconnected: tuple[str, ...]
    tree: Component
    counts: Mapping[str, int]
