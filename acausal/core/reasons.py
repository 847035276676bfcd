"""Why an integration, a step or an event iteration of the core ended."""

from __future__ import annotations

from enum import IntEnum


class End(IntEnum):
    """How an integration ended.

    At its last output; after the steps it was given; with too many between two outputs; by step size underflow, of the error
    test (`SHORT`) or as the equations had no value or no regular Jacobian (`UNSOLVED`); without memory; as the tolerance is
    below round-off.
    """

    DONE = 0
    MORE = 1
    MANY = 2
    SHORT = 3
    UNSOLVED = 4
    MEMORY = 5
    ROUNDING = 6


class Doubt(IntEnum):
    """Reasons of doubt, beside those of `End`, and why an event iteration fails.

    Closed loops are in a singular configuration, or creep towards one; algebraic unknowns jump; a condition has no value;
    conditions do not settle; what is differentiated jumps; a jump gives no finite number; closed loops do not close after it;
    two statements set one variable to different values; or a function that is called fails.
    """

    SINGULAR = 16
    FOLD = 17
    UNDEFINED = 18
    UNSETTLED = 19
    DISCONTINUOUS = 20
    NO_NUMBER = 21
    APART = 22
    CONTRADICTION = 23
    FUNCTION = 24
