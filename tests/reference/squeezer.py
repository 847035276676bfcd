"""Andrews' squeezing mechanism as in the test set for solvers of initial value problems.

M(q) q'' + G' lambda = f(q, q') in q = (beta, Theta, gamma, Phi, delta, Omega, epsilon), with the three loops that meet
in one point differentiated twice (Hairer and Wanner, Solving Ordinary Differential Equations II, section VII.7).
"""

from __future__ import annotations

import numpy as np
from numpy import cos, sin
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
M1, M2, M3, M4, M5, M6, M7 = 0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498
I1, I2, I3, I4, I5, I6, I7 = 2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5
A, B, C = np.array([-0.06934, -0.00227]), np.array([-0.03635, 0.03273]), np.array([0.014, 0.072])
D, DA, E, EA, RR, RA, SS, SA, SB, SC, SD = (
    *(28e-3, 0.0115, 0.02, 0.01421, 7e-3, 9.2e-4, 35e-3, 0.01874, 0.01043, 18e-3, 0.02),
)
TA, TB, U, UA, UB, ZF, ZT, FA = 0.02308, 9.16e-3, 0.04, 0.01228, 4.49e-3, 0.02, 0.04, 0.01421
C0, L0, TORQUE = 4530.0, 0.07785, 0.033
START = (
    *(-0.0617138900142764, 0.0, 0.455279819163070, 0.222668390165886),
    *(0.487364979543843, -0.222668390165886, 1.23054744454982),
)


def mass_matrix(q: Array) -> Array:
    """Return the matrix M (7, 7)."""
    _, th, _, ph, _, om, _ = q
    M = np.zeros((7, 7))
    M[0, 0] = M1 * RA**2 + M2 * (RR**2 - 2 * DA * RR * cos(th) + DA**2) + I1 + I2
    M[0, 1] = M[1, 0] = M2 * (DA**2 - DA * RR * cos(th)) + I2
    M[1, 1] = M2 * DA**2 + I2
    M[2, 2] = M3 * (SA**2 + SB**2) + I3
    M[3, 3] = M4 * (E - EA) ** 2 + I4
    M[3, 4] = M[4, 3] = M4 * ((E - EA) ** 2 + ZT * (E - EA) * sin(ph)) + I4
    M[4, 4] = M4 * (ZT**2 + 2 * ZT * (E - EA) * sin(ph) + (E - EA) ** 2) + M5 * (TA**2 + TB**2) + I4 + I5
    M[5, 5] = M6 * (ZF - FA) ** 2 + I6
    M[5, 6] = M[6, 5] = M6 * ((ZF - FA) ** 2 - U * (ZF - FA) * sin(om)) + I6
    M[6, 6] = M6 * ((ZF - FA) ** 2 - 2 * U * (ZF - FA) * sin(om) + U**2) + M7 * (UA**2 + UB**2) + I6 + I7
    return M


def spring_line(q: Array) -> Array:
    """Return the line from the fixed point C to the point D of body 3."""
    return B + np.array([SD * cos(q[2]) + SC * sin(q[2]), SD * sin(q[2]) - SC * cos(q[2])]) - C


def forces(q: Array, v: Array) -> Array:
    """Return f: drive, spring, and inertia forces of second order."""
    _, th, ga, ph, _, om, _ = q
    be_v, th_v, _, ph_v, de_v, om_v, ep_v = v
    line = spring_line(q)
    length = np.linalg.norm(line)
    pull = -C0 * (length - L0) / length * line
    f = np.zeros(7)
    f[0] = TORQUE - M2 * DA * RR * th_v * (th_v + 2 * be_v) * sin(th)
    f[1] = M2 * DA * RR * be_v**2 * sin(th)
    f[2] = pull @ [SC * cos(ga) - SD * sin(ga), SD * cos(ga) + SC * sin(ga)]
    f[3] = M4 * ZT * (E - EA) * de_v**2 * cos(ph)
    f[4] = -M4 * ZT * (E - EA) * ph_v * (ph_v + 2 * de_v) * cos(ph)
    f[5] = -M6 * U * (ZF - FA) * ep_v**2 * cos(om)
    f[6] = M6 * U * (ZF - FA) * om_v * (om_v + 2 * ep_v) * cos(om)
    return f


# Arms of the loops as (length, phase, angles that add up): rr, d | ss | e, zt | zf, u.
DRIVE = ((RR, 0.0, (0,)), (-D, 0.0, (0, 1)))
ARMS = (
    (B, ((SS, -np.pi / 2, (2,)),)),
    (A, ((E, -np.pi / 2, (3, 4)), (ZT, 0.0, (4,)))),
    (A, ((ZF, 0.0, (5, 6)), (U, -np.pi / 2, (6,)))),
)


def loops(q: Array, v: Array) -> tuple[Array, Array, Array]:
    """Return residuals (6,), Jacobian (6, 7) and curvature (6,): the second derivative without that of q."""
    g, G, h = np.zeros(6), np.zeros((6, 7)), np.zeros(6)
    for k, (point, arms) in enumerate(ARMS):
        rows = slice(2 * k, 2 * k + 2)
        g[rows] = -point
        for sense, side in ((1.0, DRIVE), (-1.0, arms)):
            for length, phase, which in side:
                angle, rate = phase + sum(q[i] for i in which), sum(v[i] for i in which)
                arm = sense * length * np.array([cos(angle), sin(angle)])
                g[rows] += arm
                h[rows] -= rate**2 * arm
                for i in which:
                    G[rows, i] += [-arm[1], arm[0]]
    return g, G, h


def simulate(times: ArrayLike) -> Array:
    """Integrate the motion from rest; return q and q' at each of the increasing times, shape (len(times), 14)."""
    times = np.asarray(times, dtype=float)

    def derivative(_: float, state: Array) -> Array:
        q, v = state[:7], state[7:]
        _, G, h = loops(q, v)
        matrix = np.block([[mass_matrix(q), G.T], [G, np.zeros((6, 6))]])
        return np.concatenate([v, np.linalg.solve(matrix, [*forces(q, v), *-h])[:7]])

    start = np.concatenate([START, np.zeros(7)])
    return solve_ivp(derivative, (0.0, times[-1]), start, "DOP853", times, rtol=1e-12, atol=1e-13).y.T


def energy(states: Array) -> Array:
    """Return kinetic and elastic energy, less the work of the drive torque since beta = 0."""
    total = []
    for q, v in zip(states[:, :7], states[:, 7:], strict=True):
        stretch = np.linalg.norm(spring_line(q)) - L0
        total.append(v @ mass_matrix(q) @ v / 2 + C0 * stretch**2 / 2 - TORQUE * q[0])
    return np.array(total)
