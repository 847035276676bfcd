"""Conditions that change again and again at one time."""

from __future__ import annotations

from acausal.compiler import CompiledModel
from acausal.solve.initialization.initial_modes import origins_text


class Chattering(Exception):
    """A run cannot go on, as events repeat without end; its text is the message.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    time : float
        When, in s.
    guards : list of int
        Conditions that change.
    what : str
        What they do.
    """

    def __init__(self, compiled: CompiledModel, time: float, guards: list[int], what: str) -> None:
        super().__init__(
            f"at t = {time:.6g} s events repeat without end; these conditions {what}:\n"
            f"{origins_text(compiled, guards)}\n"
            "A body whose bounces die out, or a force that changes sign with the speed, causes this. Let a discrete "
            "variable hold it at rest (see rotational.Friction), add compliance (a spring and a damper), or use a law "
            "without a jump (smooth=True)."
        )
