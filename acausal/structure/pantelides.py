"""Index reduction by the algorithm of Pantelides."""

from __future__ import annotations

from acausal.structure.dulmage_mendelsohn import decompose
from acausal.structure.extension import Extension
from acausal.structure.incidence import lowest
from acausal.structure.singularity import StructuralSingularity, Subsystem
from acausal.structure.system import System

LIMIT = 10  # differentiations of one equation: mechanical models need two, more than ten never end


def pantelides(system: System) -> Extension:
    """Differentiate until the highest derivatives can be matched (Pantelides 1988, all colourings of a round at once).

    The equations that Pantelides colours from the unmatched ones are the over-determined part of the equations in the
    highest derivatives; each of them is differentiated, except definitions of variables with a declared derivative.
    Closures are differentiated beforehand.

    Raises
    ------
    StructuralSingularity
        If an equation were differentiated more than `LIMIT` times, or only definitions remain.

    """
    extension = Extension(system)
    for e in system.closures:
        extension.differentiate_closure(e)
    while True:
        derivative = extension.derivative
        rows = [[v for v in extension.rows[levels[-1]] if derivative[v] < 0] for levels in extension.levels]
        over = decompose(rows, len(derivative)).over
        if not over.equations:
            return extension
        coloured = [e for e in over.equations if system.defines[e] < 0 and e not in system.closures]
        if not coloured or any(len(extension.levels[e]) > LIMIT for e in coloured):
            root = lowest(derivative)
            raise StructuralSingularity(over=(Subsystem.of(over.equations, (root[v] for v in over.variables)),))
        for e in coloured:
            extension.differentiate(e)
