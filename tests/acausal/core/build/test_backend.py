"""What an installation compiles, asks for, and names its wheels."""

from __future__ import annotations

import importlib
import platform
import subprocess
import sys
import sysconfig
from types import SimpleNamespace

import pytest

from acausal.core.build import compiling

ALL = {"platforms": "all"}


@pytest.fixture
def made(monkeypatch):
    """The backend on a machine without compilers, and what it does there."""
    monkeypatch.syspath_prepend(compiling.CORE / "build")
    for name in ("backend", "compiling"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    backend = importlib.import_module("backend")
    found = SimpleNamespace(backend=backend, compiled=[], settings=[])
    monkeypatch.delenv("ACAUSAL_WITHOUT_CORE", raising=False)

    def refuse(folder):
        raise subprocess.CalledProcessError(1, "pip", stderr="no network")

    def wheel(directory, settings, metadata):
        found.settings.append(settings)
        return "wheel"

    for name, function in {
        "own_compiler": list,
        "ziglang": list,
        "_fetched": refuse,
        "compile_core": lambda name, compiler: found.compiled.append((name, compiler)),
    }.items():
        monkeypatch.setattr(backend, name, function)
    monkeypatch.setattr(backend.build_meta, "get_requires_for_build_wheel", lambda settings: ["own"])
    monkeypatch.setattr(backend.build_meta, "build_wheel", wheel)
    monkeypatch.setattr(backend.build_meta, "build_editable", wheel)
    yield found
    for name in ("backend", "compiling"):
        sys.modules.pop(name, None)


def test_the_compiler_of_the_machine_is_taken(made, monkeypatch):
    monkeypatch.setattr(made.backend, "own_compiler", lambda: ["cc"])
    assert made.backend.build_wheel("") == made.backend.build_editable("") == "wheel"
    assert made.compiled == [(compiling.own_platform(), ["cc"])] * 2


def test_where_the_compiler_refuses_the_next_one_is_taken(made, monkeypatch, capsys):
    def compile_core(name, compiler):
        if compiler == ["cc"]:
            raise subprocess.CalledProcessError(1, "cc", stderr="no headers")
        made.compiled.append(compiler)

    monkeypatch.setattr(made.backend, "own_compiler", lambda: ["cc"])
    monkeypatch.setattr(made.backend, "_fetched", lambda folder: ["zig", "cc"])
    monkeypatch.setattr(made.backend, "compile_core", compile_core)
    made.backend.build_wheel("")
    assert made.compiled == [["zig", "cc"]]
    assert "no headers" in capsys.readouterr().err


def test_without_any_compiler_there_is_still_a_wheel(made, capsys):
    assert made.backend.build_wheel("") == "wheel"
    assert not made.compiled
    said = capsys.readouterr().err
    assert "no network" in said
    assert "without its core" in said


def test_the_core_may_be_left_out(made, monkeypatch):
    monkeypatch.setattr(made.backend, "own_compiler", lambda: ["cc"])
    monkeypatch.setenv("ACAUSAL_WITHOUT_CORE", "1")
    assert made.backend.build_wheel("") == "wheel"
    assert not made.compiled


def test_a_requirement_that_may_be_missing_is_one_of_the_wheel_for_all_alone(made):
    assert made.backend.get_requires_for_build_wheel() == ["own"]
    assert made.backend.get_requires_for_build_wheel({"platforms": "own"}) == ["own"]
    assert made.backend.get_requires_for_build_wheel(ALL) == ["own", "ziglang"]


def test_only_the_wheel_with_all_libraries_is_one_for_any_platform(made, monkeypatch):
    monkeypatch.setattr(made.backend, "ziglang", lambda: ["zig", "cc"])
    made.backend.build_wheel("", ALL)
    assert [name for name, _ in made.compiled] == list(compiling.PLATFORMS)
    made.backend.build_wheel("", None)
    for_all, own = made.settings
    assert "--build-option" not in for_all
    assert own["--build-option"] == ["--plat-name", sysconfig.get_platform()]


def test_the_wheel_with_all_libraries_is_not_made_without_them(made, monkeypatch):
    def refuse(name, compiler):
        raise subprocess.CalledProcessError(1, "zig")

    monkeypatch.setattr(made.backend, "compile_core", refuse)
    with pytest.raises(subprocess.CalledProcessError):
        made.backend.build_wheel("", ALL)


@pytest.mark.parametrize(
    ("own", "machine", "tag"),
    [
        ("macosx-10.9-universal2", "arm64", "macosx_11_0_arm64"),
        ("macosx-10.9-universal2", "x86_64", "macosx-10.9-x86_64"),
        ("macosx-11.0-arm64", "arm64", "macosx-11.0-arm64"),
        ("linux-aarch64", "aarch64", "linux-aarch64"),
    ],
)
def test_own_tag(made, monkeypatch, own, machine, tag):
    monkeypatch.setattr(sysconfig, "get_platform", lambda: own)
    monkeypatch.setattr(platform, "machine", lambda: machine)
    assert made.backend.own_tag() == tag
