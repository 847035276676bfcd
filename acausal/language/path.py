"""Paths of members of a model that is not built."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal.language import fields as f
from acausal.language.call_arguments import declaration_error
from acausal.language.invalid_settings import refuse_path


class Path:
    """Path of a member of a model that is not built, `model.beam.frame_b.r_0`; a key of results."""

    __iter__: ClassVar[None] = None  # otherwise Python would iterate over [0], [1], ... without end
    _path: str
    _make: Any
    _class: type

    def __init__(self, path: str, member: Any) -> None:
        make = member.make if isinstance(member, f.Part) else member
        vars(self).update(_path=path, _make=make, _class=make if isinstance(make, type) else type(make))

    def __getattr__(self, name: str) -> Path:
        if name.startswith("__"):
            raise AttributeError(f"`{self._path}` has no {name}")
        return Path(f"{self._path}.{name}", getattr(self._class, name, None))

    def __setattr__(self, name: str, value: Any) -> None:
        raise declaration_error(refuse_path(f"{self._path}.{name}", self._class, name, value))

    def __getitem__(self, index: Any) -> Path:
        known = isinstance(self._make, list) and isinstance(index, int) and -len(self._make) <= index < len(self._make)
        return Path(f"{self._path}[{index}]", self._make[index] if known else None)

    def __setitem__(self, index: Any, value: Any) -> None:
        whole = (
            "its list" if not isinstance(self._make, f.Field) or isinstance(self._make, f.Part) else "the whole array"
        )
        raise declaration_error(
            f"`{self._path}[{index}]` cannot be set on a model: give {whole} where the part is created, "
            f"`{self._name}=...`."
        )

    @property
    def _name(self) -> str:
        return self._path.rpartition(".")[2]

    def __str__(self) -> str:
        return self._path

    def __repr__(self) -> str:
        return f"{self._path} ({self._class.__name__})" if self._make is not None else self._path

    def __dir__(self) -> list[str]:
        return list(getattr(self._class, "fields", ()))
