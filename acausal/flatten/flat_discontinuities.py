"""Collection of the discontinuities of a model."""

from __future__ import annotations

from typing import Any

from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.discontinuities import guards, laws, promises
from acausal.flatten.flat_model import FlatDiscontinuities
from acausal.symbols import vec


def discontinuities(raw: CollectedStatements, resolved: Any) -> FlatDiscontinuities:
    """Return the discontinuities; `resolved` replaces placeholders of derivatives in a list of expressions."""
    return FlatDiscontinuities(
        tuple(switch for switch, _ in raw.pending.switches),
        guards(raw.pending, raw.discretes, resolved),
        tuple(zip([vec(d.sx) for d in raw.discretes], resolved(raw.discrete_starts), strict=True)),
        tuple(zip(resolved(raw.pending.differentiated), raw.pending.derivative_origins, strict=True)),
        promises(raw.pending, resolved),
        laws(raw.pending, raw.discretes, resolved),
        tuple(raw.pending.kinks),
    )
