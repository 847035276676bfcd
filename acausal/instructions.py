"""The elementary operations of a CasADi function, each with a value of its own."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

OUTPUT, INPUT, CONSTANT = ca.OP_OUTPUT, ca.OP_INPUT, ca.OP_CONST


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
    every = range(function.n_instructions())
    asked = (function.instruction_id, function.instruction_input, function.instruction_output)
    slot: dict[int, int] = {}
    read = Instructions([], [], [], {}, [[-1] * function.nnz_out(k) for k in range(function.n_out())])
    for k, op, inputs, outputs in zip(every, *(map(what, every) for what in asked), strict=True):
        node, arguments, constant = len(read.op), (), 0.0
        if op == OUTPUT:
            read.results[outputs[0]][outputs[1]] = slot[inputs[0]]
            continue
        if op == INPUT:
            read.place[node] = inputs[0], inputs[1]
        elif op == CONSTANT:
            constant = function.instruction_constant(k)
        else:
            arguments = tuple([slot[i] for i in inputs])
        read.op.append(op)
        read.arguments.append(arguments)
        read.constant.append(constant)
        slot[outputs[0]] = node
    return read
