"""Value and Jacobian of a compiled model at one point."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy


def with_entries(pattern: scipy.sparse.csc_matrix, entries: np.ndarray) -> scipy.sparse.csc_matrix:
    """Return a matrix of the sparsity of another one, which it shares; the constructor checks it again, ten times as long."""
    found = copy(pattern)
    found.data = entries
    return found


@dataclass(frozen=True, eq=False)
class PointLinearization:
    """Value and Jacobian of the model at one point.

    `ode`, `alg` and `conditions` are stacked in `value`; `entries` are those of their derivatives by (x, z), where `pattern`
    has them. A matrix is made where one is needed: that takes as long as evaluating them.
    """

    value: np.ndarray
    entries: np.ndarray
    pattern: scipy.sparse.csc_matrix

    @cached_property
    def jacobian(self) -> scipy.sparse.csc_matrix:
        """The derivatives as a matrix."""
        return with_entries(self.pattern, self.entries)

    def terms(self, sizes: np.ndarray) -> np.ndarray:
        """Return the sizes of the terms of the derivatives, in the order of `entries`, for unknowns of some sizes."""
        return np.abs(self.entries) * np.repeat(sizes, np.diff(self.pattern.indptr))

    def magnitudes(self, sizes: np.ndarray) -> np.ndarray:
        """Return the sum of the sizes of the terms in each row, for unknowns of some sizes."""
        return np.bincount(self.pattern.indices, self.terms(sizes), minlength=self.pattern.shape[0])
