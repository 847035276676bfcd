"""Functions that declare the fields of a component in its class body."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_call, decorator_message
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
        Description of the field, a noun phrase.
    default : object
        Value if none is given; a function of the component for one that depends on other structural parameters.
    choices : sequence, optional
        The allowed values; for an array, those of each entry.
    cls : type, optional
        Class of the value, int for a whole number. None is allowed as well if it is the default. If the class has
        `load(path)`, the name of a file may be given instead of its content. Data that a journal or a study compares
        need `==` and a short `repr`.
    minimum : float, optional
        The least allowed value.
    maximum : float or callable, optional
        The greatest allowed value; a function of the component for one that depends on other structural parameters.
    shape : tuple of int, optional
        Shape of an array of numbers.
    refine : callable, optional
        For a number of elements that approximates a continuum: a function of the component that returns whether
        simulate(accuracy=...) may choose the number.
    doc : str, optional
        Further explanation, only in the docstring of the class.
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
    """Declare a physical effect that can be switched: a structural parameter that studies list and evaluate.

    Parameters
    ----------
    description : str
        Description of the field, a noun phrase.
    default : object
        Value if none is given.
    choices : sequence
        The allowed values, the most complete first.
    tries : sequence, optional
        Choices that a study of effects tries beside the current one; default: all.
    doc : str, optional
        Further explanation, only in the docstring of the class.
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
    """Declare a parameter: it can be changed after compiling, except for entries that are exactly 0 when compiled.

    Parameters
    ----------
    description : str
        Description of the field, with the frame in which it is resolved.
    unit : str or sequence of str
        SI unit, or one for each entry; None is unknown and fits every unit, "1" is a pure number.
    default : float, array or callable
        Value if none is given; a function of the component for one that depends on other parameters, which returns None if
        a value must be given.
    shape : tuple of int, optional
        Shape, if the annotation does not determine it.
    minimum : float, optional
        Smallest allowed value of every entry.
    positive : bool
        True if every entry must be greater than 0.
    doc : str, optional
        Further explanation, only in the docstring of the class.
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
        Description of the field, with the frame in which it is resolved.
    unit : str or sequence of str
        SI unit, or one for each entry; None is unknown and fits every unit, "1" is a pure number.
    shape : tuple of int or callable, optional
        Shape, if the annotation does not determine it; a function of the component if it depends on structural
        parameters.
    start : float or array
        Initial guess, or initial value if `fixed`.
    fixed : bool
        True makes `start` an equation of the initial system.
    select : int
        NEVER, AVOID, DEFAULT, PREFER or ALWAYS: how strongly it is preferred as a state.
    nominal : float or array or callable
        Nominal value, in the unit of the variable; absolute tolerance = tolerance * nominal. Default: 1, or the largest
        magnitude in a run of all such variables of the same unit if that is less.
    root : bool
        True for a variable that exists only in a connector that is chosen as a root.
    """
    return Variable(description, unit, shape, start=start, fixed=fixed, select=select, nominal=nominal, root=root)


@checked_call
def discrete(description: str, *, unit: str | None = None, shape: Shape = None, start: Any = 0.0) -> Any:
    """Declare a discrete variable: constant between events, changed by reinit(...) in `when`.

    Parameters
    ----------
    description : str
        Meaning of its values.
    unit : str, optional
        SI unit.
    shape : tuple of int, optional
        Shape, if the annotation does not determine it.
    start : float, array or expression of other fields
        Initial value, such as sign(w_rel); default 0.
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
    """Declare an input: set by the constructor, by connect() or by an equation of the containing component.

    Otherwise it has its default. An input of the whole model is a number that may change from run to run; if none is
    given, it is `default`, or `start` without a default.
    """
    return Variable(description, unit, shape, default, start=start, causality="input", doc=doc)


@checked_call
def output(
    description: str, *, unit: str | Sequence[str] | None = None, shape: Shape = None, nominal: Any = None
) -> Any:
    """Declare an output; outputs of the whole model are the columns of its table of results."""
    return Variable(description, unit, shape, nominal=nominal, causality="output")


@checked_call
def flow(description: str, *, unit: str | None = None, shape: Shape = None) -> Any:
    """Declare a flow variable of a connector: the flows into the components of a connection set sum to zero."""
    return Variable(description, unit, shape, flow=True)


@checked_call
def port(connector: Any, description: str = "") -> Any:
    """Declare a port: `port(Frame)`, or as a decorator of a method that returns a connector or None.

    Parameters
    ----------
    connector : Connector class or method
        Class of the port, or a method that creates it from structural values (None: no port).
    description : str
        What the port is attached to.
    """
    return Part(description or getattr(connector, "__doc__", None) or "", make=connector, is_port=True)


@checked_call
def ports(make: Callable[[Any], Any]) -> Any:
    """Decorate a method that returns a dict of ports by name, from structural values: `body.tip` for "tip"."""
    return Family(_described(make, "ports"), make=make, is_port=True)


@checked_call
def part(make: Callable[[Any], Any]) -> Any:
    """Decorate a method that returns a part, from structural values; None leaves the part out."""
    return Part(_described(make, "part"), make=make)


@checked_call
def parts(make: Callable[[Any], Any]) -> Any:
    """Decorate a method that returns a list of parts, from structural values."""
    return Part(_described(make, "parts"), make=make, many=True)


@checked_call
def observed(compute: Callable[[Any], Any]) -> Any:
    """Decorate a method that returns an expression: read from results like a variable, without cost in the run."""
    return Observed(_described(compute, "observed"), compute=compute)


@checked_call
def outer(cls: type) -> Any:
    """Declare a reference to the single component of class `cls` in the model, such as the World."""
    if not isinstance(cls, type):
        raise DeclarationError(f"outer() takes the class of the component, such as outer(World), not {cls!r}.")
    return Outer(f"the {cls.__name__} of the model", cls=cls)


def _described(method: Any, mark: str) -> str:
    """Return the docstring of a decorated method."""
    if isinstance(method, str):
        raise DeclarationError(decorator_message(mark))
    return method.__doc__ or ""


def _allowed(choices: Sequence[Any]) -> tuple[Any, ...]:
    if isinstance(choices, str) or not isinstance(choices, Sequence):
        raise DeclarationError(f'choices is a tuple or list: choices=("dynamic", "none"), not choices={choices!r}.')
    return tuple(choices)
