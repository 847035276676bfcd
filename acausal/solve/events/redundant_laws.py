"""Redundant set-valued laws, whose forces the equations do not determine."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import caution


class RedundantLaws:
    """Warns once of redundant laws.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    """

    def __init__(self, compiled: CompiledModel) -> None:
        self.laws, self._named = compiled.guards.laws, False

    def name(self, redundant: np.ndarray) -> None:
        """Warn of laws that are redundant at rest, given by their numbers, unless some were named before."""
        if self._named or not redundant.size:
            return
        self._named = True
        names = ", ".join(f"`{self.laws.origins[k].path}`" for k in redundant.tolist())
        caution(
            f"more joints stick at once than the machine has freedoms: the friction of {names} is redundant, and nothing "
            "determines how it shares the load with that of the others. The torques are those of least norm; the motion does "
            "not depend on them. Make a part of the loop elastic where they matter."
        )
