"""Slider-crank of two uniform rigid bars and a slider mass, driven by the torque of the beam paper, in the crank angle.

x = l1 cos th + sqrt(l2^2 - l1^2 sin^2 th); virtual power with the velocities for th' = 1 (beam paper, section 5.3).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
STOP = 0.7


def torque(t: float) -> float:
    """Torque while it acts, in N.m."""
    return 0.01 * (1 - np.exp(-t / 0.167))


@dataclass(frozen=True)
class SliderCrank:
    """Crank and rod of one section, in line at the start.

    Parameters
    ----------
    crank, rod : float
        Lengths.
    line_mass : float
        Mass of both for each metre.
    slider_mass, gravity : float
        Mass of the slider, acceleration of gravity along -y.
    """

    crank: float = 0.152
    rod: float = 0.304
    line_mass: float = 2770 * 0.7854e-4
    slider_mass: float = 0.0
    gravity: float = 0.0

    def bodies(self) -> tuple[Array, Array]:
        """Return masses of crank, rod and slider, and moments of inertia about their centres."""
        m = np.array([self.line_mass * self.crank, self.line_mass * self.rod, self.slider_mass])
        return m, m * np.array([self.crank, self.rod, 0.0]) ** 2 / 12

    def slope(self, th: float | Array) -> Array:
        """Angle of the rod from the x axis."""
        return -np.arcsin(self.crank / self.rod * np.sin(th))

    def slider_position(self, th: Array) -> Array:
        """x of the slider."""
        return self.crank * np.cos(th) + self.rod * np.cos(self.slope(th))

    def rates(self, th: float) -> tuple[Array, Array, Array, Array]:
        """For th' = 1: velocities of the centres (complex), angular velocities; then with th'' = 0 accelerations."""
        ps = float(self.slope(th))
        a, b = self.crank * np.exp(1j * th), self.rod * np.exp(1j * ps)
        w = -a.real / b.real
        z = (a.imag + w**2 * b.imag) / b.real
        v = np.array([1j * a / 2, 1j * a + 1j * w * b / 2, 1j * a + 1j * w * b])
        curved = np.array([-a / 2, -a + (1j * z - w**2) * b / 2, -a + (1j * z - w**2) * b])
        return v, np.array([1.0, w, 0.0]), curved, np.array([0.0, z, 0.0])

    def acceleration(self, t: float, th: float, rate: float, drive: bool) -> float:
        """Return th''."""
        m, I = self.bodies()
        v, w, curved, z = self.rates(th)
        inertia = np.sum(m * abs(v) ** 2 + I * w**2)
        change = np.sum(m * np.real(curved * np.conj(v)) + I * z * w)
        load = (torque(t) if drive else 0.0) - self.gravity * np.sum(m * v.imag)
        return float((load - change * rate**2) / inertia)

    def simulate(self, times: ArrayLike) -> Array:
        """Return th and th' at each of the increasing times, shape (len(times), 2), from rest."""
        times = np.asarray(times, dtype=float)
        driven, free = times[times <= STOP], times[times > STOP]

        def integrate(start: float, state: ArrayLike, at: Array, drive: bool) -> Array:
            def derivative(t: float, y: Array) -> list[float]:
                return [y[1], self.acceleration(t, y[0], y[1], drive)]

            return solve_ivp(derivative, (start, at[-1]), state, "DOP853", at, rtol=1e-12, atol=1e-14).y

        y = integrate(0.0, [0.0, 0.0], np.union1d(driven, [STOP]) if free.size else driven, True)
        if free.size:
            y = np.hstack([y[:, : driven.size], integrate(STOP, y[:, -1], free, False)])
        return y.T

    def energy(self, th: float, rate: float) -> float:
        """Return the kinetic and potential energy."""
        m, I = self.bodies()
        v, w, _, _ = self.rates(th)
        heights = np.array([0.5, 0.5, 0.0]) * self.crank * np.sin(th)
        return float(np.sum(m * abs(v) ** 2 + I * w**2) / 2 * rate**2 + self.gravity * np.sum(m * heights))
