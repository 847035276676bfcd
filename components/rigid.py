"""What the inertia of a rigid body must be, whatever its shape."""

from __future__ import annotations

import numpy as np

ROUGH = 1e-3  # of the sum of the moments of inertia: published values are rounded
UNEQUAL = 1e-6  # of that sum: products of inertia that should be the same


def wrong_inertia(I: np.ndarray) -> str:
    """Return what is wrong with the inertia tensor of a body, "" if nothing is.

    I is the inertia of a mass distribution if it is symmetric and trace(I) / 2 E - I, the second moments of the mass, has
    no negative eigenvalue: that is the triangle inequality in principal axes, and no moment is negative then. Of a body
    that turns about one axis alone, the moments about the others may be left 0.

    Parameters
    ----------
    I : array, shape (3, 3)
        Inertia tensor about the centre of mass in kg.m2.
    """
    moments, trace = np.diag(I), np.trace(I)
    if not np.all(np.isfinite(I)):
        return "has entries that are not numbers; a length or a direction that it follows from is 0"
    if np.any(moments < 0):
        return f"has a negative moment of inertia about {'xyz'[int(np.argmin(moments))]}"
    if np.any(np.abs(I - I.T) > UNEQUAL * trace):
        i, j = np.unravel_index(np.argmax(np.abs(I - I.T)), I.shape)
        return f"is not symmetric: I[{i},{j}] is {I[i, j]:g} and I[{j},{i}] is {I[j, i]:g}; give every product twice"
    one_axis = np.count_nonzero(moments) < 2 and np.count_nonzero(I) == np.count_nonzero(moments)
    if one_axis or np.linalg.eigvalsh(trace / 2 * np.eye(3) - I)[0] >= -ROUGH * trace:
        return ""
    principal = ", ".join(f"{moment:.4g}" for moment in np.linalg.eigvalsh(I))
    return (
        f"is not the inertia of a body: of its principal moments, {principal} kg.m2, none may exceed the sum of the "
        "other two. Check its entries and the signs of its products, and that it is about the centre of mass"
    )
