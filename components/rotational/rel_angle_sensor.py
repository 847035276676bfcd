"""RelAngleSensor: measures the relative angle of two shaft ends."""

from __future__ import annotations

from acausal import Scalar, output
from components.rotational.relative_sensor import RelativeSensor


class RelAngleSensor(RelativeSensor):
    """Measures the angle of flange_b relative to flange_a."""

    phi_rel: Scalar = output("angle of flange_b relative to flange_a", unit="rad")
