"""Equations of the integrated system."""

from __future__ import annotations

from typing import Any

from acausal.compiler.equations.listing import EquationList, ReadEquation, listed
from acausal.compiler.equations.sympy_expressions import to_sympy
from acausal.compiler.equations.written import is_within
from acausal.compiler.full_residuals import origin_of
from acausal.reduce import ReducedModel
from acausal.symbols import scalars


def reduced_equations(reduced: ReducedModel, part: str) -> EquationList:
    """Return der(x) = ode for the states of a part, and 0 = alg for the algebraic equations that it states.

    Parameters
    ----------
    reduced : ReducedModel
        The equations.
    part : str
        Path of the part, "" for the whole model.
    """
    import sympy

    running = reduced.running
    rates = [
        (f"der({name})", entry)
        for name, entry in zip(reduced.states, scalars(running.ode), strict=True)
        # A derivative that is an unknown itself follows from the other equations.
        if is_within(name, part) and not (entry.is_symbolic() and entry.name() == f"der({name})")
    ]
    origins = [origin_of(reduced, row) for row in reduced.plan.residuals]
    left = [
        (str(origin), entry)
        for origin, entry in zip(origins, scalars(running.alg), strict=True)
        if is_within(origin.path, part)
    ]
    names = {s.element_hash(): name for s, name in zip(scalars(reduced.unknowns), reduced.names, strict=True)}
    read = to_sympy([entry for _, entry in (*rates, *left)], names, shared := dict[Any, Any]())
    sides = [*(sympy.Symbol(name, real=True) for name, _ in rates), *[sympy.Integer(0)] * len(left)]
    where = [*["states"] * len(rates), *(origin for origin, _ in left)]
    equations = (sympy.Eq(a, b, evaluate=False) for a, b in zip(sides, read, strict=True))
    return listed(map(ReadEquation, where, equations), shared, part)
