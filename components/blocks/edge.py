"""Edge: true at the instants at which the input becomes true."""

from __future__ import annotations

from acausal import Scalar, discrete, reinit, when
from components.blocks.siso import SISO


class Edge(SISO):
    """True (1) at the instants at which the input becomes true (above 0.5).

    It is false again after the event, so that conditions see it, such as `when(edge.y > 0.5, ...)`, and results do not.
    """

    rises: Scalar = discrete("whether the input becomes true", start=0)

    def equations(self):
        yield when(self.u > 0.5, reinit(self.rises, 1))
        yield when(self.rises > 0.5, reinit(self.rises, 0))
        yield self.y == self.rises
