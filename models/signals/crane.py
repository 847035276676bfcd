"""Crane: a trolley with a hanging load, moved by a sampled observer and controller in Python."""

from __future__ import annotations

import numpy as np
from scipy.linalg import expm, solve_discrete_are

from acausal import Model, Scalar, chain, connect, fixed, output
from components import Body, FixedTranslation, Prismatic, Revolute, World, translational
from components.blocks import Sampled

PERIOD, TROLLEY, LOAD, ROPE, G = 0.05, 200.0, 400.0, 5.0, 9.81
PULL = LOAD * G / TROLLEY
A = np.array([[0, 1, 0, 0], [0, 0, PULL, 0], [0, 0, 0, 1], [0, 0, -(G + PULL) / ROPE, 0]])
B = np.array([0, 1 / TROLLEY, 0, -1 / (TROLLEY * ROPE)])


class Controller:
    """Kalman filter of place and angle, and linear-quadratic regulator to a target, with a limited force."""

    def __init__(self, target: float, limit: float) -> None:
        self.target, self.limit, C = target, limit, np.eye(4)[[0, 2]]
        whole = expm(PERIOD * np.block([[A, B[:, None]], [np.zeros((1, 5))]]))
        self.F, self.G, self.C, R = whole[:4, :4], whole[:4, 4:], C, 1e-6 * np.eye(2)
        P = solve_discrete_are(self.F, self.G, np.diag([1, 0, 50, 0]), R[:1, :1])
        self.K = np.linalg.solve(self.G.T @ P @ self.G + R[:1, :1], self.G.T @ P @ self.F)[0]
        S = solve_discrete_are(self.F.T, C.T, np.diag([1e-6, 1e-4, 1e-6, 1e-4]), R)
        self.L = S @ C.T @ np.linalg.inv(C @ S @ C.T + R)
        self.reset()

    def reset(self) -> None:
        self.x, self.force = np.zeros(4), 0.0

    def __call__(self, time: float, measured: np.ndarray) -> float:
        x = self.F @ self.x + self.G[:, 0] * self.force
        self.x = x + self.L @ (measured - self.C @ x)
        self.force = float(np.clip(-self.K @ (self.x - [self.target, 0, 0, 0]), -self.limit, self.limit))
        return self.force


class Crane(Model):
    """Trolley with a load of 400 kg on a rope of 5 m, moved by 4 m."""

    stop_time = 15.0
    world, rail = World(g=G), Prismatic(use_axis_flange=True, s=fixed(0), v=fixed(0))
    trolley, load = Body(m=TROLLEY), Body(m=LOAD)
    pivot, rope = Revolute(phi=fixed(0), w=fixed(0)), FixedTranslation(r=(0, -ROPE, 0))
    drive = translational.Force()
    controller = Sampled(f=Controller(target=4, limit=400), period=PERIOD, inputs=2)
    x: Scalar = output("place of the trolley", unit="m")

    def connections(self):
        yield chain(self.world, self.rail, self.trolley)
        yield chain(self.rail, self.pivot, self.rope, self.load)
        yield connect(self.drive.flange, self.rail.axis)

    def equations(self):
        yield self.controller.u == (self.rail.s, self.pivot.phi)
        yield self.drive.f == self.controller.y
        yield self.x == self.rail.s
