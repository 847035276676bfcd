"""Planar double pendulum of two rigid rods, by Lagrange's equations in absolute angles.

Gravity acts along -y; the first pivot is the origin; angles are anticlockwise from the x axis to each rod.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rod:
    """A rod from its pivot to its far end.

    Parameters
    ----------
    mass, length : float
        Mass, distance from the pivot to the far end.
    centre : float
        Position of the centre of mass along the rod, from the pivot.
    inertia : float
        Moment of inertia about the centre of mass.
    """

    mass: float
    length: float
    centre: float
    inertia: float

    @classmethod
    def uniform(cls, mass: float, length: float) -> Rod:
        """Return a thin rod of constant density."""
        return cls(mass, length, length / 2, mass * length**2 / 12)


def simulate(
    first: Rod, second: Rod, angles: ArrayLike, rates: ArrayLike, times: ArrayLike, gravity: float = 9.81
) -> Array:
    """Integrate the motion.

    Parameters
    ----------
    first, second : Rod
        The rods; the second hangs on the far end of the first.
    angles, rates : array_like
        Two absolute angles and two angular velocities at times[0].
    times : array_like
        Increasing times of the result.
    gravity : float
        Acceleration of gravity.

    Returns
    -------
    ndarray of shape (len(times), 4)
        Two angles and two angular velocities at each time.
    """
    times = np.asarray(times, dtype=float)
    J1 = first.inertia + first.mass * first.centre**2 + second.mass * first.length**2
    J2 = second.inertia + second.mass * second.centre**2
    coupling = second.mass * first.length * second.centre
    G1 = gravity * (first.mass * first.centre + second.mass * first.length)
    G2 = gravity * second.mass * second.centre

    def derivative(_: float, state: Array) -> Array:
        angle1, angle2, w1, w2 = state
        c, s = coupling * np.cos(angle1 - angle2), coupling * np.sin(angle1 - angle2)
        load = [-s * w2**2 - G1 * np.cos(angle1), s * w1**2 - G2 * np.cos(angle2)]
        return np.array([w1, w2, *np.linalg.solve([[J1, c], [c, J2]], load)])

    start = np.concatenate([np.asarray(angles, dtype=float), np.asarray(rates, dtype=float)])
    solution = solve_ivp(derivative, times[[0, -1]], start, "DOP853", times, rtol=1e-12, atol=1e-13)
    return solution.y.T


def energy(first: Rod, second: Rod, states: Array, gravity: float = 9.81) -> Array:
    """Return the kinetic plus potential energy of states as returned by `simulate`, from the velocities of the rods."""
    angle1, angle2, w1, w2 = states.T
    direction1, direction2 = np.exp(1j * angle1), np.exp(1j * angle2)
    elbow = first.length * direction1
    total = np.zeros(len(states))
    for rod, centre, velocity, w in (
        (first, first.centre * direction1, 1j * w1 * first.centre * direction1, w1),
        (second, elbow + second.centre * direction2, 1j * (w1 * elbow + w2 * second.centre * direction2), w2),
    ):
        total += rod.mass * abs(velocity) ** 2 / 2 + rod.inertia * w**2 / 2 + rod.mass * gravity * centre.imag
    return total


def ends(first: Rod, second: Rod, states: Array) -> tuple[Array, Array]:
    """Return the far ends of both rods, each of shape (len(states), 2)."""
    elbow = first.length * np.column_stack([np.cos(states[:, 0]), np.sin(states[:, 0])])
    return elbow, elbow + second.length * np.column_stack([np.cos(states[:, 1]), np.sin(states[:, 1])])
