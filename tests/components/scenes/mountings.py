"""Elastic mountings and force laws, each in a scene."""

from __future__ import annotations

import numpy as np

from acausal import part
from components import Bushing
from tests.components.scenes.forces import Line


class OnBushing(Line):
    """Its force lies on the line between the frames, so that it is the same turned round."""

    @part
    def it(self):
        coupling, damping, sign = np.zeros((6, 6)), np.zeros((6, 6)), -1 if self.turned else 1
        coupling[3:, 3:] = [[3.0, 1.0, 0.0], [1.0, 2.0, -0.5], [0.0, -0.5, 1.0]]
        damping[3:, 3:] = 0.05 * np.eye(3)
        return Bushing(
            c=(70, 70, 70),
            c_phi=(1, 5, 20),
            d_phi=(0.1, 0.1, 0.1),
            stiffness=coupling,
            damping=damping,
            t_0=(0.3 * sign, 0, 0.1 * sign),
        )
