"""Planar four-bar of box-shaped links with a damper on the crank, in one coordinate: the angle phi of the crank.

Vectors of the plane are complex numbers. The crank turns about the origin, the rocker about a ground point, the coupler
joins their ends. Virtual power: sum of (m a - m g) . v* + I z w* = -d w, with v*, w* the velocities for phi' = 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


@dataclass(frozen=True)
class FourBar:
    """Four-bar in the pose phi = 0: links as complex numbers, all boxes of the same section.

    Parameters
    ----------
    crank, coupler, ground : complex
        From the origin to the first pin, from there to the second pin; pivot of the rocker.
    side, density : float
        Side of the square section, density.
    damping, gravity : float
        Damping constant on the crank, acceleration of gravity along -y.
    """

    crank: complex = 0.4
    coupler: complex = 0.1 + 1.1j
    ground: complex = -0.15 + 1j
    side: float = 0.05
    density: float = 7700.0
    damping: float = 0.1
    gravity: float = 9.80665

    @property
    def links(self) -> Array:
        """Crank, coupler and rocker, as complex numbers."""
        return np.array([self.crank, self.coupler, self.crank + self.coupler - self.ground])

    def masses(self) -> tuple[Array, Array]:
        """Return masses and moments of inertia about the centres."""
        length = abs(self.links)
        m = self.density * self.side**2 * length
        return m, m / 12 * (length**2 + self.side**2)

    def turned(self, phi: float) -> Array:
        """Links at the crank angle phi, on the branch of the start."""
        crank = self.links[0] * np.exp(1j * phi)
        diagonal = self.ground - crank
        _, b, c = abs(self.links)
        along = (b**2 - c**2 + abs(diagonal) ** 2) / (2 * abs(diagonal))
        start = np.imag(self.links[1] * np.conj(self.ground - self.links[0]))
        coupler = (along + 1j * np.sign(start) * np.sqrt(b**2 - along**2)) * diagonal / abs(diagonal)
        return np.array([crank, coupler, coupler - diagonal])

    def rates(self, links: Array) -> tuple[Array, Array]:
        """Angular velocities for phi' = 1, and angular accelerations for phi' = 1, phi'' = 0."""

        def couple(loop: complex) -> list[float]:
            return list(np.linalg.solve([[b.real, -c.real], [b.imag, -c.imag]], [loop.real, loop.imag]))

        a, b, c = links
        w = np.array([1.0, *couple(-a)])
        return w, np.array([0.0, *couple(1j * (-(w[0] ** 2) * a - w[1] ** 2 * b + w[2] ** 2 * c))])

    def acceleration(self, phi: float, rate: float) -> float:
        """Return phi''."""
        m, I = self.masses()
        links = self.turned(phi)
        w, z = self.rates(links)
        v, curved = 1j * w * links / 2, (1j * z - w**2) * links / 2
        v[1] += 2 * v[0]
        curved[1] += 2 * curved[0]
        inertia = np.sum(m * abs(v) ** 2 + I * w**2)
        change = np.sum(m * np.real(curved * np.conj(v)) + I * z * w)
        load = -self.gravity * np.sum(m * v.imag) - self.damping * rate
        return float((load - change * rate**2) / inertia)

    def simulate(self, times: ArrayLike, phi: float = 0.0, rate: float = 0.0) -> Array:
        """Return phi and phi' at each of the increasing times, shape (len(times), 2)."""
        times = np.asarray(times, dtype=float)

        def derivative(_: float, state: Array) -> Array:
            return np.array([state[1], self.acceleration(*state)])

        span, start = (0.0, times[-1]), [phi, rate]
        return solve_ivp(derivative, span, start, "DOP853", times, rtol=1e-12, atol=1e-13).y.T

    def energy(self, phi: float, rate: float) -> float:
        """Return the kinetic and potential energy."""
        m, I = self.masses()
        links = self.turned(phi)
        w = self.rates(links)[0]
        centres = links / 2 + np.array([0, links[0], self.ground])
        v = 1j * w * links / 2 + np.array([0, 1j * links[0], 0])
        kinetic = np.sum(m * abs(v) ** 2 + I * w**2) / 2 * rate**2
        return float(kinetic + self.gravity * np.sum(m * centres.imag))
