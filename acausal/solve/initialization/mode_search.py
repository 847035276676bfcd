"""Assignments of switches, of which one is looked for that fits the values that follow from it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from acausal.policy import POLICY

MOST = POLICY.switches.rounds + POLICY.switches.tries


class Assignments:
    """Each assignment follows from the values with the one before; where that repeats itself, others are tried.

    A saturation in the feedback of an acceleration may be carried from one limit to the other and back although there is
    one solution between them. Then conditions change one at a time, as in methods of principal pivots (Murty 1974), those
    first that no longer hold: two limits are not passed at once. Where that repeats itself too, as in laws that are not
    monotone, all ways are tried, the nearest first, and before others those in which nothing changes but what did.

    Parameters
    ----------
    switches : sequence of int
        Which entries of an assignment are switches that are open; the others are whatever else may change with them.

    Attributes
    ----------
    cycle : list of arrays
        Assignments that follow from each other without end; empty as long as none has come again.
    """

    def __init__(self, switches: Sequence[int]) -> None:
        self.switches = list(switches)
        self.cycle = list[np.ndarray]()
        self._seen = list[np.ndarray]()
        self._others: Iterator[np.ndarray] = iter(())

    @property
    def changing(self) -> list[int]:
        """Switches that change in the cycle, or changed at last where there is none."""
        last = self.cycle or self._seen[-2:]
        return [k for k in self.switches if any(a[k] != last[0][k] for a in last)]

    @property
    def count(self) -> int:
        """How many were tried."""
        return len(self._seen)

    def then(self, current: np.ndarray, found: np.ndarray) -> np.ndarray | None:
        """Return what is tried next, None if nothing is left.

        Parameters
        ----------
        current, found : array
            An assignment, and what follows from the values with it; the same where there are no values.
        """
        if not self.cycle and not self._is_new(found):
            first = next(k for k, a in enumerate(self._seen) if np.array_equal(a, found))
            self.cycle = self._seen[first:]
            self._others = self._beside()
        following = self._one_changed(current, found) if self.cycle else found
        if not self._is_new(following):
            following = next(filter(self._is_new, self._others), None)
        if following is not None:
            self._seen.append(following)
        return following

    def _is_new(self, one: np.ndarray) -> bool:
        return not any(np.array_equal(a, one) for a in self._seen)

    def _one_changed(self, current: np.ndarray, found: np.ndarray) -> np.ndarray:
        """What was found, but for all switches that change except one."""
        wrong = [k for k in self.switches if current[k] != found[k]]
        one = found.copy()
        one[wrong] = current[wrong]
        if wrong:
            first = max(wrong, key=current.__getitem__)
            one[first] = found[first]
        return one

    def _beside(self) -> Iterator[np.ndarray]:
        """Assignments beside those of the cycle, the nearest ones first."""
        changing = self.changing
        order = changing + [k for k in self.switches if k not in changing]
        for n in range(1, len(order) + 1):
            for one in self.cycle:
                for places in map(list, combinations(order, n)):
                    other = one.copy()
                    other[places] = one[places] == 0
                    yield other
