"""Circle: solid circular section."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from components.beams.sections.round import RoundSection


@dataclass(frozen=True)
class Circle(RoundSection):
    """Solid circular section.

    Parameters
    ----------
    d : float
        Diameter in m.
    """

    d: Any

    @property
    def d_o(self) -> Any:
        """Outer diameter in m."""
        return self.d

    @property
    def d_i(self) -> float:
        """Inner diameter in m."""
        return 0.0
