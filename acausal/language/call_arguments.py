"""Messages for wrong arguments of public functions, with the line of the call."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from inspect import Parameter
from typing import Any, TypeVar

from acausal.errors import AcausalError, DeclarationError, user_line
from acausal.language.formatting import short
from acausal.nearest import most_similar

F = TypeVar("F", bound=Callable[..., Any])
# Names of arguments in other tools -> names here.
MEANT = {
    "default": ("start", "value"),
    "value": ("default", "start"),
    "start": ("default", "value", "start_time"),
    "init": ("start", "default", "initial"),
    "min": ("minimum",),
    "size": ("shape",),
    "max": (),
    "maximum": (),
    **dict.fromkeys(("t_end", "tend", "t_final", "tf", "t_stop", "t_max", "end_time", "end", "stop"), ("stop_time",)),
    **dict.fromkeys(("duration", "until", "time"), ("stop_time",)),
    **dict.fromkeys(("t", "at"), ("stop_time", "time")),
    **dict.fromkeys(("t0", "t_start", "tstart", "begin"), ("start_time",)),
    **dict.fromkeys(("tol", "rtol", "reltol"), ("tolerance",)),
    **dict.fromkeys(("n", "steps", "n_steps", "points", "n_points", "dt", "step", "step_size"), ("intervals",)),
    **dict.fromkeys(("solver", "integrator"), ("method",)),
    **dict.fromkeys(("params", "parameter", "values", "settings"), ("parameters",)),
    **dict.fromkeys(("file", "filename", "file_name", "fname"), ("path",)),
}
# Arguments of `simulate` that a model may declare.
SETTINGS = ("stop_time", "tolerance", "accuracy", "intervals", "initial", "method", "constraints", "max_order")
MARKS = ("part", "parts", "ports", "observed")


def declaration_error(text: str, line: str = "", kind: type[AcausalError] = DeclarationError) -> AcausalError:
    """Return an error with its line, by default that of the user's statement in execution."""
    error = kind(text)
    error.line = line or user_line()
    return error


def checked_call(function: F) -> F:
    """Decorate a function of the language: errors get the line of the call, wrong arguments a DeclarationError."""
    checked = checked_arguments(function)

    @wraps(function)
    def call(*given: Any, **named: Any) -> Any:
        try:
            return checked(*given, **named)
        except AcausalError as error:
            error.line = error.line or user_line()
            raise

    return call  # type: ignore[return-value]


def checked_arguments(function: F) -> F:
    """Decorate a function that runs models, or a method: wrong arguments raise DeclarationError with the line."""

    @wraps(function)
    def call(*given: Any, **named: Any) -> Any:
        try:
            return function(*given, **named)
        except TypeError:
            if wrong := _misfit(function, given, named):
                raise declaration_error(wrong) from None
            raise

    return call  # type: ignore[return-value]


def decorator_message(mark: str) -> str:
    """Return the message for a decorator of methods that is called with arguments."""
    form = "def ...(self): return ..."
    return (
        f"@{mark} decorates a method: write it without parentheses above `{form}`, whose docstring is the description."
    )


def _misfit(function: Callable[..., Any], given: Sequence[Any], named: Mapping[str, Any]) -> str:
    """Return the message for wrong arguments of a call, "" for correct ones."""
    parameters = dict(inspect.signature(function).parameters)
    name = function.__name__
    if name in MARKS:
        return decorator_message(name)
    if parameters.pop("self", None):
        given = given[1:]
    kinds = [p.kind for p in parameters.values()]
    places = [
        n for n, p in parameters.items() if p.kind in (Parameter.POSITIONAL_ONLY, Parameter.POSITIONAL_OR_KEYWORD)
    ]
    needed = [n for n in places if parameters[n].default is Parameter.empty]
    other = [n for n, p in parameters.items() if p.kind is Parameter.KEYWORD_ONLY]
    several = [f"*{n}" for n, p in parameters.items() if p.kind is Parameter.VAR_POSITIONAL]
    form = f"`{name}({', '.join([*needed, *several])})`"
    unknown = next((n for n in named if n not in (*places, *other)), None)
    if unknown is not None and Parameter.VAR_KEYWORD not in kinds:
        meant = [n for n in MEANT.get(unknown, ()) if n in parameters]
        near = "".join(meant[:1]) if unknown in MEANT else most_similar(unknown, [*places, *other])
        known = f"its arguments are {', '.join([*places, *several, *other])}." if other else f"write {form}."
        if "parameters" in parameters:
            value = short(named[unknown])
            way = f"set a value of the model by its path, parameters={{{unknown!r}: {value}}}"
            if unknown in SETTINGS:
                way = f"declare it in the class of the model, {unknown} = {value}"
            known = f"{way}. The arguments are {', '.join([*places, *other])}."
        return f"{name}() has no argument `{unknown}`; {f'did you mean `{near}`?' if near else known}"
    if name == "der" and len(given) > 1:
        order = "the second derivative is" if given[1] == 2 else "nest the calls for higher derivatives, as"
        return f"der({', '.join(map(short, given))}): {order} der(der({short(given[0])}))."
    if len(given) > len(places) and Parameter.VAR_POSITIONAL not in kinds:
        only = f"{name}() takes {len(places)} positional argument{'s' * (len(places) != 1)}, not {len(given)}"
        whole = f"`{name}({', '.join(places)})`"
        return (
            f"{only}; write {whole}." if not other else f"{only}; the others are keyword arguments: {', '.join(other)}."
        )
    missing = [n for n in needed[len(given) :] if n not in named]
    return f"{name}() needs the argument `{missing[0]}`; write {form}." if missing else ""
