"""Component, Connector, Record and Model: templates in class bodies, bound instances when a model is built."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterator
from typing import Any, ClassVar, dataclass_transform

from acausal.errors import DeclarationError
from acausal.language import declare
from acausal.language import fields as f
from acausal.language.types import shape_of_annotation


class Path:
    """Name of a member of a model that is not built: `model.beam.frame_b.r_0`; results are read by it."""

    def __init__(self, path: str, member: Any) -> None:
        self._path = path
        make = member.make if isinstance(member, f.Part) else member
        self._class = make if isinstance(make, type) else type(make)

    def __getattr__(self, name: str) -> Path:
        return Path(f"{self._path}.{name}", getattr(self._class, name, None))

    def __getitem__(self, index: int) -> Path:
        return Path(f"{self._path}[{index}]", None)

    def __str__(self) -> str:
        return self._path


@dataclass_transform(
    kw_only_default=True,
    field_specifiers=(declare.structural, declare.effect, declare.parameter),
)
class Component:
    """A part of a machine: class fields for what it has, connections() for the graph, equations() for the physics.

    Parameters
    ----------
    **values
        Values of structural parameters, effects and parameters; `fixed(...)` or `guess(...)` for variables; numbers or
        expressions for inputs; components for replaceable parts.

    Raises
    ------
    DeclarationError
        If a name is not one of the fields, or a value cannot be of this field.
    """

    fields: ClassVar[dict[str, f.Field]] = {}
    ends: ClassVar[tuple[str, str]] = ("", "")
    start_words: ClassVar[dict[str, str]] = {}
    _path: str = ""
    _ports: tuple[Any, ...] = ()
    _is_bound = False
    _in_loop = False

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        own = {}
        for name, value in list(vars(cls).items()):
            if isinstance(value, f.Field):
                own[name] = value
            elif isinstance(value, Component):
                own[name] = f.Part("", make=value, is_port=isinstance(value, Connector), name=name)
        cls.fields = {**cls.fields, **own}
        for name, field in own.items():
            if field.shape is None and not isinstance(field, f.Part | f.Outer):
                field.shape = shape_of_annotation(cls, name)

    def __init__(self, **values: Any) -> None:
        self._values = values
        frame = sys._getframe(1)
        self._origin = f"{frame.f_code.co_filename}:{frame.f_lineno}"
        for name, value in values.items():
            self._check_value(name, value)

    def _check_value(self, name: str, value: Any) -> None:
        cls = type(self)
        field = cls.fields.get(name)
        if field is None:
            near = difflib.get_close_matches(name, cls.fields, 1) or _described(cls, name)
            mend = f"did you mean `{near[0]}`?" if near else f"its fields are {', '.join(cls.fields)}."
            raise DeclarationError(f"{cls.__name__} has no field `{name}`; {mend}")
        if isinstance(field, f.Part) and value is not None and not isinstance(value, Component | list | tuple):
            raise DeclarationError(f"{cls.__name__}.{name} is a part; give a component, not {value!r}.")
        if isinstance(field, f.Variable) and field.causality != "input" and not isinstance(value, f.Start):
            raise DeclarationError(
                f"{cls.__name__}.{name} is a variable: write {name}=fixed({value!r}) for a value at the start, "
                f"or {name}=guess({value!r}) for a guess."
            )
        if isinstance(value, f.Start) and not isinstance(field, f.Variable):
            raise DeclarationError(
                f"{cls.__name__}.{name} is no variable: it takes a value, not fixed(...) or guess(...)."
            )

    def __get__(self, owner: Any, cls: type | None = None) -> Any:
        """A part read through a template that is not built gives its path."""
        if owner is None:
            return self
        name = next(name for base in type(owner).__mro__ for name, value in vars(base).items() if value is self)
        return owner._member_path(name, self)

    def _member_path(self, name: str, member: Any) -> Path:
        if self._is_bound:
            raise AttributeError(f"{self!r} does not have its `{name}` yet: variables exist in equations() only")
        return Path(name, member)

    def __repr__(self) -> str:
        return f"{self._path or 'model'} ({type(self).__name__})" if self._is_bound else f"{type(self).__name__}()"

    def connections(self) -> Iterator[Any]:
        """Yield connect(), chain(), branch(), root() and potential_root() statements."""
        yield from ()

    def equations(self) -> Iterator[Any]:
        """Yield the equations of the component, one or more for each `==`."""
        yield from ()

    def initial_equations(self) -> Iterator[Any]:
        """Yield equations that hold at the start only."""
        yield from ()

    def check(self) -> None:
        """Raise DeclarationError where the structural parameters contradict each other."""

    def requirements(self) -> Iterator[Any]:
        """Yield require(...): conditions on parameters, and on variables at the start, that must hold."""
        yield from ()

    def validity(self) -> Iterator[Any]:
        """Yield expect(...): what the component neglects, and how large that may be."""
        yield from ()

    def stored_energy(self) -> Any:
        """Energy in J that the component holds: kinetic, elastic and potential."""
        return 0

    def dissipated_power(self) -> Any:
        """Power in W that the component turns into heat, 0 or positive."""
        return 0

    def supplied_power(self) -> Any:
        """Power in W that the component brings into the model from outside."""
        return 0


def _described(cls: type[Component], word: str) -> list[str]:
    """Fields whose description has the word: `mass` for `m`."""
    values = {name: field for name, field in cls.fields.items() if not isinstance(field, f.Part | f.Outer)}
    return [name for name, field in values.items() if word in field.description.lower().split()]


class Connector(Component):
    """A kind of port: potential variables that become equal, flow variables that sum to zero.

    A connector whose potentials are an over-determined record overrides declared_derivatives(), residual() and
    root_equations().
    """

    _is_root = False
    _owner: Any = None
    _parents: tuple[Any, ...] = ()

    def declared_derivatives(self) -> Iterator[tuple[Any, Any]]:
        """Yield pairs (variable, expression of its time derivative)."""
        yield from ()

    def residual(self, other: Any) -> Iterator[tuple[Any, Any]]:
        """Yield pairs (independent equations that make this record equal to the other one, flows that work on them).

        Used where a loop is cut: where an equation says nothing new, the flow that works on it is undetermined.
        """
        yield from ()

    def loop_kind(self, undetermined: tuple[str, ...]) -> str:
        """Name a loop by the flows that its redundant equations leave undetermined, for reports."""
        return "loop"

    def root_equations(self) -> Iterator[Any]:
        """Yield the equations of a chosen potential root.

        Variables with a declared derivative that are not defined by them are integrated.
        """
        yield from ()


class Record(Component):
    """Variables that belong together, without physics of their own."""


class Model(Component):
    """A component that can be compiled and simulated; its outputs are the columns of its table of results."""
