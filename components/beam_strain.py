"""Strain of a beam: elastic and damping forces, and the shortening of the axis by its slope."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from acausal import as_expr, dot
from components.beam_element import beam_matrices, element_matrices


@dataclass(frozen=True)
class Strain:
    """Strain of N elements with nodal coordinates U = (u, v, l theta) in m.

    The axial strain of an element is the mean of u' + v'^2 / 2, the second term only with `second_order`: its mean instead
    of its value at each point, because linear u cannot balance the square of cubic v (membrane locking). The axial forces
    N of the elements then act on the slopes as well: the energy is the sum of N^2 l / (2 E A) and E J v''^2 / 2.

    Parameters
    ----------
    elements : int
        N.
    l, EA, EJ, beta : Expr
        Length of an element in m, stiffnesses in N and N.m2, and damping in proportion to stiffness in s.
    second_order : bool
        Whether the slope shortens the axis.
    """

    elements: int
    l: Any
    EA: Any
    EJ: Any
    beta: Any
    second_order: bool

    def slopes(self, U: Any, W: Any) -> list[Any]:
        """Integral of v' w' over each element, in m; 0 without second order."""
        if not self.second_order:
            return [as_expr(0.0)] * self.elements
        G = element_matrices().G
        return [dot(U[3 * j : 3 * j + 6], G @ W[3 * j : 3 * j + 6]) / self.l for j in range(self.elements)]

    def extension(self, U: Any) -> list[Any]:
        """Change of length of each element, in m."""
        return [U[3 * j + 3] - U[3 * j] + s / 2 for j, s in enumerate(self.slopes(U, U))]

    def extension_rate(self, U: Any, Ud: Any) -> list[Any]:
        """Time derivative of the change of length of each element, in m/s."""
        return [Ud[3 * j + 3] - Ud[3 * j] + s for j, s in enumerate(self.slopes(U, Ud))]

    def stretching(self, U: Any, Ud: Any) -> list[Any]:
        """Axial force of each element by its extension, in N."""
        pairs = zip(self.extension(U), self.extension_rate(U, Ud), strict=True)
        return [self.EA / self.l * (e + self.beta * rate) for e, rate in pairs]

    def unstretched(self, U: Any, Ud: Any, Udd: Any) -> tuple[Any, Any, Any]:
        """Nodal coordinates and derivatives, with u such that no element changes its length (its shortening alone)."""
        s = self.slopes
        again = [a + b for a, b in zip(s(Ud, Ud), s(U, Udd), strict=True)]
        return self._along(U, [g / 2 for g in s(U, U)]), self._along(Ud, s(U, Ud)), self._along(Udd, again)

    def _along(self, U: Any, shortening: list[Any]) -> Any:
        return shifted(U, [-s for s in shortening])

    def forces(self, U: Any, Ud: Any, N: list[Any]) -> Any:
        """Nodal forces of the axial forces N and of bending, in N, conjugate to U; shape (3 elements + 3,)."""
        bending = self.EJ / self.l**3 * (beam_matrices(self.elements).K_bending @ (U + self.beta * Ud))
        total = [bending[k] for k in range(3 * self.elements + 3)]
        G = element_matrices().G
        for j, force in enumerate(N):
            total[3 * j] -= force
            total[3 * j + 3] += force
            if self.second_order:
                turning = force / self.l * (G @ U[3 * j : 3 * j + 6])
                for k in range(6):
                    total[3 * j + k] += turning[k]
        return as_expr(total)

    def energy(self, U: Any, stretches: bool) -> Any:
        """Elastic energy in J; that of stretch only if the axis stretches."""
        bending = self.EJ / self.l**3 * dot(U, beam_matrices(self.elements).K_bending @ U) / 2
        return bending + (self.EA / self.l * sum(e * e for e in self.extension(U)) / 2 if stretches else 0.0)

    def dissipated(self, U: Any, Ud: Any, stretches: bool) -> Any:
        """Power of the damping in proportion to stiffness, in W."""
        bending = self.EJ / self.l**3 * dot(Ud, beam_matrices(self.elements).K_bending @ Ud)
        axial = self.EA / self.l * sum(r * r for r in self.extension_rate(U, Ud)) if stretches else 0.0
        return self.beta * (bending + axial)


def shifted(U: Any, lengths: list[Any]) -> Any:
    """Add to u of each node the lengths of the elements before it."""
    entries, total = [U[k] for k in range(U.shape[0])], as_expr(0.0)
    for j, length in enumerate(lengths):
        total = total + length
        entries[3 * j + 3] = entries[3 * j + 3] + total
    return as_expr(entries)
