"""The faces of FMI with an engine to try them with, called as importers do."""

from __future__ import annotations

import ctypes
import subprocess
from ctypes import CFUNCTYPE, Structure, byref, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p
from pathlib import Path
from typing import Any

from acausal.core.build.compiling import CORE, FLAGS

HERE = Path(__file__).parent
SOURCES = [HERE / "toy_unit.c", *sorted((CORE / "source").glob("face*.c")), *sorted((CORE / "source").glob("fmi*.c"))]
TOKEN = b"{toy}"
OK, WARNING, DISCARD, ERROR, FATAL = range(5)
TIME, X, SLOPE, RATE, U, TROUBLE = range(6)
RETRY, LOSE, STOP, END = range(1, 5)  # troubles
EXCHANGE, SIMULATION = range(2)

LOGGER_2 = CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)
LOGGER_3 = CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)


class Callbacks(Structure):
    """What FMI 2.0 takes as functions of the importer."""

    _fields_ = (
        ("logger", LOGGER_2),
        *((name, c_void_p) for name in ("allocate", "release", "finished", "environment")),
    )


class EventInfo(Structure):
    """What FMI 2.0 tells of an event."""

    _fields_ = (*((name, c_int) for name in ("again", "ends", "nominals", "states", "planned")), ("next", c_double))


def compiled(folder: Path, compiler: list[str], *options: str) -> Path:
    """Compile the faces with the engine to try them with; a warning is an error."""
    path = folder / "toy.so"
    given = [*compiler, *FLAGS, "-Werror", *options, f"-I{CORE / 'source'}", *map(str, SOURCES)]
    subprocess.run([*given, "-fPIC", "-lm", "-o", str(path)], check=True, capture_output=True, text=True)
    return path


def caller(folder: Path, compiler: list[str], *options: str) -> Path:
    """Compile the driver that calls them in any order."""
    path, flags = folder / "calls", [flag for flag in FLAGS if flag not in ("-shared", "-fvisibility=hidden")]
    given = [
        *compiler,
        *flags,
        "-Werror",
        *options,
        f"-I{CORE / 'source'}",
        *map(str, [HERE / "face_calls.c", *SOURCES]),
    ]
    subprocess.run([*given, "-lm", "-o", str(path)], check=True, capture_output=True, text=True)
    return path


def resources(folder: Path, content: bytes = b"toy " + TOKEN) -> Path:
    """Write a model's file into a folder."""
    (folder / "model.bin").write_bytes(content)
    return folder


def doubles(*values: float) -> Any:
    return (c_double * len(values))(*values)


def references(*values: int) -> Any:
    return (c_uint32 * len(values))(*values)


class Toy:
    """An instance; `log` holds what it said: status, category, message."""

    def __init__(self, path: Path, version: int):
        self.library, self.version, self.log = ctypes.CDLL(str(path)), version, []
        self.handle: Any = None

    def call(self, name: str, *given: object) -> int:
        """Call a function of the version on the instance."""
        return getattr(self.library, f"fmi{self.version}{name}")(c_void_p(self.handle), *given)

    def right(self, name: str, *given: object) -> None:
        """Call a function that has to go well."""
        assert self.call(name, *given) == OK, (name, self.log)

    def told(self) -> str:
        """Return the last message."""
        return self.log[-1][2]

    def get(self, *reference: int) -> tuple[float, ...]:
        found, count = doubles(*[0.0] * len(reference)), c_size_t(len(reference))
        if self.version == 2:
            self.right("GetReal", references(*reference), count, found)
        else:
            self.right("GetFloat64", references(*reference), count, found, count)
        return tuple(found)

    def set(self, reference: int, value: float) -> int:
        if self.version == 2:
            return self.call("SetReal", references(reference), c_size_t(1), doubles(value))
        return self.call("SetFloat64", references(reference), c_size_t(1), doubles(value), c_size_t(1))

    def array(self, name: str, count: int = 1) -> float:
        """Call what fills an array."""
        found = doubles(*[0.0] * count)
        self.right(name, found, c_size_t(count))
        return found[0]

    def free(self) -> None:
        self.call("FreeInstance")
        self.handle = None


class Toy2(Toy):
    """An instance of FMI 2.0."""

    def __init__(self, path: Path, location: str, kind: int, token: bytes = TOKEN, logging: bool = False):
        super().__init__(path, 2)
        self.logger = LOGGER_2(lambda _, name, status, *texts: self.log.append((status, *map(bytes.decode, texts))))
        self.callbacks = Callbacks(self.logger)
        make = self.library.fmi2Instantiate
        make.restype = c_void_p
        self.handle = make(b"one", kind, token, location.encode(), byref(self.callbacks), 0, int(logging))

    def times(self, start: float = 0.0, stop: float | None = None, tolerance: float | None = None) -> int:
        has_stop, has_tolerance = int(stop is not None), int(tolerance is not None)
        given = has_tolerance, c_double(tolerance or 0), c_double(start), has_stop, c_double(stop or 0)
        return self.call("SetupExperiment", *given)

    def enter(self, **times: float) -> int:
        return self.times(**times) or self.call("EnterInitializationMode")

    def start(self, **times: float) -> None:
        assert self.enter(**times) == OK
        self.right("ExitInitializationMode")

    def step(self, start: float, size: float) -> int:
        return self.call("DoStep", c_double(start), c_double(size), 1)

    def happened(self) -> EventInfo:
        info = EventInfo()
        self.right("NewDiscreteStates", byref(info))
        return info


class Toy3(Toy):
    """An instance of FMI 3.0."""

    def __init__(self, path: Path, location: str, kind: int, *ways: bool, token: bytes = TOKEN, logging: bool = False):
        super().__init__(path, 3)
        self.logger = LOGGER_3(lambda _, status, *texts: self.log.append((status, *map(bytes.decode, texts))))
        events, early = ways or (False, False)
        given = b"one", token, location.encode(), c_bool(False), c_bool(logging)
        if kind == EXCHANGE:
            make, rest = self.library.fmi3InstantiateModelExchange, (None, self.logger)
        else:
            make = self.library.fmi3InstantiateCoSimulation
            rest = c_bool(events), c_bool(early), None, c_size_t(0), None, self.logger, None
        make.restype = c_void_p
        self.handle = make(*given, *rest)

    def enter(self, start: float = 0.0, stop: float | None = None, tolerance: float | None = None) -> int:
        has_stop, has_tolerance = c_bool(stop is not None), c_bool(tolerance is not None)
        given = has_tolerance, c_double(tolerance or 0), c_double(start), has_stop, c_double(stop or 0)
        return self.call("EnterInitializationMode", *given)

    def start(self, **times: float) -> None:
        assert self.enter(**times) == OK
        self.right("ExitInitializationMode")

    def step(self, start: float, size: float) -> tuple[int, tuple[bool, ...], float]:
        """Return status; event, end and whether it was early; where it ended."""
        found, reached = [c_bool() for _ in range(3)], c_double()
        status = self.call("DoStep", c_double(start), c_double(size), c_bool(True), *map(byref, found), byref(reached))
        return status, tuple(flag.value for flag in found), reached.value

    def happened(self) -> tuple[bool, ...]:
        """Return whether again, the end, nominals, states, next time known."""
        found, after = [c_bool() for _ in range(5)], c_double()
        self.right("UpdateDiscreteStates", *map(byref, found), byref(after))
        return tuple(flag.value for flag in found)
