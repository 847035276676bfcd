"""The warning about values that are not finite."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from acausal.result.lookup import Quantity


def invalid_values(quantity: Quantity, array: np.ndarray, time: np.ndarray, why: Callable[[int], str] | None) -> str:
    """Describe when a quantity is not finite, and why.

    Parameters
    ----------
    quantity : Quantity
        A quantity with an entry that is not finite at some time.
    array : array, shape (times, *shape)
        Its values.
    time : array, shape (times,)
        In s.
    why : callable, optional
        Function from a row to a message on the equations that are not finite there, "" if all are finite.
    """
    wrong, n = ~np.isfinite(array), time.size
    rows = wrong.reshape(n, -1).any(axis=1)
    row = int(np.argmax(rows))
    name = next((name for index, name, _ in quantity.entries if wrong[(row, *index)]), quantity.name)
    nan = bool(np.isnan(array[wrong]).any())
    what = "not a number (NaN)" if nan else "infinite"
    cause = "the square root or logarithm of a negative number, or 0/0" if nan else "a division by 0, or an overflow"
    remedy = (why and why(row)) or f"Check the equation that gives it: {cause}."
    return f"`{name}` is {what} at {rows.sum()} of {n} times, first at t = {time[row]:.6g} s. {remedy[0].upper()}{remedy[1:]}"
