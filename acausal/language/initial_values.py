"""Start values of variables: initial conditions and guesses."""

from __future__ import annotations

from typing import Any

from acausal.language.call_arguments import checked_call
from acausal.language.fields import InitialValue


@checked_call
def fixed(value: Any, *, nominal: Any = None) -> Any:
    """Initial condition of a variable: `Revolute(phi=fixed(0.1))`, `Body(v_0=fixed((1, None, guess(2))))`.

    Parameters
    ----------
    value : float, sequence or parameter
        Value at the start time, in the unit and shape of the variable. An entry None of a vector is left free, an entry
        guess(...) is only a guess.
    nominal : float or array, optional
        Nominal value, in the unit of the variable.
    """
    return InitialValue(value, True, nominal)


@checked_call
def guess(value: Any, *, nominal: Any = None) -> Any:
    """First guess of a variable in the search of consistent initial values: `Revolute(w=guess(2))`.

    Parameters
    ----------
    value : float, sequence or parameter
        Guess in the unit and shape of the variable.
    nominal : float or array, optional
        Nominal value, in the unit of the variable.
    """
    return InitialValue(value, False, nominal)
