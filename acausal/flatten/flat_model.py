"""The flat model: all unknowns and equations of a model, simplified, with their names and origins."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from acausal.flatten.discontinuities import Guard, Promise
from acausal.flatten.origin import Origin
from acausal.language.component import Component
from acausal.units import Dimension


@dataclass(frozen=True)
class Initial:
    """A condition of the initial system: residual, what it says, and where."""

    residual: ca.SX
    text: str
    origin: Origin


@dataclass(frozen=True)
class FlatClosure:
    """A residual that closes a loop.

    Parameters
    ----------
    row : int
        The residual.
    dual : casadi.SX
        Flow that works on it, which is undetermined where the residual says nothing new.
    loop : int
        Number of its loop.
    """

    row: int
    dual: ca.SX
    loop: int


@dataclass(frozen=True)
class Loop:
    """A loop that is cut: the connection, its components, and what of its closing equations said nothing new.

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
class FlatModel:
    """A model as one list of scalar unknowns and one list of scalar equations.

    Parameters
    ----------
    unknowns, residuals : casadi.SX
        Columns. Derivatives that occur are unknowns of their own.
    names : tuple of str
        Name of each unknown in the user's words.
    derivative : tuple of int
        Unknown -> the unknown that is its time derivative, or -1.
    declared : mapping of int to casadi.SX
        Unknowns with a declared derivative.
    defines : tuple of int
        Residual -> the declared unknown that it defines, or -1.
    origins : tuple of Origin
        Where each residual comes from.
    preference, nominal, sized, units, start, guessed : arrays
        Attributes of the unknowns; `sized` tells where a nominal value is declared, `start` is a column of expressions
        of parameters.
    parameters : casadi.SX, parameter_names, parameter_values
        Free parameters.
    switches : tuple of (casadi.SX, casadi.SX)
        Mode symbols, and the expression that is negative while the mode is 1.
    guards : tuple of Guard
        Conditions that are watched: one for each switch, then one for each statement of jumps.
    discretes : tuple of (casadi.SX, casadi.SX)
        Symbols of the discrete variables, and their values at the start.
    continuous : tuple of (casadi.SX, Origin)
        Expressions that der() differentiates and that switches change: they must not jump.
    promises : tuple of Promise
        Laws that are said to be smooth.
    initial : tuple of Initial
        Fixed start values and initial equations.
    eliminated : (casadi.SX, casadi.SX)
        Removed symbols and what they are, in remaining unknowns.
    energies : mapping of str to casadi.SX
        Stored energy, dissipated and supplied power of the whole model, in original symbols.
    weighing : tuple of str
        Parameters that nominal values depend on.
    limits, bound, structural_zeros
        Bounds of parameters, parameters that follow others, and entries that were exactly 0.
    redundant : tuple of Origin
        Equations that said nothing new.
    closures, loops
        Residuals that close loops, and the loops.
    tree : Component
        The bound model, whose attributes hold the original symbols.
    counts : mapping of str to int
        Sizes on the way here.
    """

    unknowns: ca.SX
    residuals: ca.SX
    names: tuple[str, ...]
    derivative: tuple[int, ...]
    declared: Mapping[int, ca.SX]
    defines: tuple[int, ...]
    origins: tuple[Origin, ...]
    preference: tuple[int, ...]
    nominal: np.ndarray
    sized: np.ndarray
    units: tuple[Dimension | None, ...]
    start: ca.SX
    guessed: np.ndarray
    parameters: ca.SX
    parameter_names: tuple[str, ...]
    parameter_values: np.ndarray
    switches: tuple[tuple[ca.SX, ca.SX], ...]
    guards: tuple[Guard, ...]
    discretes: tuple[tuple[ca.SX, ca.SX], ...]
    continuous: tuple[tuple[ca.SX, Origin], ...]
    promises: tuple[Promise, ...]
    initial: tuple[Initial, ...]
    eliminated: tuple[ca.SX, ca.SX]
    energies: Mapping[str, ca.SX]
    weighing: tuple[str, ...]
    limits: tuple[Any, ...]
    bound: Mapping[str, str]
    structural_zeros: tuple[str, ...]
    redundant: tuple[Origin, ...]
    unconnected: tuple[str, ...]
    closures: tuple[FlatClosure, ...]
    loops: tuple[Loop, ...]
    tree: Component
    counts: Mapping[str, int]

    @property
    def modes(self) -> ca.SX:
        """Symbols that are constant between instants: modes of the switches, then discrete variables."""
        return ca.vertcat(*[mode for mode, _ in self.switches], *[symbol for symbol, _ in self.discretes])
