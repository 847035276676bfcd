"""Elementary operations of a CasADi function in static single assignment form."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca

OUTPUT, INPUT, CONSTANT = ca.OP_OUTPUT, ca.OP_INPUT, ca.OP_CONST
# Lookups of tables: names of the functions that CasADi calls, and codes of the operations.
FINDS, LOADS = "find_in_column", "load_from_column"
FIND, LOAD = 1001, 1002
LOOKUPS = {FINDS: FIND, LOADS: LOAD}

# Options of functions to be read: without reuse of work slots, each operation has its own slot. Otherwise the query of
# the output slots would take a third of the reading time.
READABLE = {"live_variables": False}


@dataclass(frozen=True)
class Instructions:
    """Operations in an order in which they can be evaluated.

    Attributes
    ----------
    op : list of int
        CasADi's operation code of each operation, or that of a lookup.
    arguments : list of sequences of int
        Operands of each operation.
    constant : dict of int to float
        Value of each constant.
    place : dict of int to tuple of int
        (argument, nonzero) of each input operation.
    results : list of list of int
        Operations that compute the nonzeros of each result.
    """

    op: list[int]
    arguments: list[Sequence[int]]
    constant: dict[int, float]
    place: dict[int, tuple[int, int]]
    results: list[list[int]]


def read_instructions(function: ca.Function) -> Instructions:
    """Return the operations of a function of scalar symbols.

    Parameters
    ----------
    function : casadi.Function
        Function of SX, preferably created with the options `READABLE`.
    """
    every = range(function.n_instructions())
    ids = list(map(function.instruction_id, every))
    if ca.OP_CALL in ids:
        function, ids = _with_lookups(function, ids)
        every = range(len(ids))
    inputs: list[Sequence[int]] = list(map(function.instruction_input, every))
    nodes = [k for k in every if ids[k] != OUTPUT]
    if function.sz_w() < len(nodes):
        inputs = _operands(function, ids, inputs)
    op, arguments = [ids[k] for k in nodes], [inputs[k] for k in nodes]
    place = {node: (some[0], some[1]) for node, (o, some) in enumerate(zip(op, arguments, strict=True)) if o == INPUT}
    constant = {node: function.instruction_constant(nodes[node]) for node, o in enumerate(op) if o == CONSTANT}
    for node in place:
        arguments[node] = ()
    results = [[-1] * function.nnz_out(k) for k in range(function.n_out())]
    for k in [k for k in every if ids[k] == OUTPUT]:
        result, nonzero = function.instruction_output(k)
        results[result][nonzero] = inputs[k][0]
    return Instructions(op, arguments, constant, place, results)


def _operands(function: ca.Function, ids: list[int], inputs: list[Sequence[int]]) -> list[Sequence[int]]:
    """Return the operands of each instruction as operations instead of work slots."""
    node, slot, found = 0, dict[int, int](), list[Sequence[int]]()
    for k, (op, given) in enumerate(zip(ids, inputs, strict=True)):
        found.append(given if op == INPUT else [slot[i] for i in given])
        if op != OUTPUT:
            slot[function.instruction_output(k)[0]] = node
            node += 1
    return found


def _with_lookups(function: ca.Function, ids: list[int]) -> tuple[ca.Function, list[int]]:
    """Return a function without the derivatives of lookups, which are 0, and its operation codes.

    Raises
    ------
    ValueError
        If the function calls something else.
    """
    nodes, values = _nodes(function), dict[int, Any]()
    given = function.sx_in()
    results = [ca.SX(function.sparsity_out(k)) for k in range(function.n_out())]
    for k, op in enumerate(ids):
        inputs, outputs = function.instruction_input(k), function.instruction_output(k)
        operands = [] if op in (INPUT, CONSTANT) else [values[i] for i in inputs]
        if op == INPUT:
            own = given[inputs[0]].nz[inputs[1]]
        elif op == CONSTANT:
            own = ca.SX(function.instruction_constant(k))
        elif op == OUTPUT:
            results[outputs[0]].nz[outputs[1]] = operands[0]
            continue
        elif op == ca.OP_CALL:
            called = nodes[k].which_function()
            if not any(name in called.name() for name in LOOKUPS):
                raise ValueError(f"the function calls {called.name()}, whose operations are unknown")
            own = called(*operands) if called.name() in LOOKUPS else ca.SX(0)
        else:
            own = ca.SX.unary(op, *operands) if len(operands) == 1 else ca.SX.binary(op, *operands)
        values |= dict.fromkeys(outputs, own)
    without = ca.Function("without", given, results, READABLE)
    nodes = _nodes(without)
    ids = list(map(without.instruction_id, range(without.n_instructions())))
    return without, [LOOKUPS[nodes[k].which_function().name()] if op == ca.OP_CALL else op for k, op in enumerate(ids)]


def _nodes(function: ca.Function) -> list[Any]:
    """Return the operations as expressions."""
    return function.instructions_sx().elements()
