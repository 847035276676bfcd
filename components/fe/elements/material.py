"""A linear elastic, isotropic solid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal import DeclarationError


@dataclass(frozen=True)
class Material:
    """Modulus of elasticity E in Pa, Poisson's ratio nu, density rho in kg/m3.

    Raises
    ------
    DeclarationError
        If E or rho is not positive, or nu not above -1 and below 1/2: an incompressible solid needs other elements.
    """

    E: float
    nu: float
    rho: float

    def __post_init__(self) -> None:
        for name in ("E", "rho"):
            if not 0 < getattr(self, name) < np.inf:
                raise DeclarationError(f"{name} of a solid is positive, not {getattr(self, name)!r}")
        if not -1 < self.nu < 0.5:
            raise DeclarationError(f"nu of a solid lies above -1 and below 0.5, which {self.nu!r} does not")

    @property
    def lame(self) -> tuple[float, float]:
        """Lame's constants lambda and mu in Pa."""
        return self.E * self.nu / ((1 + self.nu) * (1 - 2 * self.nu)), self.E / (2 * (1 + self.nu))

    def stiffness(self, gradients: np.ndarray) -> np.ndarray:
        """Stiffness blocks from the integrals of d_a N_i d_b N_j.

        Parameters
        ----------
        gradients : array, shape (3, 3, ...)
            The integrals for a and b; what follows runs over i and j.

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
