"""Friction: Coulomb friction with stiction."""

from __future__ import annotations

from acausal import Expr, Scalar, parameter, require
from components.rotational.slipping import Slipping


class Friction(Slipping):
    """Coulomb friction with stiction, as in a brake or a bearing."""

    tau_sliding: Scalar = parameter("torque against sliding", unit="N.m", minimum=0, doc="At most tau_static.")
    tau_static: Scalar = parameter(
        "greatest torque of sticking",
        unit="N.m",
        minimum=0,
        default=lambda self: self.tau_sliding,
        doc="tau_sliding if not given.",
    )

    def requirements(self):
        name = self._path or type(self).__name__
        yield require(
            self.tau_sliding <= self.tau_static,
            f"`tau_sliding` of {name} is more than its `tau_static`: it would stick and slide again without end. Give a larger "
            "`tau_static`",
        )

    def holding(self) -> Expr:
        """Torque of stiction."""
        return self.tau_static

    def dragging(self) -> Expr:
        """Torque of sliding."""
        return self.tau_sliding
