"""The file of an exported model: what is in it, and that it is written whole or not at all."""

from __future__ import annotations

import os
import re
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree.ElementTree import fromstring

import pytest

from acausal.core.build.compiling import SOURCE, file_of, version
from acausal.errors import ExportError
from acausal.export import Variable, archive, check_fmu, platforms, source_names, write_fmu
from tests.acausal.export.made import EMPTY, SPRING, altered

ROOT = Path(__file__).parents[3]
MODEL = b"model" * 100
ALL = {
    2: ["aarch64-linux", "darwin64", "linux64", "win64"],
    3: ["aarch64-darwin", "aarch64-linux", "x86_64-darwin", "x86_64-linux", "x86_64-windows"],
}


@pytest.fixture
def built(monkeypatch, tmp_path):
    """A core that is built for every platform, on linux."""

    def made(name):
        path = tmp_path / "lib" / file_of(name).name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(name.encode() + b"\0" + version().encode())
        return path

    for module in (archive, platforms):
        monkeypatch.setattr(module, "file_of", made)
    monkeypatch.setattr(platforms, "own_platform", lambda: "linux-x86_64")


def read(path):
    with zipfile.ZipFile(path) as file:
        assert file.testzip() is None
        return {name: file.read(name) for name in file.namelist()}


@pytest.mark.parametrize(("fmi_version", "folder"), [(2, "linux64"), (3, "x86_64-linux")])
def test_what_is_inside(built, tmp_path, fmi_version, folder):
    write_fmu(tmp_path / "a.fmu", replace(SPRING, sources=source_names()), MODEL, fmi_version)
    files = read(tmp_path / "a.fmu")
    sources = [f"sources/{path.name}" for path in SOURCE.glob("*.[ch]")]
    build = ["sources/buildDescription.xml"] if fmi_version == 3 else []
    assert list(files) == sorted(
        [
            f"binaries/{folder}/Spring_mass.so",
            "documentation/index.html",
            "documentation/licenses/license.txt",
            "modelDescription.xml",
            "resources/model.bin",
            *sources,
            *build,
        ]
    )
    assert files["resources/model.bin"] == MODEL
    assert files["documentation/licenses/license.txt"].endswith((ROOT / "LICENSE").read_bytes())
    assert files[f"binaries/{folder}/Spring_mass.so"].startswith(b"linux-x86_64\0")
    assert all(files[name] == (SOURCE / name.partition("/")[2]).read_bytes() for name in sources)
    assert fromstring(files["modelDescription.xml"]).get("fmiVersion") == f"{fmi_version}.0"


def test_the_sources_say_how_they_are_compiled(built, tmp_path):
    write_fmu(tmp_path / "a.fmu", SPRING, MODEL)
    root = fromstring(read(tmp_path / "a.fmu")["sources/buildDescription.xml"])
    build = root.find("BuildConfiguration")
    assert build is not None
    assert build.get("modelIdentifier") == "Spring_mass"
    assert [file.get("name") for file in build.findall("SourceFileSet/SourceFile")] == ["lu.c", "tape.c"]


def test_without_sources(built, tmp_path):
    for fmi_version in (2, 3):
        write_fmu(tmp_path / "a.fmu", EMPTY, MODEL, fmi_version)
        files = read(tmp_path / "a.fmu")
        assert not [name for name in files if name.startswith("sources")]
        assert b"SourceFiles" not in files["modelDescription.xml"]


@pytest.mark.parametrize("fmi_version", [2, 3])
def test_all_platforms(built, tmp_path, fmi_version):
    write_fmu(tmp_path / "a.fmu", EMPTY, MODEL, fmi_version, ["all"])
    found = [name.split("/")[1:] for name in read(tmp_path / "a.fmu") if name.startswith("binaries")]
    assert [folder for folder, _ in found] == ALL[fmi_version]
    for folder, file in found:
        kind = "dylib" if "darwin" in folder else "dll" if "win" in folder else "so"
        assert file == f"Empty.{kind}"
    if fmi_version == 2:
        assert read(tmp_path / "a.fmu")["binaries/darwin64/Empty.dylib"].startswith(b"macos-x86_64\0")


def test_macos_alone_has_the_folder_of_fmi_2(built, tmp_path):
    write_fmu(tmp_path / "a.fmu", EMPTY, MODEL, 2, ["macos-arm64", "own"])
    files = read(tmp_path / "a.fmu")
    assert files["binaries/darwin64/Empty.dylib"].startswith(b"macos-arm64\0")
    assert files["binaries/linux64/Empty.so"].startswith(b"linux-x86_64\0")


def test_the_same_model_gives_the_same_file(built, tmp_path):
    for name in ("a.fmu", "b.FMU"):
        write_fmu(tmp_path / name, SPRING, MODEL, 3, ["linux-aarch64", "own", "linux-x86_64"])
    assert (tmp_path / "a.fmu").read_bytes() == (tmp_path / "b.FMU").read_bytes()


def test_the_page(built, tmp_path):
    hostile = Variable("<script>", 99, "local", "continuous", None, "", None)
    made = replace(SPRING, variables=(*SPRING.variables, hostile), description="a <b> & c")
    write_fmu(tmp_path / "a.fmu", made, MODEL)
    page = read(tmp_path / "a.fmu")["documentation/index.html"].decode()
    assert "<h1>Spring &amp; &lt;mass&gt;</h1>" in page
    assert "a &lt;b&gt; &amp; c" in page
    assert "<td>4: phase, position, level, half</td>" in page
    assert "<td>2: mass.m, spring.c[1,2]</td>" in page
    assert "x86_64-linux, others from the sources" in page


@pytest.mark.parametrize("name", ["none/a.fmu", "a.zip", "", "a.fmu/", "."])
def test_names_that_are_refused(built, tmp_path, name):
    with pytest.raises(ExportError, match="cannot write"):
        write_fmu(f"{tmp_path}/{name}", SPRING, MODEL)
    assert not [path for path in tmp_path.iterdir() if path.name != "lib"]


@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() == 0, reason="everything is writable for root")
def test_a_folder_that_cannot_be_written(built, tmp_path):
    locked = tmp_path / "locked"
    locked.mkdir(mode=0o500)
    with pytest.raises(ExportError, match="cannot write"):
        write_fmu(locked / "a.fmu", SPRING, MODEL)


def test_nothing_is_written_of_what_is_refused(built, tmp_path):
    path = tmp_path / "a.fmu"
    write_fmu(path, SPRING, MODEL)
    before = path.read_bytes()
    with pytest.raises(ExportError, match="starts at nan"):
        write_fmu(path, altered("mass.m", start=float("nan")), MODEL)
    assert path.read_bytes() == before
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.fmu", "lib"]


def test_a_write_that_is_cut_leaves_the_old_file(built, tmp_path, monkeypatch):
    path = tmp_path / "a.fmu"
    path.write_bytes(b"old")

    def cut(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(zipfile.ZipFile, "writestr", cut)
    with pytest.raises(ExportError, match=r"cannot write .*No space left on device"):
        write_fmu(path, SPRING, MODEL)
    assert path.read_bytes() == b"old"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.fmu", "lib"]


@pytest.mark.parametrize(
    ("fmi_version", "names", "why"),
    [
        (1, ["own"], "fmi_version must be 2 or 3, not 1"),
        ("3", ["own"], "fmi_version must be 2 or 3, not '3'"),
        (3, [], "platforms is empty"),
        (3, ["linux-x86"], "there is no platform `linux-x86`; did you mean `linux-x86_64`?"),
        (3, ["musl-x86_64"], "there is no platform `musl-x86_64`"),
        (2, "al", "there is no platform `al`; did you mean `all`? Platforms: own, all, linux-x86_64,"),
    ],
)
def test_platforms_and_versions_that_are_refused(built, tmp_path, fmi_version, names, why):
    with pytest.raises(ExportError, match=re.escape(why)):
        check_fmu(tmp_path / "a.fmu", fmi_version, names)


def test_a_platform_without_a_folder(built, tmp_path, monkeypatch):
    monkeypatch.setattr(platforms, "own_platform", lambda: "musl-x86_64")
    with pytest.raises(ExportError, match="FMI has no folder for musl-x86_64, this platform; name others"):
        check_fmu(tmp_path / "a.fmu", 3, ["own"])


def test_export_without_core(built, tmp_path, monkeypatch):
    monkeypatch.setattr(platforms, "why_not", lambda runs: "it was not built")
    with pytest.raises(ExportError, match="needs the core for this platform, which is missing: it was not built"):
        check_fmu(tmp_path / "a.fmu", 3, ["macos-arm64"])


def test_libraries_that_are_missing_or_old(tmp_path, monkeypatch):
    folder = tmp_path / "lib"
    folder.mkdir()
    monkeypatch.setattr(platforms, "file_of", folder.joinpath)
    monkeypatch.setattr(platforms, "own_platform", lambda: "linux-x86_64")
    with pytest.raises(ExportError, match=r"not installed for linux-x86_64: with a C compiler .* makes it"):
        check_fmu(tmp_path / "a.fmu", 3, ["own"])
    (folder / "linux-x86_64").write_bytes(b"\0" + version().encode())
    check_fmu(tmp_path / "a.fmu", 3, ["own"])
    (folder / "linux-x86_64").write_bytes(b"\0" + version()[::-1].encode())
    (folder / "macos-arm64").write_bytes(version().encode())
    asked = ["own", "macos-arm64", "windows-x86_64"]
    with pytest.raises(ExportError, match=r"for linux-x86_64, windows-x86_64: `python -m pip install ziglang`, then"):
        check_fmu(tmp_path / "a.fmu", 3, asked)


def test_fmpy_reads_the_whole_file(built, tmp_path):
    validation = pytest.importorskip("fmpy.validation")
    fmpy = pytest.importorskip("fmpy")
    for fmi_version in (2, 3):
        path = str(tmp_path / "a.fmu")
        write_fmu(path, replace(SPRING, sources=source_names()), MODEL, fmi_version, "all")
        assert validation.validate_fmu(path) == []
        assert {"c-code", "darwin64", "linux64", "win64"} <= set(fmpy.supported_platforms(path))
        build = fmpy.read_model_description(path).buildConfigurations[0]
        assert tuple(build.sourceFileSets[0].sourceFiles) == source_names()
