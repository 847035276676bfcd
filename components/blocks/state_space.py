"""StateSpace: linear system x' = A x + B u, y = C x + D u."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Component, DeclarationError, der, input, output, parameter, structural, variable


class StateSpace(Component):
    """Linear system x' = A x + B u, y = C x + D u."""

    system: Any = structural("system of `control` or scipy with matrices A, B, C and D", default=None)
    A: Any = structural("system matrix, shape (n, n)", default=lambda s: matrix_of(s.system, "A", (0, 0)))
    B: Any = structural("input matrix, shape (n, k)", default=lambda s: matrix_of(s.system, "B", (0, 1)))
    C: Any = structural("output matrix, shape (m, n)", default=lambda s: matrix_of(s.system, "C", (1, 0)))
    D: Any = structural("feedthrough, shape (m, k); 0 by default", default=lambda s: matrix_of(s.system, "D", None))
    x_start: Any = parameter("initial state", shape=lambda s: (len(s.A),), default=lambda s: np.zeros(len(s.A)))
    u: Any = input("inputs", shape=lambda s: (np.shape(s.B)[1],))
    y: Any = output("outputs", shape=lambda s: (len(s.C),))
    x: Any = variable("state", shape=lambda s: (len(s.A),))

    def check(self):
        check_matrices(self)

    def equations(self):
        A, B, C = (np.asarray(part, dtype=float) for part in (self.A, self.B, self.C))
        if len(A):
            yield der(self.x) == A @ self.x + B @ self.u
        outputs = C @ self.x if len(A) else np.zeros(len(C))
        yield self.y == (outputs if self.D is None else outputs + np.asarray(self.D, dtype=float) @ self.u)

    def initial_equations(self):
        if len(self.A):
            yield self.x == self.x_start


def check_matrices(block: Any) -> None:
    """Raise DeclarationError if the matrices of a state space do not fit together."""
    n, k, m = len(block.A), np.shape(block.B)[1], len(block.C)
    wanted = {"A": (n, n), "B": (n, k), "C": (m, n), "D": (m, k)}
    for name, shape in wanted.items():
        value = getattr(block, name)
        if value is not None and np.shape(value) != shape:
            raise DeclarationError(f"matrix {name} of a state space has shape {np.shape(value)}; it must have {shape}.")


def matrix_of(system: Any, name: str, shape: tuple[int, int] | None) -> Any:
    """Return a matrix of a system; zeros, or None, without a system.

    Raises
    ------
    DeclarationError
        The system is sampled, or has no matrices.
    """
    if system is None:
        return None if shape is None else np.zeros(shape)
    if getattr(system, "dt", None):
        raise DeclarationError(f"the system is sampled, with a period of {system.dt} s; give a continuous one.")
    if not hasattr(system, name):
        raise DeclarationError(f"a system has matrices A, B, C and D, unlike {type(system).__name__}.")
    return np.asarray(getattr(system, name), dtype=float)
