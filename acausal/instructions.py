"""Elementary operations of a CasADi function in static single assignment form."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import casadi as ca

OUTPUT, INPUT, CONSTANT = ca.OP_OUTPUT, ca.OP_INPUT, ca.OP_CONST
# Lookups of tables: names of the functions that CasADi calls, and codes of the operations.
FINDS, LOADS, PUTS, VALUES = "find_in_column", "load_from_column", "put_argument", "value_of_arguments"
FIND, LOAD, PUT, VALUE = 1001, 1002, 1003, 1004
LOOKUPS = {FINDS: FIND, LOADS: LOAD}
# Functions of other libraries, and their derivatives, whose derivatives are taken as 0; the number of values follows.
EXTERNAL, SLOPE = "external_of", "slope_of"
_CODES = LOOKUPS | {PUTS: PUT, VALUES: VALUE}

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
        function = _binary(function)
        every, nodes = range(function.n_instructions()), _nodes(function)
        ids = list(map(function.instruction_id, every))
        ids = [_CODES[nodes[k].which_function().name()] if op == ca.OP_CALL else op for k, op in enumerate(ids)]
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


def _binary(function: ca.Function) -> ca.Function:
    """Return a function of binary operations alone: a call of another library is a chain of them.

    Raises
    ------
    ValueError
        If the function calls something else.
    """
    nodes, values = _nodes(function), dict[int, Any]()
    given = function.sx_in()
    results = [ca.SX(function.sparsity_out(k)) for k in range(function.n_out())]
    for k, op in enumerate(map(function.instruction_id, range(len(nodes)))):
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
            values |= zip(outputs, _called(nodes[k].which_function(), operands, len(outputs)), strict=True)
            continue
        else:
            own = ca.SX.unary(op, *operands) if len(operands) == 1 else ca.SX.binary(op, *operands)
        values |= dict.fromkeys(outputs, own)
    return ca.Function("binary", given, results, READABLE)


def _called(function: ca.Function, operands: list[Any], n: int) -> list[Any]:
    """Return the results of a call: a lookup, whose derivatives are 0, or a function of another library, or a derivative.

    Raises
    ------
    ValueError
        If it is something else.
    """
    name = function.name()
    if name in LOOKUPS:
        return [function(*operands)]
    if name.startswith((EXTERNAL, SLOPE)):
        number, place, *arguments = operands
        link = ca.SX(0)
        for x in (*arguments, number):
            link = _operation(PUTS)(x, link)
        return [_operation(VALUES)(link, place)]
    if EXTERNAL in name:
        return _derivative(function)(ca.vertcat(*operands)).elements()
    if any(known in name for known in (*LOOKUPS, SLOPE)):
        return [ca.SX(0)] * n
    raise ValueError(f"the function calls {name}, whose operations are unknown")


_DERIVATIVES = dict[str, ca.Function]()


def _derivative(function: ca.Function) -> ca.Function:
    """Return a derivative of a function of another library, from nonzeros to nonzeros, as binary operations."""
    if (name := function.name()) not in _DERIVATIVES:
        given = [ca.SX.sym("a", function.sparsity_in(k)) for k in range(function.n_in())]
        inputs, outputs = (_nonzeros(part) for part in (given, function.expand().call(given, True, False)))
        _DERIVATIVES[name] = _binary(ca.Function("derivative", [inputs], [outputs], READABLE))
    return _DERIVATIVES[name]


def _nonzeros(matrices: list[ca.SX]) -> ca.SX:
    """Return the nonzeros of matrices, a column."""
    entries: list[Any] = [x for matrix in matrices for x in matrix.nonzeros()]
    return ca.vertcat(ca.SX(0, 1), *entries)


@cache
def _operation(name: str) -> ca.Function:
    """Return a function that stands for an operation; it is read alone."""
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    return ca.Function(name, [x, y], [x + y], {"never_inline": True})


def slope_place(name: str, place: Any, argument: int) -> Any:
    """Return where the derivative of a value by an argument stands behind the values."""
    return place + int(name.rpartition("_")[2]) * (argument + 1)


def is_known(name: str) -> bool:
    """Return whether the operations of a function by this name are known."""
    return name in LOOKUPS or name.startswith((EXTERNAL, SLOPE))


def _nodes(function: ca.Function) -> list[Any]:
    """Return the operations as expressions."""
    return function.instructions_sx().elements()


def places_called(expression: ca.SX) -> list[int]:
    """Return which values of functions of other libraries an expression holds."""
    inside = ca.Function("inside", ca.symvar(expression), [expression], READABLE)
    nodes = _nodes(inside)
    calls = [k for k, node in enumerate(nodes) if node.op() == ca.OP_CALL]
    found = [k for k in calls if nodes[k].which_function().name().startswith(EXTERNAL)]
    return [int(inside.instruction_constant(inside.instruction_input(k)[1])) for k in found]
