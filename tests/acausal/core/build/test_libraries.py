"""Libraries: names, functions, what they need, and what is said where one cannot be used."""

from __future__ import annotations

import platform
import re
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from acausal.core.build import compiling
from acausal.core.build.compiling import FLAGS, PLATFORMS, SOURCE, compile_core, own_compiler, own_platform, ziglang
from tests.acausal.core.stepper import FUNCTIONS as STEPPERS

LIBRARY = sys.modules["acausal.core.library"]
CC = pytest.mark.skipif(not own_compiler(), reason="there is no C compiler")


@pytest.mark.parametrize(
    ("system", "libc", "machine", "name"),
    [
        ("linux", "glibc", "x86_64", "linux-x86_64"),
        ("linux", "", "aarch64", "musl-aarch64"),
        ("win32", "", "AMD64", "windows-x86_64"),
        ("darwin", "", "arm64", "macos-arm64"),
        ("darwin", "", "x86_64", "macos-x86_64"),
        ("linux", "glibc", "riscv64", "linux-riscv64"),
        ("freebsd14", "", "amd64", "freebsd14-x86_64"),
    ],
)
def test_names_of_platforms(monkeypatch, system, libc, machine, name):
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "libc_ver", lambda: (libc, ""))
    monkeypatch.setattr(platform, "machine", lambda: machine)
    assert own_platform() == name
    assert (name in PLATFORMS) == (machine != "riscv64" and "freebsd" not in system)
    assert name in compiling.file_of(name).name


def declared() -> set[str]:
    """Functions that the headers show to others."""
    headers = "".join(path.read_text() for path in SOURCE.glob("*.h"))
    return set(re.findall(r"AC_PUBLIC[^;]*?\b(ac_\w+)\(", headers))


def test_every_function_of_the_headers_is_taken():
    # The rest is for programs in C, which read files of models, and for tests of parts.
    others = {"ac_model_read", "ac_model_free", "ac_shares", *STEPPERS}
    assert set(LIBRARY.FUNCTIONS) == declared() - others


@CC
def test_sources_have_no_warnings():
    # What one compiler warns of, as a function that is not declared, another one refuses.
    strict = [flag for flag in FLAGS if flag != "-shared"]
    sources = map(str, SOURCE.glob("*.c"))
    done = subprocess.run(
        [*own_compiler(), *strict, "-Werror", "-fsyntax-only", *sources], capture_output=True, text=True
    )
    assert not done.returncode, done.stderr


@pytest.fixture
def why(monkeypatch, tmp_path):
    """Why a file cannot be used as the library."""
    path = tmp_path / "libacausal.so"
    monkeypatch.setattr(LIBRARY, "file_of", lambda name: path)
    monkeypatch.delenv(LIBRARY.WITHOUT, raising=False)

    def why():
        LIBRARY._installed.cache_clear()
        found = LIBRARY._loaded.__wrapped__()
        return found if isinstance(found, str) else ""

    yield path, why
    LIBRARY._installed.cache_clear()


def test_no_library(why):
    assert why[1]() == f"it was not built for {own_platform()}; {LIBRARY.MEND}"


def test_switched_off(why, monkeypatch):
    monkeypatch.setenv(LIBRARY.WITHOUT, "1")
    assert LIBRARY.WITHOUT in why[1]()


def test_a_file_that_is_no_library(why):
    path, reason = why
    path.write_bytes(b"no library" * 100)
    assert "cannot be loaded" in reason()
    assert LIBRARY.MEND in reason()


@pytest.mark.slow
@CC
def test_a_library_of_other_sources(why, monkeypatch):
    path, reason = why
    monkeypatch.setattr(compiling, "file_of", lambda name: path)
    monkeypatch.setattr(compiling, "version", lambda: "0123456789abcdef")
    compile_core(own_platform(), own_compiler())
    assert "built from other sources" in reason()
    assert LIBRARY.MEND in reason()


@CC
def test_a_library_without_the_functions(why, tmp_path, monkeypatch):
    path, reason = why
    (tmp_path / "source").mkdir()
    (tmp_path / "source" / "empty.c").write_text("int ac_nothing(void);\nint ac_nothing(void) { return 0; }\n")
    monkeypatch.setattr(compiling, "file_of", lambda name: path)
    monkeypatch.setattr(compiling, "SOURCE", tmp_path / "source")
    compile_core(own_platform(), own_compiler())
    assert "cannot be loaded" in reason()
    assert "ac_" in reason()


def exported(path: Path) -> set[str]:
    """Functions that a library shows; names that it merely holds stand in those for macOS alone."""
    data = path.read_bytes()
    if path.suffix != ".dylib":
        return {name.decode() for name in re.findall(rb"(?<=\0)ac_\w+(?=\0)", data)}
    (commands,) = struct.unpack_from("<16xI", data)
    at, found = 32, set()
    for _ in range(commands):
        kind, size, symbols, count, names = struct.unpack_from("<5I", data, at)
        at += size
        for k in range(count if kind == 2 else 0):
            place, flags = struct.unpack_from("<IB", data, symbols + 16 * k)
            # Defined and external, and not private.
            if flags & 0x1F == 0x0F:
                start = names + place
                found.add(data[start : data.index(b"\0", start)].decode())
    return {name[1:] for name in found if name.startswith("_ac_")}


@pytest.mark.slow
@pytest.mark.skipif(not ziglang(), reason="the package ziglang is not installed")
@pytest.mark.parametrize("name", PLATFORMS)
def test_libraries_of_all_platforms(name, tmp_path, monkeypatch):
    files = []
    for folder in ("one", "other"):
        monkeypatch.setattr(compiling, "CORE", tmp_path / folder)
        (tmp_path / folder).mkdir()
        files.append(compile_core(name, ziglang()))
    assert exported(files[0]) == declared()
    data = files[0].read_bytes()
    assert all(int(minor) <= 17 for minor in re.findall(rb"GLIBC_2\.(\d+)", data))
    assert (b"GLIBC_" in data) == name.startswith("linux")
    assert data == files[1].read_bytes()
    assert len(data) < 300_000  # symbols for a debugger alone would be more
