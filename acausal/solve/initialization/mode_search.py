"""Search for consistent modes: positions of all switches that agree with the values that they imply."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from acausal.policy import POLICY

MOST_TRIED = POLICY.switches.rounds + POLICY.switches.tries


class ModeSearch:
    """Fixed-point iteration on the mode, with principal pivoting and enumeration where it cycles.

    A saturation in the feedback of an acceleration may alternate between both limits although a solution lies between
    them. Then switches change one at a time, as in principal pivoting methods (Murty 1974), those that open before those
    that close, so that no step passes two limits. Where this cycles too, as with laws that are not monotone, all modes are
    enumerated by the number of switches that change, those of the cycle first.

    Parameters
    ----------
    switches : sequence of int
        Entries of a mode that are switches; the others are values that change with them, such as discrete variables.

    Attributes
    ----------
    cycle : list of arrays
        Modes that follow from each other without end; empty until one recurs.
    """

    def __init__(self, switches: Sequence[int]) -> None:
        self.switches = list(switches)
        self.cycle = list[np.ndarray]()
        self._seen = list[np.ndarray]()
        self._others: Iterator[np.ndarray] = iter(())

    @property
    def changing(self) -> list[int]:
        """Switches that change in the cycle, or in the last step if there is none."""
        last = self.cycle or self._seen[-2:]
        return [k for k in self.switches if any(a[k] != last[0][k] for a in last)]

    @property
    def count(self) -> int:
        """Number of modes that were tried."""
        return len(self._seen)

    def next(self, current: np.ndarray, found: np.ndarray) -> np.ndarray | None:
        """Return the next mode to try, None if none is left.

        Parameters
        ----------
        current, found : array
            A mode, and the one that its values imply; the same mode if it has no values.
        """
        if not self.cycle and not self._is_new(found):
            first = next(k for k, a in enumerate(self._seen) if np.array_equal(a, found))
            self.cycle = self._seen[first:]
            self._others = self._enumerated()
        mode = self._one_changed(current, found) if self.cycle else found
        if not self._is_new(mode):
            mode = next(filter(self._is_new, self._others), None)
        if mode is not None:
            self._seen.append(mode)
        return mode

    def _is_new(self, one: np.ndarray) -> bool:
        return not any(np.array_equal(a, one) for a in self._seen)

    def _one_changed(self, current: np.ndarray, found: np.ndarray) -> np.ndarray:
        """Return `found` with only one of the changed switches changed."""
        wrong = [k for k in self.switches if current[k] != found[k]]
        one = found.copy()
        one[wrong] = current[wrong]
        if wrong:
            first = max(wrong, key=current.__getitem__)
            one[first] = found[first]
        return one

    def _enumerated(self) -> Iterator[np.ndarray]:
        """Yield all modes, those that differ from modes of the cycle in the fewest switches first."""
        changing = self.changing
        order = changing + [k for k in self.switches if k not in changing]
        for n in range(1, len(order) + 1):
            for one in self.cycle:
                for places in map(list, combinations(order, n)):
                    other = one.copy()
                    other[places] = one[places] == 0
                    yield other
