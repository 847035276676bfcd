"""RelPositionSensor: measures the relative position of two rod ends."""

from __future__ import annotations

from acausal import Scalar, output
from components.translational.relative_sensor import RelativeSensor


class RelPositionSensor(RelativeSensor):
    """Measures the position of flange_b relative to flange_a."""

    s_rel: Scalar = output("position of flange_b relative to flange_a", unit="m")
