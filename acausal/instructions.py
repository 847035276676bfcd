"""The elementary operations of a CasADi function, each with a value of its own."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca


@dataclass(frozen=True)
class Instructions:
    """Operations in an order in which they can be evaluated.

    Attributes
    ----------
    op : list of int
        CasADi's number of each operation.
    arguments : list of tuple of int
        Operations whose values each one takes.
    constant : list of float
        Value of each constant; 0 elsewhere.
    place : dict of int to tuple of int
        Argument of the function and nonzero in it, of each input.
    results : list of list of int
        Operations that give the nonzeros of each result.
    """

    op: list[int]
    arguments: list[tuple[int, ...]]
    constant: list[float]
    place: dict[int, tuple[int, int]]
    results: list[list[int]]


def read_instructions(function: ca.Function) -> Instructions:
    """Return the operations of a function of scalar symbols.

    Parameters
    ----------
    function : casadi.Function
        Made from SX.
    """
    slot: dict[int, int] = {}
    read = Instructions([], [], [], {}, [[-1] * function.nnz_out(k) for k in range(function.n_out())])
    kind, taken, given = function.instruction_id, function.instruction_input, function.instruction_output
    for k in range(function.n_instructions()):
        op, inputs, outputs = kind(k), taken(k), given(k)
        if op == ca.OP_OUTPUT:
            read.results[outputs[0]][outputs[1]] = slot[inputs[0]]
            continue
        node, leaf = len(read.op), op in (ca.OP_INPUT, ca.OP_CONST)
        if op == ca.OP_INPUT:
            read.place[node] = inputs[0], inputs[1]
        read.op.append(op)
        read.arguments.append(() if leaf else tuple([slot[i] for i in inputs]))
        read.constant.append(function.instruction_constant(k) if op == ca.OP_CONST else 0.0)
        slot[outputs[0]] = node
    return read
