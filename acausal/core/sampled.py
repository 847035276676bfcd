"""A model as the core runs it over instants that discrete variables plan."""

from __future__ import annotations

from ctypes import POINTER, Structure, c_int32, c_void_p, pointer
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from acausal.core.library import EquationsData, SquareData, TapeData
from acausal.core.rodas import Equations
from acausal.core.settle import Square
from acausal.core.tape import Tape


class SampledData(Structure):
    """What the library takes as a sampled model, see `core.h`."""

    _fields_ = (
        ("equations", POINTER(EquationsData)),
        *((name, POINTER(SquareData)) for name in ("whole", "needed", "moving", "powering")),
        *((name, POINTER(TapeData)) for name in ("energies", "watched", "acts", "project")),
        *((name, c_int32) for name in ("conditions", "jumps", "multipliers")),
        *((name, c_void_p) for name in ("is_switch", "is_clocked", "jump", "to", "coordinate", "multiplier")),
    )


@dataclass(frozen=True, eq=False)
class Sampled:
    """A model with conditions that are watched, and with jumps of its constants.

    The arguments of the squares and tapes are p, c, x, z, t, and what is named.

    Attributes
    ----------
    equations : Equations
        What is integrated.
    whole, needed : Square or None
        For all algebraic unknowns, and for those that conditions need.
    moving : Square or None
        For the rates of some of them, which come last.
    powering : Square or None
        For the algebraic unknowns that energies need.
    energies : Tape or None
        Supplied and dissipated power, stored energy; None where they are not asked for.
    watched : Tape
        Of these rates too: conditions, which hold where they are not positive; their rates.
    acts : Tape
        Of nominal values of x, z too: what these change in conditions; new values of jumps; instants that are planned.
    is_switch : array of int
        Of each condition, whether it is that of a switch.
    is_clocked : array of int
        Whether it compares time with discrete variables alone.
    jump : array of int
        Where the jumps of each condition begin; last, how many there are.
    to : array of int
        Place of each new value among the constants, -1 - place where a state jumps.
    project : Tape or None
        Where closed loops have coordinates, None where there are none.
    coordinate, multiplier : arrays of int
        Places of these coordinates among the states, and of what keeps them there among the algebraic unknowns.
    """

    equations: Equations
    whole: Square | None
    needed: Square | None
    moving: Square | None
    powering: Square | None
    energies: Tape | None
    watched: Tape
    acts: Tape
    is_switch: np.ndarray
    is_clocked: np.ndarray
    jump: np.ndarray
    to: np.ndarray
    project: Tape | None
    coordinate: np.ndarray
    multiplier: np.ndarray

    @cached_property
    def data(self) -> SampledData:
        """What the library takes; it holds addresses of the arrays of this model."""
        squares = (
            None if s is None else pointer(s.data) for s in (self.whole, self.needed, self.moving, self.powering)
        )
        tapes = (None if t is None else pointer(t.data) for t in (self.energies, self.watched, self.acts, self.project))
        places = (self.is_switch, self.is_clocked, self.jump, self.to, self.coordinate, self.multiplier)
        return SampledData(
            *(pointer(self.equations.data), *squares, *tapes),
            *(len(self.is_switch), len(self.to), len(self.multiplier)),
            *(array.ctypes.data for array in places),
        )
