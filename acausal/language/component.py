"""Component, Connector, Record and Model: templates in class bodies, bound instances in built models."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, Self, cast, dataclass_transform

from acausal.errors import PACKAGE, DeclarationError
from acausal.language import declare
from acausal.language import fields as f
from acausal.language.body import read_body
from acausal.language.call_arguments import checked_call, declaration_error
from acausal.language.component_html import component_html
from acausal.language.docstring import signature, with_fields
from acausal.language.invalid_settings import refuse_attribute, refuse_value
from acausal.language.misspelt_fields import SETTINGS
from acausal.language.path import Path
from acausal.language.signal import CONNECTING, Signal
from acausal.language.value_checks import (
    check_value,
    class_keyword_message,
    positional_message,
    refuse_decorator,
    shown,
)


class _Docstring:
    """The `__doc__` of a component class: sections for its fields are generated on access."""

    def __init__(self, written: str) -> None:
        self.written = written

    def __get__(self, owner: Any, cls: Any) -> str:
        return with_fields(cls, self.written)


class _Signature:
    """The `__signature__` of a component class, computed on access from its fields or its own constructor."""

    def __get__(self, owner: Any, cls: Any) -> inspect.Signature:
        if cls.__init__ is Component.__init__:
            return signature(cls)
        written = inspect.signature(cls.__init__)
        return written.replace(parameters=[*written.parameters.values()][1:])


@dataclass_transform(
    kw_only_default=True,
    field_specifiers=(declare.structural, declare.effect, declare.parameter),
)
class Component(f.Template):
    """A part of a machine: fields in the class body, connections() for the graph, equations() for the physics.

    Parameters
    ----------
    **values
        Values of structural parameters, effects and parameters; `fixed(...)` or `guess(...)` for variables; numbers or
        expressions for inputs; components for replaceable parts.

    Raises
    ------
    DeclarationError
        If a name is not that of a field, or a value is invalid for its field.

    Notes
    -----
    The docstring of a derived class receives sections of its parameters, ports and variables from its fields. That of a
    class that is only a base of others begins with "Base".
    """

    __signature__: ClassVar[Any] = _Signature()
    fields: ClassVar[dict[str, f.Field]] = {}
    ends: ClassVar[tuple[str, str]] = ("", "")
    start_words: ClassVar[dict[str, str]] = {}
    without_soft: ClassVar[str] = ""  # the argument that leaves out its soft conditions, for messages
    _own_fields: ClassVar[dict[str, f.Field]] = {}
    _own_values: ClassVar[dict[str, Any]] = {}
    _class_values: ClassVar[dict[str, Any]] = {}
    _as_read: ClassVar[dict[str, Any]]
    _line: ClassVar[str]
    _settings: ClassVar[tuple[str, ...]] = ()
    _values: Mapping[str, Any] = MappingProxyType({})
    _origin = ""
    _path: str = ""
    _ports: tuple[Any, ...] = ()
    _demand: Callable[[str], Any] | None = None
    _is_bound = False
    _in_loop = False

    @checked_call
    def __init_subclass__(cls, **kwargs: Any) -> None:
        try:
            super().__init_subclass__(**kwargs)
        except TypeError:
            if not kwargs:
                raise
            name, value = next(iter(kwargs.items()))
            raise DeclarationError(class_keyword_message(cls, name, value)) from None
        read_body(cls)
        if cls.__doc__:
            cls.__doc__ = cast(Any, _Docstring(cls.__doc__))

    def __new__(cls, *_: Any, **__: Any) -> Self:
        """Refuse classes whose constructor a decorator replaced: it does not know the fields."""
        refuse_decorator(cls)
        return super().__new__(cls)

    @checked_call
    def __init__(self, *unnamed: Any, **values: Any) -> None:
        if unnamed:
            raise DeclarationError(positional_message(type(self), unnamed, values))
        self._origin = _constructed_at(self)
        self._values = {name: check_value(type(self), name, value) for name, value in values.items()}

    def __setattr__(self, name: str, value: Any) -> None:
        if name in self.fields or name in type(self).fields:
            raise declaration_error(refuse_value(self, name, value))
        if name[0] != "_":
            refuse_attribute(self, name, value)
        object.__setattr__(self, name, value)

    def __get__(self, owner: Any, cls: type | None = None) -> Any:
        """Return a part in a class, and its path in a template."""
        if owner is None:
            return self
        name = next(name for base in type(owner).__mro__ for name, value in vars(base).items() if value is self)
        return owner._member_path(name, self)

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Return the path of a port of a family in a template: only bound instances know their names."""
            families = any(isinstance(field, f.Family) for field in self.fields.values())
            known = name in self._settings or any(name in vars(base) for base in type(self).__mro__)
            if name[0] == "_" or known or self._is_bound or not families:
                return object.__getattribute__(self, name)  # raises AttributeError
            return Path(name, None)

    def _member_path(self, name: str, member: Any) -> Any:
        if not self._is_bound:
            return Path(name, member)
        if self._demand is not None and isinstance(member, f.Structural | f.Parameter):
            return self._demand(name)
        if isinstance(member, f.Variable) and member.causality in ("input", "output") and CONNECTING.get():
            return Signal(self, name, member.causality)
        when = "equations() only" if isinstance(member, f.Variable) else "connections() and equations()"
        raise AttributeError(
            f"{self!r} does not have its `{name}` yet: it exists in {when}. What contains it belongs there."
        )

    def __repr__(self) -> str:
        if self._is_bound:
            return f"{self._path or 'model'} ({type(self).__name__})"
        return shown(self, f"{type(self).__name__}(...)")

    def _repr_html_(self) -> str | None:
        """Show parts and parameters in a notebook; None for a part of a built model, which shows text."""
        return None if self._is_bound else component_html(type(self), self._values)

    def connections(self) -> Iterator[Any]:
        """Yield connect(), chain(), branch(), root() and potential_root() statements."""
        yield from ()

    def equations(self) -> Iterator[Any]:
        """Yield the equations of the component, one or more for each `==`."""
        yield from ()

    def initial_equations(self) -> Iterator[Any]:
        """Yield equations that hold at the start only."""
        yield from ()

    def declared_derivatives(self) -> Iterator[tuple[Any, Any]]:
        """Yield pairs (variable, expression of its time derivative), used instead of differentiation.

        An equation `variable == ...` then defines the variable, and is never differentiated.
        """
        yield from ()

    def check(self) -> None:
        """Raise DeclarationError where the structural parameters contradict each other."""

    def requirements(self) -> Iterator[Any]:
        """Yield require(...): conditions on parameters, and on variables at the start, that must hold."""
        yield from ()

    def validity(self) -> Iterator[Any]:
        """Yield expect(...) for neglected quantities, and apart(...) for points that must not coincide in a run."""
        yield from ()

    def stored_energy(self) -> Any:
        """Return the stored energy in J: kinetic, elastic and potential."""
        return 0

    def dissipated_power(self) -> Any:
        """Return the dissipated power in W, 0 or positive."""
        return 0

    def supplied_power(self) -> Any:
        """Return the power in W that the component supplies to the model from outside."""
        return 0

    def shapes(self) -> Iterator[Any]:
        """Yield shapes of `acausal.geometry`, and parts, whose own shapes are drawn; by default all parts."""
        for name in [name for name, declared in self.fields.items() if isinstance(declared, f.Part)]:
            inside = getattr(self, name)
            for part in inside if isinstance(inside, list) else [inside]:
                if part is not None and not isinstance(part, Connector):
                    yield part


def _constructed_at(component: Component) -> str:
    """Return file and line of the outermost call of a constructor, outside constructors of derived classes."""
    frame: Any = sys._getframe(1)
    while frame.f_back is not None and (
        frame.f_code.co_filename.startswith(PACKAGE)
        or (frame.f_code.co_name == "__init__" and any(v is component for v in frame.f_locals.values()))
    ):
        frame = frame.f_back
    return f"{frame.f_code.co_filename}:{frame.f_lineno}"


class Connector(Component):
    """A kind of port: potential variables that become equal, flow variables that sum to zero.

    A connector whose potentials are an over-determined record overrides declared_derivatives(), residual(), power() and
    root_equations().
    """

    _is_port = True
    _is_root = False
    _owner: Any = None
    _parents: tuple[Any, ...] = ()
    _set: tuple[Any, ...] = ()  # connected connectors, itself included

    def residual(self, other: Any) -> Iterator[tuple[Any, Any]]:
        """Yield pairs (independent equations for the equality with another record, flows that work on them).

        Loops are closed by these equations; the flow of a redundant one is undetermined.
        """
        yield from ()

    def power(self) -> Iterator[tuple[Any, Any]]:
        """Yield pairs (potential, flow) whose products are the power through the connector.

        They determine the flow that works on a constraint of a part, which is undetermined if the constraint is
        redundant.
        """
        yield from ()

    def loop_kind(self, undetermined: tuple[str, ...]) -> str:
        """Return the kind of a loop, from the flows that its redundant equations leave undetermined, for reports."""
        return "loop"

    def root_equations(self) -> Iterator[Any]:
        """Yield the equations of a chosen potential root.

        Variables with a declared derivative that are not defined by them are integrated.
        """
        yield from ()


class Record(Component):
    """A group of variables without physics of its own."""


class Model(Component):
    """A component that can be compiled and simulated; its outputs are the columns of its table of results.

    Attributes `stop_time`, `tolerance`, `accuracy`, `intervals`, `initial`, `method`, `constraints` and `max_order` are
    defaults of the arguments of `simulate`; they may depend on parameters: `stop_time = 2 * end`.
    """

    _settings = SETTINGS
