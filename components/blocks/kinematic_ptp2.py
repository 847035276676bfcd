"""KinematicPTP2: position, speed and acceleration along the fastest way between two points within limits."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Component, Scalar, output, parameter, structural, time
from components.blocks.point_to_point import PointToPoint


class KinematicPTP2(Component):
    """Position, speed and acceleration along the fastest way between two points within limits."""

    nout: int = structural("number of coordinates", default=1, minimum=1)
    q_begin: Any = parameter("start of the motion", shape=lambda s: (s.nout,), default=lambda s: np.zeros(s.nout))
    q_end: Any = parameter("its end", shape=lambda s: (s.nout,), default=lambda s: np.ones(s.nout))
    qd_max: Any = parameter("largest speeds", shape=lambda s: (s.nout,), default=lambda s: np.ones(s.nout))
    qdd_max: Any = parameter("largest accelerations", shape=lambda s: (s.nout,), default=lambda s: np.ones(s.nout))
    start_time: Scalar = parameter("time at which it starts", unit="s", default=0)
    q: Any = output("positions", shape=lambda s: (s.nout,))
    qd: Any = output("speeds", shape=lambda s: (s.nout,))
    qdd: Any = output("accelerations", shape=lambda s: (s.nout,))
    moving: Scalar = output("1 during the motion, else 0")

    def equations(self):
        way = self.q_end - self.q_begin
        motion = PointToPoint(way, self.qd_max, self.qdd_max, time - self.start_time)
        yield self.q == self.q_begin + motion.s * way
        yield self.qd == motion.sd * way
        yield self.qdd == motion.sdd * way
        yield self.moving == motion.moving
