"""KinematicPTP: acceleration along the fastest way between two points within limits of speed and acceleration."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Component, Scalar, output, parameter, structural, time
from components.blocks.point_to_point import PointToPoint


class KinematicPTP(Component):
    """Acceleration along the fastest way between two points within limits of speed and acceleration."""

    deltaq: Any = parameter("distances", shape=lambda s: (s.nout,), default=lambda s: np.ones(s.nout))
    qd_max: Any = parameter("largest speeds", shape=lambda s: (s.nout,), default=lambda s: np.ones(s.nout))
    qdd_max: Any = parameter("largest accelerations", shape=lambda s: (s.nout,), default=lambda s: np.ones(s.nout))
    nout: int = structural("number of coordinates", default=1, minimum=1)
    start_time: Scalar = parameter("start of the motion", unit="s", default=0)
    y: Any = output("accelerations", shape=lambda s: (s.nout,))

    def equations(self):
        motion = PointToPoint(self.deltaq, self.qd_max, self.qdd_max, time - self.start_time)
        yield self.y == motion.sdd * self.deltaq
