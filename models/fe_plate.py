"""A free plate with masses at its corners, pushed at one end or tumbling (paper on reconfigured inertial frames)."""

from functools import cache
from math import pi, sqrt
from typing import Any

import numpy as np

import acausal as ac
from acausal import Model, Scalar, connect, fixed, output, parameter, part, piecewise, sin, structural, time
from components import World, WorldForce
from components.fe import FEBody, ReducedBody, box, read_npz, reduce_body

SIZE, COUNTS, MIDDLE, CORNER_MASS = np.array([1, 0.05, 0.01]), (100, 5, 1), np.array([0.5, 0.025, 0]), 1.0
PLACES = {"P1": (-0.5, -0.025, 0), "end": (0.5, 0, 0)}  # from the middle of the lower face


@cache
def plate(mesh: str, modes: int) -> ReducedBody:
    """The plate, made once in a process: free modes, in the axes in which they have no momentum."""
    if mesh in ("hex20", "tet10"):
        M, K, nodes = box(SIZE, COUNTS, mesh, E=7e10, nu=0.33, rho=2700)
        corners = np.isclose(np.abs(nodes - SIZE / 2), SIZE / 2).all(axis=1)
        M.setdiag(M.diagonal() + CORNER_MASS * np.repeat(corners, 3))
        nodes = nodes - MIDDLE
    else:
        M, K, nodes = read_npz(mesh, length=1e-3, mass=1e3)
    frames = {name: [int(np.argmin(np.linalg.norm(nodes - place, axis=1)))] for name, place in PLACES.items()}
    return reduce_body(M, K, nodes, frames=frames, hold="mean-axis", modes=modes, basis="free")


class FEPlate(Model):
    """Plate without gravity, its centre of mass at the origin of the world at first; half a sine pushes at its end."""

    stop_time = 0.3
    formulations = (ac.Formulation("modes", refine={"modes": (5, 10, 20)}, exact=True),)
    modes: int = structural("number of modes", default=10, minimum=1)
    mesh: str = structural("hex20, tet10, or a .npz file of nodes, K and mass in mm, N, Mg", default="hex20")
    load: str = structural("what pushes", default="pulse", choices=("pulse", "none"))
    spin: Any = structural("angular velocity at the start in rad/s", default=(0, 0, 0), shape=(3,))
    damping: Scalar = parameter("damping of the modes, of critical", unit="1", default=0.05, minimum=0)
    world = World(gravity=None)
    P1_x: Scalar = output("x of the corner P1, in the world", unit="m")
    P1_y: Scalar = output("y of the corner P1, in the world", unit="m")
    P1_z: Scalar = output("z of the corner P1, in the world", unit="m")
    w_x: Scalar = output("angular velocity about x of the body", unit="rad/s")
    w_y: Scalar = output("angular velocity about y of the body", unit="rad/s")
    w_z: Scalar = output("angular velocity about z of the body", unit="rad/s")

    @part
    def body(self):
        start: dict = {"r_0": fixed((0, 0, 0)), "v_0": fixed((0, 0, 0)), "w_a": fixed(tuple(self.spin))}
        reduced = plate(str(self.mesh), self.modes)
        return FEBody(reduced=reduced, damping_ratio=self.damping, angles_fixed=True, **start)

    @part
    def push(self):
        along = piecewise((50 / sqrt(2) * sin(pi * time / 0.1), time < 0.1), 0)
        return WorldForce(force=(along, 0, along)) if self.load == "pulse" else None

    def connections(self):
        if self.push is not None:
            yield connect(self.body.end, self.push.frame_b)

    def equations(self):
        yield from (self.P1_x == self.body.P1.r_0[0], self.P1_y == self.body.P1.r_0[1], self.P1_z == self.body.P1.r_0[2])
        yield from (self.w_x == self.body.w_a[0], self.w_y == self.body.w_a[1], self.w_z == self.body.w_a[2])


if __name__ == "__main__":
    ac.simulate(FEPlate(), stop_time=FEPlate.stop_time).plot("P1_x", "P1_z", path="fe-plate.png")
