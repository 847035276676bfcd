"""What a tape computes from one of its arguments alone, where that meets the others."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from itertools import pairwise

import numpy as np

from acausal.core.tape import Tape


def laws_of(tape: Tape, argument: int, free: Collection[int]) -> Tape | None:
    """Return the tape of all laws of one argument, None if there are none.

    Parameters
    ----------
    tape : Tape
        The operations.
    argument : int
        Which argument the laws are of.
    free : collection of int
        Arguments that they may hold besides: those that are constant.

    Returns
    -------
    Tape or None
        Of the same arguments. Its outputs are results that depend on the argument and on none but free ones, and that a
        result which depends on others takes, or that are outputs themselves.
    """
    of_it, of_others = (np.zeros(tape.size, dtype=bool) for _ in range(2))
    own = len(tape.constants) + sum(tape.sizes)
    starts = len(tape.constants) + np.cumsum([0, *tape.sizes])
    for k, (first, last) in enumerate(pairwise(starts)):
        of_it[first:last] = k == argument
        of_others[first:last] = k != argument and k not in free
    if not (of_it[tape.first] | of_it[tape.second]).any():
        return None
    for here, (a, b) in enumerate(zip(tape.first.tolist(), tape.second.tolist(), strict=True), own):
        of_it[here] = of_it[a] or of_it[b]
        of_others[here] = of_others[a] or of_others[b]

    mixed = of_others[own:]
    taken = np.zeros(tape.size, dtype=bool)
    taken[tape.first[mixed]] = taken[tape.second[mixed]] = taken[tape.output] = True
    taken[:own] = False
    laws = np.flatnonzero(taken & of_it & ~of_others)
    return _ending(tape, laws, own) if laws.size else None


def _ending(tape: Tape, results: np.ndarray, own: int) -> Tape:
    """Return the part of a tape that ends in some of its results, which stand from `own` on."""
    needed = np.zeros(tape.size, dtype=bool)
    needed[results] = True
    for here in range(tape.size - 1, own - 1, -1):
        if needed[here]:
            needed[tape.first[here - own]] = needed[tape.second[here - own]] = True
    kept = np.flatnonzero(needed[own:])
    seat = np.arange(tape.size, dtype=np.int32)
    seat[own + kept] = own + np.arange(len(kept))
    runs, lengths = np.unique(np.repeat(np.arange(len(tape.kinds)), tape.lengths)[kept], return_counts=True)
    return replace(
        tape,
        kinds=tape.kinds[runs],
        lengths=lengths.astype(np.int32),
        first=seat[tape.first[kept]],
        second=seat[tape.second[kept]],
        early=int(np.sum(runs < tape.early)),
        outputs=(seat[results],),
    )
