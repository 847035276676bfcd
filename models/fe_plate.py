"""Free plate with corner masses, loaded by a pulse or tumbling (paper on reconfigured inertial frames)."""

from functools import cache
from math import pi, sin

import acausal as ac
from acausal import Formulation, Model, Scalar, connect, fixed, output, parameter, part, piecewise, structural, time
from components import World, WorldForce
from components.fe import FEBody, FrameLoad, Nodes, ReducedBody, box, by_steps, read_npz, reduce_body

SIZE, COUNTS, REST, PEAK, LAST = (1, 0.05, 0.01), (100, 5, 1), fixed((0, 0, 0)), 50 / 2**0.5, 0.1  # N along x and z, s
PLACES, ELASTIC = {"P1": (-0.5, -0.025, -0.005), "end": (0.5, 0, -0.005)}, {"formulation": "elastic"}
PULSE = FrameLoad("end", lambda t: [k * PEAK * sin(pi * t / LAST) * (t < LAST) for k in (1, 0, 1)], breaks=(LAST,))


@cache
def plate(mesh: str, modes: int) -> ReducedBody:
    """Return the reduced plate, cached: free modes in mean axes, in which they have no momentum."""
    own = mesh in ("hex20", "tet10")
    M, K, nodes = box(SIZE, COUNTS, mesh, E=7e10, nu=0.33, rho=2700) if own else read_npz(mesh, length=1e-3, mass=1e3)
    nodes = Nodes(nodes - (nodes.min(axis=0) + nodes.max(axis=0)) / 2, cells=getattr(nodes, "cells", None))
    M.setdiag(M.diagonal() + own * (abs(abs(2 * nodes) - SIZE) < 1e-9).all(axis=1).repeat(3))  # 1 kg at each corner
    frames = {name: [((nodes - place) ** 2).sum(axis=1).argmin()] for name, place in PLACES.items()}
    return reduce_body(M, K, nodes, frames=frames, hold="mean-axis", modes=modes)


class FEPlate(Model):
    """Plate without gravity, initially with its centre of mass at the origin of the world; a half-sine force at its end."""

    stop_time, compared = 0.3, ("P1_x", "P1_z", "w_y")  # the other outputs hardly move under the pulse
    steps = by_steps(ELASTIC, (7.5e-4, 2.5e-4, 1.25e-4, 6.25e-5), lambda s: [PULSE] if s.load == "pulse" else [])
    formulations = (Formulation("floating frame", ELASTIC), Formulation("rigid", {"formulation": "rigid"}), *steps)
    formulation: str = structural("kind of plate", default="elastic", choices=("elastic", "rigid"))
    modes: int = structural("number of modes of the elastic plate", default=10, minimum=1)
    mesh: str = structural("hex20, tet10, or a .npz file with nodes, K and mass in mm, N, Mg", default="hex20")
    load: str = structural("load at the end", default="pulse", choices=("pulse", "none"))
    spin: tuple = structural("initial angular velocity in rad/s", default=(0, 0, 0), shape=(3,))
    damping: Scalar = parameter("modal damping ratio", unit="1", default=0.05, minimum=0)
    world, push = World(gravity=None), WorldForce()
    P1_x, P1_y, P1_z = (output(f"{axis} of the corner P1, in the world", unit="m") for axis in "xyz")
    w_x, w_y, w_z = (output(f"angular velocity about {axis} of the plate", unit="rad/s") for axis in "xyz")

    @part
    def body(self):
        modes = self.modes if self.formulation == "elastic" else 0
        start: dict = {"angles_fixed": True, "r_0": REST, "v_0": REST, "w_a": fixed(tuple(self.spin))}
        return FEBody(reduced=plate(str(self.mesh), self.modes), modes=modes, damping_ratio=self.damping, **start)

    def connections(self):
        yield connect(self.body.end, self.push.frame_b)

    def equations(self):
        force = piecewise((PEAK * ac.sin(pi * time / LAST), time < LAST), 0) if self.load == "pulse" else 0
        yield self.push.force == (force, 0, force)
        yield self.body.P1.r_0 == (self.P1_x, self.P1_y, self.P1_z)
        yield self.body.w_a == (self.w_x, self.w_y, self.w_z)


if __name__ == "__main__":
    ac.simulate(FEPlate(), stop_time=FEPlate.stop_time).plot("P1_x", "P1_z", path="fe-plate.png")
