"""Collection of the parameters of a model."""

from __future__ import annotations

import numpy as np

from acausal.flatten.attributes import weighing
from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.flat_model import FlatParameters
from acausal.symbols import stacked


def flat_parameters(raw: CollectedStatements) -> FlatParameters:
    """Return the free and bound parameters."""
    own = raw.build.parameters
    return FlatParameters(
        symbols=stacked(own.symbols),
        names=tuple(own.names),
        values=np.array(own.values),
        weighing=weighing(raw),
        limits=tuple(own.limits),
        bound=own.bound,
        defaults=tuple(path for path in own.defaults if path in own.bound),
        structural_zeros=tuple(own.structural_zeros),
        tables=dict(own.tables),
        raised=frozenset(own.raised),
    )
