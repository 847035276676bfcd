"""SO: base of sources."""

from __future__ import annotations

from acausal import Component, Scalar, output


class SO(Component):
    """Base of sources."""

    y: Scalar = output("output")
