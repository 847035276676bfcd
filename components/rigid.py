"""Checks of the inertia tensor of a rigid body."""

from __future__ import annotations

import numpy as np

ROUGH = 1e-3  # violation of the triangle inequality over trace(I): published values are rounded to 3 digits
NEGATIVE = 1e-12  # negative principal moment over the largest one: round-off of a moment that is 0
UNEQUAL = 1e-6  # difference of I[i,j] and I[j,i] over trace(I): rounding of the specified products of inertia


def wrong_inertia(I: np.ndarray) -> str:
    """Return why an inertia tensor is invalid, "" if it is valid.

    Parameters
    ----------
    I : array, shape (3, 3)
        Inertia tensor about the centre of mass in kg.m2.
    """
    moments, trace = np.diag(I), np.trace(I)
    if not np.all(np.isfinite(I)):
        return "has entries that are not finite; a length or a direction that determines it is 0"
    if np.any(moments < 0):
        return f"has a negative moment of inertia about {'xyz'[int(np.argmin(moments))]}"
    if np.any(np.abs(I - I.T) > UNEQUAL * trace):
        i, j = np.unravel_index(np.argmax(np.abs(I - I.T)), I.shape)
        return f"is not symmetric: I[{i},{j}] is {I[i, j]:g} and I[{j},{i}] is {I[j, i]:g}; give both entries of each product"
    principal = np.linalg.eigvalsh(I)
    if _has_density(I) or principal[0] >= -NEGATIVE * principal[2]:
        return ""
    return (
        f"has a negative principal moment of inertia: {', '.join(f'{moment:.4g}' for moment in principal)} kg.m2. Check its "
        "entries and the signs of its products, and that it is about the centre of mass"
    )


def unusual_inertia(I: np.ndarray) -> str:
    """Return why an accepted inertia tensor belongs to no mass distribution, "" if one has it.

    Parameters
    ----------
    I : array, shape (3, 3)
        Inertia tensor about the centre of mass in kg.m2.
    """
    if wrong_inertia(I) or _has_density(I):
        return ""
    principal, axes = np.linalg.eigh(I)
    return (
        f"has a principal moment of {principal[2]:.4g} kg.m2 about {_axis(axes[:, 2])}, more than the sum of the other two, "
        f"{principal[0] + principal[1]:.4g} kg.m2. No mass distribution has this property, but moments identified together "
        "with motors and gears may, so the value is used as given. Otherwise check its entries and the signs of its "
        "products, and that it is about the centre of mass"
    )


def _has_density(I: np.ndarray) -> bool:
    """Return whether some mass distribution has this inertia tensor, up to rounding of published values.

    Criterion: the second moments trace(I) / 2 E - I have no negative eigenvalue, which is the triangle inequality of the
    principal moments. A body that rotates about one axis only may have zero moments about the others.
    """
    moments, trace = np.diag(I), np.trace(I)
    one_axis = np.count_nonzero(moments) < 2 and np.count_nonzero(I) == np.count_nonzero(moments)
    return bool(one_axis or np.linalg.eigvalsh(trace / 2 * np.eye(3) - I)[0] >= -ROUGH * trace)


def _axis(n: np.ndarray) -> str:
    """Return the name of a coordinate axis, or the entries of any other axis."""
    n = n * np.sign(n[np.argmax(np.abs(n))])
    k = int(np.argmax(n))
    return "xyz"[k] if n[k] > 1 - ROUGH else f"({', '.join(f'{entry:.3g}' for entry in n)})"
