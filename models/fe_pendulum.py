"""Pendulum of 16 brick elements: a soft rod on a hinge, reduced to a few modes (paper on FE matrices, section XI)."""

from functools import cache

import acausal as ac
from acausal import Model, Scalar, chain, fixed, output, part, structural
from components import Revolute, World
from components.fe import FEBody, ReducedBody, box, reduce_body
from components.orientation import resolve1

SIZE, COUNTS, MASS = (0.1, 0.015, 0.01), (8, 2, 1), 0.26
HINGE, TIP = [0, 2, 4], 50  # nodes of the edge x = 0, z = 0, and the middle one of the edge x = 0.1, z = 0


@cache
def rod(modes: int) -> ReducedBody:
    """Return the reduced rod, cached: modes with fixed hinge, and a tip fixed against rotation about it."""
    M, K, nodes = box(SIZE, COUNTS, "hex8", E=1e7, nu=0.49, rho=MASS / (SIZE[0] * SIZE[1] * SIZE[2]))
    hold = {"hinge": "xyz", "tip": "z"}
    return reduce_body(M, K, nodes, frames={"hinge": HINGE, "tip": [TIP]}, hold=hold, modes=modes)


class FEPendulum(Model):
    """Rod on a hinge along y, released from rest in the horizontal position."""

    stop_time = 0.6
    formulations = (
        ac.Formulation("modes", {"formulation": "elastic"}, {"modes": (5, 9, 18, 36)}, exact=True),
        ac.Formulation("rigid", {"formulation": "rigid"}),
    )
    formulation: str = structural("kind of rod", default="elastic", choices=("elastic", "rigid"))
    modes: int = structural("number of modes of the elastic rod", default=9, minimum=1, maximum=152)
    world, hinge = World(g=9.81, n=(0, 0, -1)), Revolute(n=(0, 1, 0), phi=fixed(0), w=fixed(0))
    tip_z: Scalar = output("height of the tip above the hinge, in the world", unit="m")
    tip_vz: Scalar = output("vertical velocity of the tip, in the world", unit="m/s")

    @part
    def body(self):
        # At the bottom the angular velocity is half the first natural frequency, beyond the range of the linear body; the
        # reference solutions use this linear body as well.
        modes = self.modes if self.formulation == "elastic" else 0
        return FEBody(reduced=rod(self.modes), modes=modes, check_range=False)

    def connections(self):
        yield chain(self.world, self.hinge, self.body.hinge)

    def equations(self):
        tip = self.body.tip
        yield self.tip_z == tip.r_0[2]
        yield self.tip_vz == resolve1(tip.R, tip.v)[2]


if __name__ == "__main__":
    ac.simulate(FEPendulum(), stop_time=FEPendulum.stop_time).plot("tip_z", "tip_vz", path="fe-pendulum.png")
