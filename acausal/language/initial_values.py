"""Start values of variables: conditions and guesses."""

from __future__ import annotations

from typing import Any

from acausal.language.call_arguments import checked_call
from acausal.language.fields import InitialValue


@checked_call
def fixed(value: Any, *, nominal: Any = None) -> Any:
    """Start value that holds at the start: `Revolute(phi=fixed(0.1))`, `Body(v_0=fixed((1, None, guess(2))))`.

    Parameters
    ----------
    value : float, sequence or parameter
        Value of the variable at the start time, in its unit and shape. An entry of a vector that is None is left open, one
        that is guess(...) helps alone.
    nominal : float or array, optional
        Typical size of the variable, in its unit.
    """
    return InitialValue(value, True, nominal)


@checked_call
def guess(value: Any, *, nominal: Any = None) -> Any:
    """Start value that only helps to find consistent initial values: `Revolute(w=guess(2))`.

    Parameters
    ----------
    value : float, sequence or parameter
        Guess in the unit and shape of the variable.
    nominal : float or array, optional
        Typical size of the variable, in its unit.
    """
    return InitialValue(value, False, nominal)
