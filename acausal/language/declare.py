"""The functions that declare the fields of a component in its class body."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from acausal.errors import DeclarationError
from acausal.language.call_arguments import brackets, checked_call
from acausal.language.fields import (
    DEFAULT,
    MISSING,
    Family,
    Observed,
    Outer,
    Parameter,
    Part,
    Shape,
    Structural,
    Variable,
)


@checked_call
def structural(
    description: str,
    *,
    default: Any = MISSING,
    choices: Sequence[Any] | None = None,
    cls: type | None = None,
    minimum: float | None = None,
    maximum: float | Callable[[Any], float] | None = None,
    shape: Shape = None,
    refine: Callable[[Any], bool] | None = None,
    doc: str = "",
) -> Any:
    """Declare a structural parameter: fixed when the model is compiled, a plain Python value in equations().

    Parameters
    ----------
    description : str
        What it is.
    default : object
        Value where none is given; a function of the component for one that depends on other structural parameters.
    choices : sequence, optional
        The allowed values; of an array those of each entry.
    cls : type, optional
        Class of the value, int for a whole number. None is allowed as well where it is the default. Where the class reads
        files, `load(path)`, the name of a file stands for what it holds. Data that are compared, in a journal or a study,
        have `==` and a short `repr`.
    minimum : float, optional
        The least allowed value.
    maximum : float or callable, optional
        The greatest allowed value; a function of the component for one that depends on other structural parameters.
    shape : tuple of int, optional
        Shape of an array of numbers.
    refine : callable, optional
        For a number of elements that refines the component towards its continuum: a function of the
        component that returns whether simulate(accuracy=...) may choose it.
    doc : str, optional
        More about it, for the docstring of the class alone.
    """
    allowed = _allowed(choices) if choices else None
    return Structural(
        description,
        None,
        shape,
        default,
        choices=allowed,
        cls=cls,
        minimum=minimum,
        maximum=maximum,
        refine=refine,
        doc=doc,
    )


@checked_call
def effect(
    description: str,
    *,
    default: Any = True,
    choices: Sequence[Any] = (True, False),
    tries: Sequence[Any] | None = None,
    doc: str = "",
) -> Any:
    """Declare a physical effect that can be switched: a structural parameter that the tool can list and price.

    Parameters
    ----------
    description : str
        What it is.
    default : object
        Value where none is given.
    choices : sequence
        The allowed values, the most complete first.
    tries : sequence, optional
        The choices that a study of effects tries beside the one in force, all if not given.
    doc : str, optional
        More about it, for the docstring of the class alone.
    """
    allowed, tried = _allowed(choices), None if tries is None else _allowed(tries)
    return Structural(description, None, None, default, choices=allowed, effect=True, tries=tried, doc=doc)


@checked_call
def parameter(
    description: str,
    *,
    unit: str | Sequence[str] | None = None,
    default: Any = MISSING,
    shape: Shape = None,
    minimum: float | None = None,
    positive: bool = False,
    doc: str = "",
) -> Any:
    """Declare a parameter: changeable after compiling, except for entries that are exactly 0 when compiled.

    Parameters
    ----------
    description : str
        What it is, and in which frame it is resolved.
    unit : str or sequence of str
        SI unit, or one for each entry; none is unknown and fits every unit, "1" is a number.
    default : float, array or callable
        Value where none is given; a function of the component for one that follows other parameters.
    shape : tuple of int, optional
        Shape where the annotation does not tell.
    minimum : float, optional
        Least allowed value of every entry.
    positive : bool
        True if every entry must be greater than 0.
    doc : str, optional
        More about it, for the docstring of the class alone.
    """
    return Parameter(description, unit, shape, default, minimum=minimum, positive=positive, doc=doc)


@checked_call
def variable(
    description: str,
    *,
    unit: str | Sequence[str] | Callable[[Any], Sequence[str]] | None = None,
    shape: Shape = None,
    start: Any = 0.0,
    fixed: bool = False,
    select: int = DEFAULT,
    nominal: Any = None,
    root: bool = False,
) -> Any:
    """Declare a variable.

    Parameters
    ----------
    description : str
        What it is, and in which frame it is resolved.
    unit : str or sequence of str
        SI unit, or one for each entry; none is unknown and fits every unit, "1" is a number.
    shape : tuple of int or callable, optional
        Shape where the annotation does not tell; a function of the component if it depends on structural parameters.
    start : float or array
        Guess at the start, or value at the start if `fixed`.
    fixed : bool
        True makes `start` an equation of the initial system.
    select : int
        NEVER, AVOID, DEFAULT, PREFER or ALWAYS: how strongly it is preferred as a state.
    nominal : float or array or callable
        Typical size, in its unit; absolute tolerance = tolerance * nominal. If not given it is 1, or what all such
        variables of the same unit reach in a run if that is less.
    root : bool
        True for a variable that a connector has only when it is chosen as a root.
    """
    return Variable(description, unit, shape, start=start, fixed=fixed, select=select, nominal=nominal, root=root)


@checked_call
def discrete(description: str, *, unit: str | None = None, shape: Shape = None, start: Any = 0.0) -> Any:
    """Declare a discrete variable: constant except where `when` lets it jump by reinit(...).

    Parameters
    ----------
    description : str
        What its values mean.
    unit : str, optional
        SI unit.
    shape : tuple of int, optional
        Shape where the annotation does not tell.
    start : float, array or expression of other fields
        Value at the start, such as sign(w_rel); 0 if not given.
    """
    return Variable(description, unit, shape, start=start, causality="discrete")


@checked_call
def input(
    description: str,
    *,
    unit: str | Sequence[str] | None = None,
    shape: Shape = None,
    start: Any = 0.0,
    default: Any = MISSING,
    doc: str = "",
) -> Any:
    """Declare an input: given by the constructor, by connect() or by an equation of what contains it, else its default.

    At the top of the model it is a number that may change from run to run, `default`, or else `start`, if not given.
    """
    return Variable(description, unit, shape, default, start=start, causality="input", doc=doc)


@checked_call
def output(
    description: str, *, unit: str | Sequence[str] | None = None, shape: Shape = None, nominal: Any = None
) -> Any:
    """Declare an output; those of the model are the columns of its table of results."""
    return Variable(description, unit, shape, nominal=nominal, causality="output")


@checked_call
def flow(description: str, *, unit: str | None = None, shape: Shape = None) -> Any:
    """Declare a flow variable of a connector: the flows into the components of a connection set sum to zero."""
    return Variable(description, unit, shape, flow=True)


@checked_call
def port(connector: Any, description: str = "") -> Any:
    """Declare a port: `port(Frame)`, or as decorator of a method that returns a connector or None.

    Parameters
    ----------
    connector : Connector class or method
        The class of the port, or a method that makes it from structural values (None: no such port).
    description : str
        What is fixed to it.
    """
    return Part(description or getattr(connector, "__doc__", None) or "", make=connector, is_port=True)


@checked_call
def ports(make: Callable[[Any], Any]) -> Any:
    """Decorate a method that makes ports from structural values, a dict of connectors by name: `body.tip` for "tip"."""
    return Family(_described(make, "ports"), make=make, is_port=True)


@checked_call
def part(make: Callable[[Any], Any]) -> Any:
    """Decorate a method that makes a part from structural values; None leaves the part out."""
    return Part(_described(make, "part"), make=make)


@checked_call
def parts(make: Callable[[Any], Any]) -> Any:
    """Decorate a method that makes a list of parts from structural values."""
    return Part(_described(make, "parts"), make=make, many=True)


@checked_call
def observed(compute: Callable[[Any], Any]) -> Any:
    """Decorate a method that returns an expression: readable in results like a variable, at no cost during the run."""
    return Observed(_described(compute, "observed"), compute=compute)


@checked_call
def outer(cls: type) -> Any:
    """Declare a reference to the one component of class `cls` in the model, such as the World."""
    if not isinstance(cls, type):
        raise DeclarationError(f"outer() takes the class of the component, such as outer(World), not {cls!r}.")
    return Outer(f"the {cls.__name__} of the model", cls=cls)


def _described(method: Any, mark: str) -> str:
    """Return the docstring of a method that is marked."""
    if isinstance(method, str):
        raise DeclarationError(brackets(mark))
    return method.__doc__ or ""


def _allowed(choices: Sequence[Any]) -> tuple[Any, ...]:
    if isinstance(choices, str) or not isinstance(choices, Sequence):
        raise DeclarationError(f'choices stand in brackets: choices=("dynamic", "none"), not choices={choices!r}.')
    return tuple(choices)
