"""Instantiation of templates: a tree of bound components with values, parameters, parts and ports."""

from __future__ import annotations

import traceback
from collections.abc import Collection, Iterator, Mapping
from itertools import islice
from typing import Any

from acausal.errors import PACKAGE, AcausalError, DeclarationError
from acausal.flatten.component_tree import join, members, walk
from acausal.flatten.field_values import DeferredInput, FieldValues, owner_text, takes_variables
from acausal.flatten.origin import MOST, Origin, refuse_endless, with_place
from acausal.flatten.port_family import enter_family, invalid_part
from acausal.language import fields as f
from acausal.language.body import refuse_late_fields
from acausal.language.component import Component, Connector
from acausal.language.pending import PENDING
from acausal.language.source_code import refuse_ineffective_code, returns_nothing
from acausal.language.value_checks import refuse_constructor, shown
from acausal.nearest import suggestions

DEEPEST = 100  # nesting depth of parts: deeper means that a component contains itself


class Instantiation:
    """Tree of bound components of a model.

    Parameters
    ----------
    template : Component
        Model from the user.
    overrides : mapping of str to value
        Values by path, instead of those in the model.
    free : collection of str
        Parameters that keep a symbol even if they are 0.
    """

    def __init__(
        self, template: Component, overrides: Mapping[str, Any] | None = None, free: Collection[str] = ()
    ) -> None:
        self._field_values = FieldValues(overrides, free)
        self.parameters = self._field_values.parameters
        self.components: list[Component] = []
        self._classes: set[type] = set()
        self._outers: dict[type, list[Component]] = {}
        self.root = self._build(template, "", None)
        for component in self.components:
            self._resolve_outers(component)
        if self._field_values.overrides:
            name = next(iter(self._field_values.overrides))
            raise DeclarationError(not_settable(name, self.root, self.settable()))
        for name in sorted(set(free) - self._field_values.kept):
            if follows := self.parameters.bound.get(name):
                raise DeclarationError(f"`{name}` follows {follows} and cannot be free; free that instead.")
            raise DeclarationError(not_settable(name, self.root, self.settable()))

    def settable(self) -> list[str]:
        """Return the paths of all structural parameters and parameters."""
        return [
            join(component._path, name)
            for component in self.components
            for name, declared in component.fields.items()
            if isinstance(declared, f.Structural | f.Parameter)
        ]

    def give_inputs(self, connected: list[DeferredInput]) -> None:
        """Set the inputs of parts; the variables that their values may contain must exist."""
        for bound, name, value, origin in (*self._field_values.deferred, *connected):
            vars(bound)["_values"][name] = with_place(value, origin)
            PENDING.get().place(origin)

    @property
    def defaults(self) -> list[DeferredInput]:
        """Inputs of parts that may need their default: an equation of a containing component may state them instead."""
        return [entry for entry in self._field_values.defaults if entry[1] not in entry[0]._values]

    def _build(self, template: Component, path: str, owner: Component | None) -> Component:
        cls = type(template)
        here = Origin(path, cls.__name__, template._origin)
        if not template._origin:
            refuse_constructor(cls)
        if cls not in self._classes:
            refuse_ineffective_code(cls)
            refuse_late_fields(cls)
            self._classes.add(cls)
        if path.count(".") >= DEEPEST:
            self._refuse_nesting(here)
        bound = cls.__new__(cls)
        own = vars(bound)
        own.update(vars(template))  # attributes set by a constructor of the user
        own.update(_is_bound=True, _path=path, _origin=template._origin)
        own["_values"] = values = dict(template._values)
        for name, value in template._values.items():
            if owner is not None and takes_variables(cls.fields.get(name), value):
                self._field_values.deferred.append((bound, name, lambda v=value: f.evaluate(v, owner), here))
            else:
                values[name] = with_place(lambda v=value: f.evaluate(v, owner), here)
        self.components.append(bound)
        self._field_values.fill(bound, owner)
        with_place(lambda: _check(bound), here)
        for name, declared in cls.fields.items():
            if isinstance(declared, f.Family):
                self._family(bound, name, declared)
            elif isinstance(declared, f.Part):
                own[name] = self._part(bound, name, declared)
        bound._ports = tuple(member for member in members(bound) if isinstance(member, Connector))
        return bound

    def _refuse_nesting(self, here: Origin) -> None:
        """Raise DeclarationError for a part that is too deep, with the classes on its path."""
        kinds = {c._path: type(c).__name__ for c in self.components}
        names = here.path.split(".")
        way = [kinds.get(".".join(names[:k]), "") for k in range(len(names))]
        once = " in ".join(dict.fromkeys([here.kind, *reversed(way[1:])]))
        raise DeclarationError(
            f"{here.kind}, {here.where}: parts are nested more than {DEEPEST} deep ({once}, repeatedly; the last is "
            f"`{'.'.join(names[:3])}...`). A component that contains itself needs an end: "
            "`@part def inner(self): return None if self.n == 0 else ...`."
        )

    def _part(self, bound: Component, name: str, declared: f.Part) -> Any:
        path = join(bound._path, name)
        made: Any = bound._values.get(name, f.MISSING)
        if made is f.MISSING:
            made = self._made(bound, declared, Origin.of(bound, name))
        place = Origin(bound._path, type(bound).__name__, declared.where, name)
        if isinstance(made, list | tuple) and not declared.many:
            raise DeclarationError(
                f"{place}: a method marked @part or @port returns one; mark it @parts if it returns a list of parts."
            )
        if isinstance(made, list | tuple):
            return [self._member(bound, item, f"{path}[{k}]") for k, item in enumerate(made)]
        if declared.many:
            raise DeclarationError(
                f"{place}: @parts decorates a method that returns a list of parts, not {shown(made)}."
            )
        if made is None and declared.make is not None and not declared.is_port:
            _refuse_missing_return(declared, place)
        return None if made is None else self._member(bound, made, path)

    def _family(self, bound: Component, name: str, declared: f.Family) -> None:
        made = self._made(bound, declared, Origin.of(bound, name))
        for port, template in enter_family(bound, name, declared, made).items():
            vars(bound)[port] = self._member(bound, template, join(bound._path, port))

    def _made(self, bound: Component, declared: f.Part, place: Origin) -> Any:
        """Return the template, list of templates or None from the class."""
        make: Any = declared.make
        if make is None or isinstance(make, Component | list):
            return make

        def call() -> Any:
            made = make() if isinstance(make, type) else make(bound)
            if isinstance(make, type):
                made.__dict__["_origin"] = declared.where
            return list(islice(made, MOST)) if isinstance(made, Iterator) else made

        made = with_place(call, place)
        if isinstance(made, list):
            refuse_endless(len(made), place, "the list of parts")
        return made

    def _member(self, bound: Component, template: Component, path: str) -> Component:
        if not isinstance(template, Component) or template._is_bound:
            raise DeclarationError(
                f"{Origin.of(bound)}: `{path}` must be a part, such as Body(m=1), not {invalid_part(template)}."
            )
        built = self._build(template, path, bound)
        if isinstance(built, Connector):
            built._owner = bound
        return built

    def _resolve_outers(self, component: Component) -> None:
        for name, declared in component.fields.items():
            if not isinstance(declared, f.Outer):
                continue
            if declared.cls not in self._outers:
                self._outers[declared.cls] = [c for c in self.components if isinstance(c, declared.cls)]
            found = self._outers[declared.cls]
            cls = declared.cls.__name__
            if len(found) != 1:
                what = (
                    f"the model has no {cls}. Add one to it: {cls.lower()} = {cls}()"
                    if not found
                    else f"the model has {len(found)}: {', '.join(c._path for c in found)}. Keep one of them"
                )
                raise DeclarationError(f"{owner_text(component)} needs the one {cls} of the model, but {what}.")
            vars(component)[name] = found[0]


def _check(component: Component) -> None:
    """Check a component; errors raised by its own check() get the line of its construction."""
    try:
        component.check()
    except AcausalError as error:
        *_, last = traceback.extract_tb(error.__traceback__)
        error.line = error.line if last.filename.startswith(PACKAGE) else component._origin
        raise


def _refuse_missing_return(declared: f.Part, place: Origin) -> None:
    """Raise DeclarationError for a method marked @part without `return`; only an explicit None leaves the part out."""
    if returns_nothing(declared.make):
        raise DeclarationError(f"{place}: this method returns nothing; write `return` before the part.")


def unknown_name(name: str, known: list[str], kind: str = "") -> str:
    """Return the message for an unknown name, with similar ones."""
    return f"there is no `{name}` in the model{suggestions(name, known, kind)}"


def not_settable(name: str, root: Component, known: list[str]) -> str:
    """Return the message for a name that is not a parameter."""
    for component in walk(root):
        for own, declared in component.fields.items():
            if isinstance(declared, f.Variable) and name == join(component._path, own):
                make = f"{type(component).__name__}({own}=fixed(...))"
                return f"`{name}` is a variable, not a parameter; set its start value in the model: {make}."
    owner = name.rpartition(".")[0]
    kind = next((type(c).__name__ for c in walk(root) if c._path == owner), "") if owner else ""
    return unknown_name(name, known, kind)
