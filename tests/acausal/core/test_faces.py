"""Functions of FMI 2.0 and 3.0: signatures as in the standard's headers, files found or refused, messages, calls out of order."""

from __future__ import annotations

import re
import subprocess
from ctypes import CDLL, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p
from importlib.util import find_spec
from pathlib import Path

import pytest

from acausal.core.build.compiling import CORE, FLAGS, own_compiler
from tests.acausal.core.faces import (
    DISCARD,
    ERROR,
    EXCHANGE,
    LOSE,
    OK,
    RATE,
    RETRY,
    SIMULATION,
    TOKEN,
    TROUBLE,
    Toy2,
    Toy3,
    caller,
    doubles,
    references,
    resources,
)
from tests.acausal.core.stored import SANITIZED, sanitizes

TYPES = (CORE / "source/fmi_types.h").read_text()


def headers() -> Path:
    """Where the standard's headers stand."""
    found = find_spec("fmpy")
    if not found or not found.origin:
        pytest.skip("fmpy, which has the standard's headers, is not installed")
    return Path(found.origin).with_name("c-code")


def compare(tmp_path: Path, text: str) -> None:
    """Compile a text next to the standard's headers."""
    path, flags = tmp_path / "compare.c", [flag for flag in FLAGS if flag not in ("-shared", "-std=c99", "-pedantic")]
    path.write_text('#include "fmi2Functions.h"\n#include "fmi3Functions.h"\n' + text)
    command = [*own_compiler(), *flags, "-std=c11", f"-I{CORE / 'source'}", f"-I{headers()}", "-Werror", "-c"]
    done = subprocess.run([*command, str(path), "-o", str(tmp_path / "compare.o")], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_functions_are_those_of_the_standard(tmp_path):
    # Declared twice, by the standard and by us, with the standard's types: the compiler refuses what differs.
    compare(tmp_path, '#define ACAUSAL_FMI_TYPES_H\n#include "fmi.h"\n')


def test_types_are_those_of_the_standard(tmp_path):
    enumerated = re.findall(r"typedef enum \{([^}]*)\} (\w+);", TYPES)
    rest = re.sub(r"typedef enum \{[^}]*\} \w+;", "", TYPES)
    structures = re.findall(r"typedef struct \{([^}]*)\} (\w+);", rest)
    others = re.findall(r"typedef [^;{]*?(?:\(\*(\w+)\)\([^;]*\)|(\w+));", rest)
    names = [one or other for one, other in others]
    assert len(enumerated) == 6
    assert len(structures) == 2
    assert len(names) == 39
    renamed = re.sub(rf"\b({'|'.join([*names, *(name for _, name in structures)])})\b", r"own_\1", rest)
    checks = [f"_Generic((own_{name} *)0, {name} *: 1, default: 0)" for name in names]
    for members, name in structures:
        checks.append(f"sizeof(own_{name}) == sizeof({name})")
        for member in re.findall(r"(\w+);", members):
            checks.append(f"offsetof(own_{name}, {member}) == offsetof({name}, {member})")
            checks.append(
                f"_Generic(&((own_{name} *)0)->{member}, __typeof__(&(({name} *)0)->{member}): 1, default: 0)"
            )
    for values, _ in enumerated:
        checks += [f"{value} == {k}" for k, value in enumerate(re.findall(r"\w+", values))]
    compare(tmp_path, renamed + "".join(f'_Static_assert({check}, "");\n' for check in checks))


def test_every_function_of_the_standard_is_exported(toy):
    found = [
        name for v in (2, 3) for name in re.findall(r"\b(fmi\d\w+);", (headers() / f"fmi{v}Functions.h").read_text())
    ]
    assert len(found) == 119
    library = CDLL(str(toy))
    assert not [name for name in found if not hasattr(library, name)]


def test_every_declared_function_is_exported(toy):
    own = subprocess.run([*own_compiler(), "-E", str(CORE / "source/fmi.h")], capture_output=True, text=True).stdout
    found = re.findall(r"\b(fmi\d[A-Z]\w+)\(", own)
    assert len(found) == 119
    library = CDLL(str(toy))
    assert not [name for name in found if not hasattr(library, name)]


def test_the_model_is_found_by_uri(toy, tmp_path):
    place = tmp_path / "with space, 100% ü#"
    place.mkdir()
    resources(place)
    plain, uri = str(place), place.as_uri()
    path = uri.removeprefix("file://")
    for location in (
        uri,
        uri + "/",
        "file:" + path,
        "FILE://LocalHost" + path,
        plain,
        plain + "/",
        uri.replace("%C3", "%c3"),
    ):
        found = Toy2(toy, location, EXCHANGE)
        assert found.handle, (location, found.log)
        found.free()


@pytest.mark.parametrize(
    "location",
    ["", "file:", "file://", "file://elsewhere/model", "http://here/model", "file:///%", "file:///a%2", "file:///%00"],
)
def test_what_names_no_folder_is_told(toy, location):
    found = Toy2(toy, location, EXCHANGE)
    assert not found.handle
    assert found.log == [
        (ERROR, "logStatusError", f"fmi2Instantiate: '{location}' names no folder of this machine".replace("%", "%%"))
    ]


def test_the_model_is_found_by_path(toy, tmp_path):
    place = resources(tmp_path)
    for location in (str(place), f"{place}/"):
        found = Toy3(toy, location, SIMULATION)
        assert found.handle, found.log
        found.free()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "cannot be read"),
        (b"", "is not used: it is no toy"),
        (b"PK\3\4", "is not used: it is no toy"),
        (b"toy " + bytes(100_000), "is not used: it was cut"),
        (b"toy {other}", "is of model {other}, not of {toy}"),
    ],
)
def test_files_that_are_not_the_model_are_told(toy, tmp_path, content, message):
    if content is None:
        (tmp_path / "model.bin").mkdir()  # opens like a file, and cannot be read
    else:
        resources(tmp_path, content)
    for one in (
        Toy2(toy, str(tmp_path), EXCHANGE),
        Toy3(toy, str(tmp_path), EXCHANGE),
        Toy3(toy, str(tmp_path), SIMULATION),
    ):
        assert not one.handle
        assert len(one.log) == 1
        assert one.told().endswith(f"{tmp_path}/model.bin {message}")


def test_there_is_no_scheduled_execution(toy, folder):
    one = Toy3(toy, folder, SIMULATION)
    make = one.library.fmi3InstantiateScheduledExecution
    make.restype = c_void_p
    given = b"one", b"{toy}", folder.encode(), c_bool(False), c_bool(False), None, one.logger, None, None, None
    assert make(*given) is None
    assert "Scheduled Execution" in one.told()
    one.free()


def test_what_no_model_has_is_refused_unless_none_is_asked_for(toy, folder):
    none, some = c_size_t(0), c_size_t(1)
    types = ("Float32", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Boolean", "String")
    two, three = Toy2(toy, folder, EXCHANGE), Toy3(toy, folder, EXCHANGE)
    calls = [(two, f"{way}{name}", (None,)) for way in ("Get", "Set") for name in ("Integer", "Boolean", "String")]
    calls += [(three, f"{way}{name}", (None, none)) for way in ("Get", "Set") for name in types]
    calls += [(three, f"{way}Binary", (None, None, none)) for way in ("Get", "Set")]
    calls += [(three, f"{way}{name}", (None,)) for way in ("Get", "Set") for name in ("Clock", "ShiftDecimal")]
    calls += [(three, name, (None, None)) for name in ("GetShiftFraction", "SetShiftFraction", "GetIntervalDecimal")]
    calls += [(three, "GetIntervalFraction", (None, None, None)), (three, "GetOutputDerivatives", (None, None, none))]
    calls += [(two, "GetRealOutputDerivatives", (None, None))]
    for one, name, rest in calls:
        said = len(one.log)
        assert one.call(name, None, none, *rest) == OK
        assert one.call(name, None, some, *rest) == ERROR, name
        assert len(one.log) == said + 1
        assert one.told().startswith(f"fmi{one.version}{name}: the model has no ")
    assert two.call("CancelStep") == three.call("ActivateModelPartition", c_uint32(0), c_double(0)) == ERROR
    assert three.call("GetNumberOfVariableDependencies", c_uint32(0), None) == ERROR
    two.free()
    three.free()


def test_an_instance_that_is_none_is_an_error(toy, folder):
    two, three = Toy2(toy, folder, EXCHANGE), Toy3(toy, folder, EXCHANGE)
    for one in (two, three):
        one.free()
        for name in ("EnterInitializationMode", "ExitInitializationMode", "Reset", "Terminate", "EnterEventMode"):
            assert one.call(name, *[0] * 8) == ERROR
        assert one.call("GetContinuousStates", doubles(0), c_size_t(1)) == one.call("SetTime", c_double(0)) == ERROR
        one.free()
    assert not two.log
    assert not three.log


def test_versions_are_told(toy):
    library = CDLL(str(toy))
    for name, text in (("fmi2GetVersion", b"2.0"), ("fmi2GetTypesPlatform", b"default"), ("fmi3GetVersion", b"3.0")):
        function = getattr(library, name)
        function.restype = c_char_p
        assert function() == text


def test_messages_are_no_formats_and_have_their_categories(toy, folder):
    one = Toy2(toy, folder, EXCHANGE)
    one.start()
    one.right("EnterContinuousTimeMode")
    assert one.set(TROUBLE, RETRY) == OK
    assert one.call("GetDerivatives", doubles(0), c_size_t(1)) == DISCARD
    assert one.log == [(DISCARD, "logStatusError", "fmi2GetDerivatives: there is no solution here, at 100%% of ##1##")]
    one.free()


def test_categories_of_the_log_are_switched(toy, folder):
    for one, true, false in (
        (Toy2(toy, folder, SIMULATION), c_int(1), c_int(0)),
        (Toy3(toy, folder, SIMULATION, True, True), c_bool(True), c_bool(False)),
    ):
        names = (c_char_p * 1)(b"logStatusError")
        assert one.call("SetTime", c_double(0)) == ERROR
        assert len(one.log) == 1
        one.right("SetDebugLogging", false, c_size_t(1), names)
        assert one.call("SetTime", c_double(0)) == ERROR
        assert len(one.log) == 1
        one.right("SetDebugLogging", true, c_size_t(0), None)
        one.start()
        if one.version == 3:
            one.happened()
        assert one.log[1:] == [(OK, "logEvents", "event at 0")]
        assert one.call("SetDebugLogging", true, c_size_t(1), (c_char_p * 1)(b"logAll")) == ERROR
        assert one.told().endswith("there is no category logAll")
        one.right("SetDebugLogging", false, c_size_t(0), None)
        assert one.call("SetTime", c_double(0)) == ERROR
        assert len(one.log) == 3
        one.free()


def test_times_that_cannot_be_are_refused(toy, folder):
    two, three = Toy2(toy, folder, SIMULATION), Toy3(toy, folder, SIMULATION)
    assert two.call("EnterInitializationMode") == ERROR
    assert two.told() == "fmi2EnterInitializationMode: the start time has to be stated before"
    for times, message in (
        ({"start": float("nan")}, "the start time is not a number"),
        ({"start": 2.0, "stop": 1.0}, "the stop time 1 is before the start time 2"),
        ({"tolerance": -1.0}, "the tolerance -1 is not positive"),
        ({"tolerance": float("nan")}, "the tolerance nan is not positive"),
    ):
        assert two.times(**times) == three.enter(**times) == ERROR
        assert two.told().split(": ")[1] == three.told().split(": ")[1] == message
    two.free()
    three.free()


def test_an_instance_that_is_lost_can_be_reset(toy, folder):
    for one in (Toy2(toy, folder, EXCHANGE), Toy3(toy, folder, EXCHANGE)):
        one.start()
        one.right("EnterContinuousTimeMode")
        assert one.set(TROUBLE, LOSE) == OK
        name = "GetDerivatives" if one.version == 2 else "GetContinuousStateDerivatives"
        assert one.call(name, doubles(0), c_size_t(1)) == ERROR
        assert one.call(name, doubles(0), c_size_t(1)) == ERROR
        assert one.told().endswith("in the state after an error from which it cannot go on")
        assert one.call("Terminate") == ERROR
        assert one.get(RATE) == (1.0,)
        one.right("Reset")
        one.start()
        one.free()


def test_counts_are_compared(toy, folder):
    one = Toy3(toy, folder, EXCHANGE)
    assert one.call("GetFloat64", references(1, 2), c_size_t(2), doubles(0), c_size_t(1)) == ERROR
    one.start()
    assert one.call("GetContinuousStates", doubles(0, 0), c_size_t(2)) == ERROR
    assert one.told() == "fmi3GetContinuousStates: 2 values, where there are 1"
    one.free()


@pytest.mark.slow
def test_calls_in_any_order(toy, folder, tmp_path):
    if not sanitizes(own_compiler(), tmp_path):
        pytest.skip("the C compiler has no sanitisers")
    calls = 2_000_000
    command = [str(caller(tmp_path, own_compiler(), *SANITIZED)), folder, TOKEN.decode(), str(calls)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    two, three = map(int, done.stdout.split())
    assert 0.1 * calls < two + three < 0.9 * calls
