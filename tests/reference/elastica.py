"""Inextensible cantilever bent far by a transverse force at its tip that keeps its direction."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc


def tip_force(load: float) -> tuple[float, float, float]:
    """Return x and y of the tip in parts of the length, and the angle of its tangent in rad.

    Bisshopp, Drucker, Large deflections of cantilever beams, Quarterly of Applied Mathematics 3 (1945), with Legendre's
    elliptic integrals of the parameter m = (1 + sin(angle)) / 2.

    Parameters
    ----------
    load : float
        Force times length squared over bending stiffness, positive.
    """

    def root_load(angle: float) -> float:
        m, start = _modulus(angle)
        return ellipk(m) - ellipkinc(start, m) - np.sqrt(load)

    angle = float(brentq(root_load, 1e-9, np.pi / 2 - 1e-12, xtol=1e-15))
    m, start = _modulus(angle)
    y = 1 - 2 * (ellipe(m) - ellipeinc(start, m)) / np.sqrt(load)
    return float(np.sqrt(2 * np.sin(angle) / load)), float(y), angle


def _modulus(angle: float) -> tuple[float, float]:
    m = (1 + np.sin(angle)) / 2
    return m, np.arcsin(1 / np.sqrt(2 * m))
