"""CasadiFunction: a function of CasADi as a continuous block."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from acausal import Component, DeclarationError, as_expr, input, output, structural


class CasadiFunction(Component):
    """Function of CasADi, y = f(u), as a continuous block.

    The inputs are the entries of all arguments of f, the outputs those of all its results, by columns. All operations of f
    must be elementary, so that its derivatives exist.
    """

    f: Any = structural("function", cls=ca.Function)
    u: Any = input("inputs", shape=lambda s: (s.f.nnz_in(),))
    y: Any = output("outputs", shape=lambda s: (s.f.nnz_out(),))

    def equations(self):
        ends = np.cumsum([0, *(self.f.nnz_in(k) for k in range(self.f.n_in()))]).tolist()
        parts = ca.vertsplit(self.u.sx, ends)
        results: list[Any] = expanded(self.f).call([ca.SX(self.f.sparsity_in(k), p) for k, p in enumerate(parts)])
        yield self.y == as_expr([as_expr(ca.SX(entry)) for result in results for entry in result.nonzeros()])


def expanded(f: ca.Function) -> ca.Function:
    """Return a function of elementary operations.

    Raises
    ------
    DeclarationError
        It calls others whose operations are unknown.
    """
    try:
        return f.expand()
    except RuntimeError as error:
        raise DeclarationError(
            f"the function {f.name()} has operations whose derivatives are unknown, such as an interpolant or an external "
            "function. Write a table with table(x, Table(...)), or call it at instants by Sampled(f=...)."
        ) from error
