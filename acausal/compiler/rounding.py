"""How far the values of expressions may be off by rounding."""

from __future__ import annotations

from functools import cache

import casadi as ca

from acausal.instructions import CONSTANT, INPUT, READABLE, read_instructions
from acausal.symbols import scalars, stacked


def terms(arguments: list[ca.SX], column: ca.SX) -> ca.SX:
    """Return the size of all that rounding changes in expressions: times the rounding error, a bound of their error.

    Every operation is off by its value times the rounding error, and by what the operations before it are off times its
    slopes (running error analysis: Higham 2002, section 3.3). So are given values and constants: 90.1 is not a binary
    number. Sums in which large terms cancel, as at the end of a motion, keep the size of the terms.

    Parameters
    ----------
    arguments : list of casadi.SX
        Columns of symbols, all that the expressions hold.
    column : casadi.SX
        The expressions, dense.
    """
    read = read_instructions(ca.Function("rounded", arguments, [column], READABLE))
    given, value, size = [scalars(a) for a in arguments], list[ca.SX](), list[ca.SX]()
    for k, (op, operands) in enumerate(zip(read.op, read.arguments, strict=True)):
        if op == INPUT:
            own, slopes = given[read.place[k][0]][read.place[k][1]], ()
        elif op == CONSTANT:
            own, slopes = ca.SX(read.constant[k]), ()
        else:
            own, *slopes = _operation(op, len(operands)).call([value[i] for i in operands])
        value.append(own)
        # What does not matter, as a case that does not hold, need not have a value.
        off = [ca.if_else(slope == 0, 0, ca.fabs(slope) * size[i]) for slope, i in zip(slopes, operands, strict=True)]
        size.append(ca.fabs(own) + sum(off, ca.SX(0)))
    return ca.densify(stacked([size[k] for k in read.results[0]]))


@cache
def _operation(op: int, operands: int) -> ca.Function:
    """Function of operands: the result of an operation, and its derivative with respect to each."""
    given = [ca.SX.sym("operand") for _ in range(operands)]
    result = ca.SX.unary(op, *given) if operands == 1 else ca.SX.binary(op, *given)
    return ca.Function("operation", given, [result, *(ca.densify(ca.jacobian(result, g)) for g in given)])
