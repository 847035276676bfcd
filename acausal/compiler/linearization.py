"""Value and Jacobian of a compiled model at one point."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy


def with_entries(pattern: scipy.sparse.csc_matrix, entries: np.ndarray) -> scipy.sparse.csc_matrix:
    """Return a matrix with the pattern of another and new entries.

    The arrays of the pattern are shared: the constructor would check them again, which takes ten times as long.
    """
    found = copy(pattern)
    found.data = entries
    return found


@dataclass(frozen=True, eq=False)
class PointLinearization:
    """Value and Jacobian of the model at one point.

    `value` stacks `ode`, `alg` and `conditions`; `entries` are the nonzeros of their derivatives by (x, z), in the order of
    `pattern`. The matrix is built on demand: that takes as long as the evaluation.
    """

    value: np.ndarray
    entries: np.ndarray
    pattern: scipy.sparse.csc_matrix

    @cached_property
    def jacobian(self) -> scipy.sparse.csc_matrix:
        """The Jacobian as a sparse matrix."""
        return with_entries(self.pattern, self.entries)

    def terms(self, sizes: np.ndarray) -> np.ndarray:
        """Return |entry| times the nominal size of its unknown, in the order of `entries`."""
        return np.abs(self.entries) * np.repeat(sizes, np.diff(self.pattern.indptr))

    def magnitudes(self, sizes: np.ndarray) -> np.ndarray:
        """Return the sum of these terms in each row."""
        return np.bincount(self.pattern.indices, self.terms(sizes), minlength=self.pattern.shape[0])
