"""Fields of a component class; they get values when the model is built."""

from __future__ import annotations

import inspect
import operator
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

from acausal.errors import DeclarationError, user_line
from acausal.language.condition import Condition
from acausal.language.expression import Expr, as_expr
from acausal.language.pending import reading
from acausal.language.symbolic import Symbolic

NEVER, AVOID, DEFAULT, PREFER, ALWAYS = -2, -1, 0, 1, 2
MISSING: Any = type("Missing", (), {"__repr__": lambda self: "no default", "__bool__": lambda self: False})()
Shape = tuple[int, ...] | Callable[[Any], tuple[int, ...]] | None


class Template:
    """Base of all components, the templates of parts."""

    _is_port = False


class Deferrable(Symbolic):
    """A value in a class body that is known only in an instance; arithmetic with it is deferred as well."""

    is_deferred = True
    _lacks = "has no value in the class body"
    _instead = "write a function of the component where a default is wanted, default=lambda s: ..."

    def evaluate(self, owner: Any) -> Any:
        """Return the value in a built component."""
        raise NotImplementedError

    def __getitem__(self, index: Any) -> Deferred:
        return Deferred(operator.getitem, (self, index))

    def __iter__(self) -> Any:
        raise DeclarationError(
            "a field cannot be iterated over in the class body, where its value is not known yet. Write its entries, "
            "such as (r[0], r[1], r[2]), or iterate over self.<name> in equations()."
        )

    def __neg__(self) -> Deferred:
        return Deferred(operator.neg, (self,))

    def __abs__(self) -> Deferred:
        return Deferred(abs, (self,))

    def _shown(self) -> str:
        return "a field"

    def __bool__(self) -> bool:
        raise DeclarationError(
            "a field has no value in the class body, so Python cannot decide on it with `if`, `and` or `or`. "
            "Declare it structural(...) and decide in equations() or in a method marked @part, with self.<name>."
        )

    def __lt__(self, other: Any) -> Condition:
        return Condition(self - other, "<")  # type: ignore[operator]

    def __le__(self, other: Any) -> Condition:
        return Condition(self - other, "<=")  # type: ignore[operator]

    def __gt__(self, other: Any) -> Condition:
        return Condition(other - self, "<")

    def __ge__(self, other: Any) -> Condition:
        return Condition(other - self, "<=")


def _binary(operate: Callable[[Any, Any], Any]) -> tuple[Any, Any]:
    def forward(self: Any, other: Any) -> Deferred:
        return Deferred(operate, (self, other))

    def backward(self: Any, other: Any) -> Deferred:
        return Deferred(operate, (other, self))

    return forward, backward


for _name in ("add", "sub", "mul", "truediv", "floordiv", "matmul", "mod", "pow"):
    _forward, _backward = _binary(getattr(operator, _name))
    setattr(Deferrable, f"__{_name}__", _forward)
    setattr(Deferrable, f"__r{_name}__", _backward)


class Deferred(Deferrable):
    """A function of deferred values, evaluated in the component whose class body contains it."""

    def __init__(self, function: Callable[..., Any], arguments: Sequence[Any]) -> None:
        self.function = function
        self.arguments = arguments

    def evaluate(self, owner: Any) -> Any:
        """Return the value in the built component `owner`."""
        return self.function(*[evaluate(argument, owner) for argument in self.arguments])


def evaluate(value: Any, owner: Any) -> Any:
    """Return `value` with every deferred value in it replaced by its value in the built component `owner`."""
    if isinstance(value, Deferrable):
        return value.evaluate(owner)
    if isinstance(value, Condition):
        return value.replaced(lambda c: Condition(evaluate(c.excess, owner), c.kind, c.sides))
    if type(value) in (list, tuple):
        own = [evaluate(item, owner) for item in value]
        return value if all(a is b for a, b in zip(own, value, strict=True)) else type(value)(own)
    if is_dataclass(value) and not isinstance(value, type):
        given = {f.name: getattr(value, f.name) for f in fields(value) if f.init}
        own = {name: evaluate(item, owner) for name, item in given.items()}
        return replace(value, **own) if any(own[name] is not item for name, item in given.items()) else value
    return value


@dataclass(frozen=True, repr=False)
class InitialValue:
    """A start value: an equation of the initial system if `fixed`, otherwise a guess."""

    value: Any
    fixed: bool
    nominal: Any = None

    def __repr__(self) -> str:
        return f"{'fixed' if self.fixed else 'guess'}({self.value!r})"


@dataclass(eq=False, repr=False)
class Field(Deferrable):
    """A declared member of a component class."""

    description: str
    unit: str | Sequence[str] | Callable[[Any], Sequence[str]] | None = None
    shape: Shape = None
    default: Any = MISSING
    name: str = ""
    doc: str = ""  # follows the description, in the docstring of the class only
    where: str = ""  # file and line

    def __post_init__(self) -> None:
        self.where = user_line()

    def __set_name__(self, owner: type, name: str) -> None:
        # A second name is a reference to the first: `load = R.spare`.
        self.name = self.name or name

    def __get__(self, owner: Any, cls: type | None = None) -> Any:
        """Return the field in a class, and its path in a template."""
        return self if owner is None else owner._member_path(self.name, self)

    def __repr__(self) -> str:
        """Return the text of the field in help(): `<parameter in kg: mass>`."""
        unit = f" in {self.unit}" if isinstance(self.unit, str) and self.unit != "1" else ""
        return f"<{self._kind()}{unit}: {self.description}>"

    def _kind(self) -> str:
        return "port" if self.connector else type(self).__name__.lower()

    @property
    def connector(self) -> str:
        """Class of a port, with ", optional" if it may be absent; "" for other fields."""
        return ""

    def evaluate(self, owner: Any) -> Any:
        """Return the value of the field in the built component `owner`."""
        return getattr(owner, self.name)


@dataclass(eq=False, repr=False)
class Structural(Field):
    """A parameter that fixes sizes and equations; a plain Python value in an instance."""

    choices: tuple[Any, ...] | None = None
    cls: type | None = None
    minimum: float | None = None
    maximum: float | Callable[[Any], float] | None = None
    effect: bool = False
    tries: tuple[Any, ...] | None = None
    refine: Callable[[Any], bool] | None = None

    def _kind(self) -> str:
        return "effect" if self.effect else "structural parameter"


@dataclass(eq=False, repr=False)
class Parameter(Field):
    """A number or array that can be changed after compiling."""

    minimum: float | None = None
    positive: bool = False


@dataclass(eq=False, repr=False)
class Variable(Field):
    """An unknown of the model."""

    start: Any = 0.0
    fixed: bool = False
    select: int = DEFAULT
    nominal: Any = None
    causality: str = ""
    flow: bool = False
    root: bool = False


@dataclass(eq=False, repr=False)
class Part(Field):
    """A component inside another: a template, or a method that creates it from structural values."""

    make: Any = None
    many: bool = False
    is_port: bool = False
    family: str = ""  # for a port whose name is known only in an instance: the field of the class that creates it

    @property
    def connector(self) -> str:
        """Class of a port, from the annotation if a method creates it; "" for other parts."""
        if not self.is_port or self.make is None:
            return ""
        if isinstance(self.make, type):
            return self.make.__name__
        if isinstance(self.make, Template):
            return type(self.make).__name__
        kind = inspect.get_annotations(self.make).get("return", "port")
        text = kind if isinstance(kind, str) else re.sub(r"[\w.<>]+\.", "", inspect.formatannotation(kind))
        return text.replace(" | None", ", optional")


@dataclass(eq=False, repr=False)
class Family(Part):
    """Ports whose names are known only in an instance, where they replace this field."""

    def __get__(self, owner: Any, cls: type | None = None) -> Any:
        """Return the ports of a built component by name."""
        if owner is None or self.name in owner.fields:
            return super().__get__(owner, cls)
        ports = {name: field for name, field in owner.fields.items() if isinstance(field, Part)}
        return {name: vars(owner)[name] for name, field in ports.items() if field.family == self.name}


@dataclass(eq=False, repr=False)
class Outer(Field):
    """A reference to the single component of a class in the model."""

    cls: type = object


@dataclass(eq=False, repr=False)
class Observed(Field):
    """A quantity computed from results on request, without a variable or an equation."""

    compute: Any = None

    def __get__(self, owner: Any, cls: type | None = None) -> Any:
        """Return the expression in a built component."""
        if owner is None or not owner._is_bound:
            return super().__get__(owner, cls)
        with reading() as requests:
            value = requests.value((id(owner), self.name), lambda: as_expr(self.compute(owner)))
        return Expr(value.sx, value.unit, f"{owner._path}.{self.name}" if owner._path else self.name, value.shape)
