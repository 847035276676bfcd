"""Flat model: simplified unknowns and equations of a model, with their names and origins."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import casadi as ca
import numpy as np

from acausal.flatten.discontinuities import Guard, Law, Promise
from acausal.flatten.origin import Origin
from acausal.flatten.stays_zero import ZeroBlock
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.external import External
from acausal.language.table import Table
from acausal.symbols import stacked
from acausal.units import Dimension


@dataclass(frozen=True)
class Initial:
    """An initial condition: residual, text, origin, and whether closed loops override it."""

    residual: ca.SX
    text: str
    origin: Origin
    soft: bool = False


@dataclass(frozen=True)
class FlatClosure:
    """A residual that closes a loop, or a constraint of a part.

    Parameters
    ----------
    row : int
        Number of the residual.
    dual : casadi.SX
        Flow that works on the residual, undetermined if the residual is redundant.
    loop : int
        Number of the loop, -1 for a constraint of a part.
    statement : int
        Number of the array equation, whose entries have one unit.
    """

    row: int
    dual: ca.SX
    loop: int
    statement: int


@dataclass(frozen=True)
class Loop:
    """A closed loop: the cut connection, its components, and its redundant closures.

    Parameters
    ----------
    a, b : str
        Paths of the two connected ports.
    where : str
        File and line of the connection.
    parts : tuple of str
        Paths of the components in the loop that have states.
    constraints : int
        Number of scalar equations that close the loop.
    dropped : int
        Number of redundant ones.
    undetermined : tuple of str
        Flows that the redundant equations leave undetermined, set to 0.
    kind : str
        Kind of the loop, for reports.
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
    """Scalar unknowns; derivatives are separate unknowns.

    Parameters
    ----------
    symbols : casadi.SX
        The unknowns, a column.
    names : tuple of str
        Name of each unknown, as the user declared it.
    derivative : tuple of int
        Position of the time derivative of each unknown, or -1.
    declared : mapping of int to casadi.SX
        Declared derivatives of unknowns.
    preference : tuple of int
        Preference of each as a state.
    nominal : array
        Nominal value of each.
    sized : array of bool
        True where the nominal value is declared.
    units : tuple of Dimension or None
        Unit of each, None if unknown.
    start : casadi.SX
        Start value of each, in parameters.
    guessed : array of bool
        True where the start value is from an instance.
    eliminated : (casadi.SX, casadi.SX)
        Eliminated symbols, and their expressions in the remaining unknowns.
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
        Residuals, a column.
    origins : tuple of Origin
        Origin of each residual.
    defines : tuple of int
        Unknown with a declared derivative that each residual defines, or -1.
    initial : tuple of Initial
        Fixed start values and initial equations.
    redundant : tuple of Origin
        Origins of redundant equations.
    eliminated_by : callable
        Origins of the equations that eliminated unknowns from a residual, as a function of its number.
    repeats : callable
        Redundant equations that close no loop, each followed by those that eliminated its unknowns.
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
    """Free and bound parameters.

    Parameters
    ----------
    symbols : casadi.SX
        Scalar free parameters, a column.
    names : tuple of str
        Name of each.
    values : array
        Value of each.
    weighing : tuple of str
        Parameters on which nominal values depend.
    limits : tuple of (str, casadi.SX, Parameter)
        Paths of parameters with bounds, their expressions in free ones, and their declarations.
    bound : mapping of str to str
        Parameters that depend on others, and the names of these.
    defaults : tuple of str
        Those that depend on others by default.
    structural_zeros : tuple of str
        Entries that were exactly 0 when compiled and have no symbol.
    tables : mapping of int to Table or External
        Tables by the entries that hold the number of their first column, and functions of other libraries by their number.
    raised : frozenset of int
        Those of these entries that stand in der(...).
    """

    symbols: ca.SX
    names: tuple[str, ...]
    values: np.ndarray
    weighing: tuple[str, ...]
    limits: tuple[tuple[str, ca.SX, f.Parameter], ...]
    bound: Mapping[str, str]
    defaults: tuple[str, ...]
    structural_zeros: tuple[str, ...]
    tables: Mapping[int, Table | External]
    raised: frozenset[int]

    @property
    def externals(self) -> list[External]:
        """The functions of other libraries."""
        return [own for own in self.tables.values() if isinstance(own, External)]


@dataclass(frozen=True)
class FlatDiscontinuities:
    """Switches, jumps and discrete variables, and expressions that must not jump.

    Parameters
    ----------
    switches : tuple of casadi.SX
        Symbols of the switches.
    guards : tuple of Guard
        Event conditions: one for each switch, which is 1 while the condition holds, then one for each `when`.
    discretes : tuple of (casadi.SX, casadi.SX)
        Symbols of the discrete variables, and their initial values.
    continuous : tuple of (casadi.SX, Origin)
        Operands of der() that depend on switches: they must not jump.
    promises : tuple of Promise
        Laws that are declared smooth.
    laws : tuple of Law
        Set-valued laws.
    kinks : tuple of (casadi.SX, casadi.SX)
        Parameters of tables whose arguments are linear in time, and the next times, after time, of their points.
    """

    switches: tuple[ca.SX, ...]
    guards: tuple[Guard, ...]
    discretes: tuple[tuple[ca.SX, ca.SX], ...]
    continuous: tuple[tuple[ca.SX, Origin], ...]
    promises: tuple[Promise, ...]
    laws: tuple[Law, ...]
    kinks: tuple[tuple[ca.SX, ca.SX], ...]

    @property
    def constants(self) -> ca.SX:
        """Symbols that are constant between events: switches, then discrete variables."""
        return stacked([*self.switches, *[symbol for symbol, _ in self.discretes]])


@dataclass(frozen=True)
class FlatLoops:
    """Closed loops and their closures, with the constraints of parts; `folded` are the redundant ones of these."""

    cuts: tuple[Loop, ...]
    closures: tuple[FlatClosure, ...]
    folded: tuple[Origin, ...] = ()

    @property
    def of_parts(self) -> list[int]:
        """Positions of the constraints of parts among the closures."""
        return [k for k, closure in enumerate(self.closures) if closure.loop < 0]


@dataclass(frozen=True)
class FlatModel:
    """A model as one list of scalar unknowns and one list of scalar equations.

    Parameters
    ----------
    unknowns, equations, parameters, discontinuities, loops
        Contents of the model.
    energies : mapping of str to casadi.SX
        Stored energy, dissipated and supplied power of the whole model, in original symbols, by name.
    unconnected : tuple of str
        Unconnected ports of parts.
    tree : Component
        The bound model, whose attributes hold the original symbols.
    counts : mapping of str to int
        Numbers of equations and unknowns before and after simplification.
    stays_zero : tuple of str
        Variables with a derivative that were eliminated as they stay 0 for ever, with their derivatives that have one.
    zero_block : callable, optional
        Returns their equations.
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
    stays_zero: tuple[str, ...] = ()
    zero_block: Callable[[], ZeroBlock] | None = None
