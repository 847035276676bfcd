"""What the inertia of a rigid body must be, whatever its shape."""

from __future__ import annotations

import numpy as np

ROUGH = 1e-3  # of the sum of the moments of inertia: published values are rounded
NEGATIVE = 1e-12  # of the largest principal moment: rounding of one that is 0
UNEQUAL = 1e-6  # of that sum: products of inertia that should be the same


def wrong_inertia(I: np.ndarray) -> str:
    """Return what is wrong with the inertia tensor of a body, "" if nothing is.

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
    principal = np.linalg.eigvalsh(I)
    if _has_density(I) or principal[0] >= -NEGATIVE * principal[2]:
        return ""
    return (
        f"is not the inertia of a body: of its principal moments, {', '.join(f'{moment:.4g}' for moment in principal)} kg.m2, "
        "none may be negative. Check its entries and the signs of its products, and that it is about the centre of mass"
    )


def unusual_inertia(I: np.ndarray) -> str:
    """Return what no mass distribution has of an inertia tensor that is accepted, "" if nothing is.

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
        f"{principal[0] + principal[1]:.4g} kg.m2, which no mass distribution has. It is taken as given: moments that were "
        "identified with motors and gears may be like that. If these were not, check its entries and the signs of its "
        "products, and that it is about the centre of mass"
    )


def _has_density(I: np.ndarray) -> bool:
    """Whether some mass distribution has an inertia tensor, up to rounding of published values.

    Its second moments, trace(I) / 2 E - I, have no negative eigenvalue: that is the triangle inequality in principal axes. Of
    a body that turns about one axis alone, the moments about the others may be left 0.
    """
    moments, trace = np.diag(I), np.trace(I)
    one_axis = np.count_nonzero(moments) < 2 and np.count_nonzero(I) == np.count_nonzero(moments)
    return bool(one_axis or np.linalg.eigvalsh(trace / 2 * np.eye(3) - I)[0] >= -ROUGH * trace)


def _axis(n: np.ndarray) -> str:
    """Name of a coordinate axis, or the entries of another one."""
    n = n * np.sign(n[np.argmax(np.abs(n))])
    k = int(np.argmax(n))
    return "xyz"[k] if n[k] > 1 - ROUGH else f"({', '.join(f'{entry:.3g}' for entry in n)})"
