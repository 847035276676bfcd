"""Bounds of the round-off error of expressions."""

from __future__ import annotations

from collections import defaultdict
from functools import cache

import casadi as ca

from acausal.instructions import READABLE, Instructions, read_instructions
from acausal.symbols import picked, vec


def terms(arguments: list[ca.SX], column: ca.SX) -> ca.SX:
    """Return the error scale of expressions: times the unit round-off, it bounds their error.

    Running error analysis (Higham 2002, section 3.3): every operation adds its value times the unit round-off to the
    errors of its operands times its derivatives. Arguments and constants have such an error too: 90.1 is not a binary
    number. A sum of large terms that cancel keeps the scale of the terms.

    Parameters
    ----------
    arguments : list of casadi.SX
        Columns of symbols: all symbols in the expressions.
    column : casadi.SX
        The expressions, dense.
    """
    read = read_instructions(ca.Function("rounded", arguments, [column], READABLE))
    given = [vec(a) for a in arguments]
    value = ca.SX.zeros(1, len(read.op))
    for k, (argument, nonzero) in read.place.items():
        value[k] = given[argument].nz[nonzero]
    for k, number in read.constant.items():
        value[k] = number
    size = ca.fabs(value)
    for op, nodes in _alike(read):
        operands = [list(own) for own in zip(*(read.arguments[k] for k in nodes), strict=True)]
        own, *slopes = _operation(op, len(operands)).call([value[places] for places in operands])
        value[nodes] = own
        # An operand without influence, such as the branch not taken, may be NaN.
        off = [ca.if_else(slope == 0, 0, ca.fabs(slope) * size[i]) for slope, i in zip(slopes, operands, strict=True)]
        size[nodes] = ca.fabs(own) + sum(off, ca.SX(0))
    return ca.densify(picked(size.T, read.results[0]))


def _alike(read: Instructions) -> list[tuple[int, list[int]]]:
    """Group equal operations that depend on earlier groups only: a CasADi call costs the same for one as for many."""
    level, groups = list[int](), defaultdict[tuple[int, int], list[int]](list)
    for k, (op, operands) in enumerate(zip(read.op, read.arguments, strict=True)):
        level.append(1 + max((level[i] for i in operands), default=-1))
        if operands:
            groups[level[k], op].append(k)
    return [(op, nodes) for (_, op), nodes in sorted(groups.items())]


@cache
def _operation(op: int, operands: int) -> ca.Function:
    """Return an operation as a function of its operands: its result, and its derivative by each operand."""
    given = [ca.SX.sym("operand") for _ in range(operands)]
    result = ca.SX.unary(op, *given) if operands == 1 else ca.SX.binary(op, *given)
    return ca.Function("operation", given, [result, *(ca.densify(ca.jacobian(result, g)) for g in given)])
