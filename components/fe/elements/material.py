"""Linear elastic, isotropic material."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal import DeclarationError


@dataclass(frozen=True)
class Material:
    """Young's modulus E in Pa, Poisson's ratio nu, density rho in kg/m3.

    Raises
    ------
    DeclarationError
        If E or rho is not positive, or nu is not between -1 and 1/2: incompressible solids need mixed elements.
    """

    E: float
    nu: float
    rho: float

    def __post_init__(self) -> None:
        for name in ("E", "rho"):
            if not 0 < getattr(self, name) < np.inf:
                raise DeclarationError(f"{name} must be positive, not {getattr(self, name)!r}")
        if not -1 < self.nu < 0.5:
            raise DeclarationError(f"nu must lie between -1 and 0.5, not {self.nu!r}")

    @property
    def lame(self) -> tuple[float, float]:
        """Lame's constants lambda and mu in Pa."""
        return self.E * self.nu / ((1 + self.nu) * (1 - 2 * self.nu)), self.E / (2 * (1 + self.nu))

    def stiffness(self, gradients: np.ndarray) -> np.ndarray:
        """Return the stiffness blocks from the integrals of d_a N_i d_b N_j.

        Parameters
        ----------
        gradients : array, shape (3, 3, ...)
            The integrals for directions a and b; the other axes run over i and j.

        Returns
        -------
        array, shape (3, 3, ...)
            The integrals of lambda d_a N_i d_b N_j + mu d_b N_i d_a N_j + (a = b) mu grad N_i . grad N_j.
        """
        first, second = self.lame
        turned = np.swapaxes(gradients, 0, 1)
        trace = gradients[0, 0] + gradients[1, 1] + gradients[2, 2]
        unit = np.array([[trace * float(a == b) for b in range(3)] for a in range(3)])
        return first * gradients + second * (turned + unit)
