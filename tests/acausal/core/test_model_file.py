"""Models as files: replayed in C bit by bit, refused where they are damaged or say what cannot be."""

from __future__ import annotations

import ctypes
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import casadi as ca
import numpy as np
import pytest

from acausal.core import End, StoredModel, sundials, why_no_idas
from acausal.core.build.compiling import CORE, own_compiler
from acausal.core.library import loaded
from acausal.core.model_file import VERSION, framed
from acausal.core.tape import KINDS
from acausal.instructions import FIND, LOAD, PUT, VALUE
from models import SCENES
from tests.acausal.core.stored import SANITIZED, SPANS, driver, integrated, replayed, sanitizes, scene, written

READ, FOREIGN, OTHER_VERSION, LENGTH, CHECKSUM, CONTENT = range(6)
# Numbers of a file stay what they are: new operations come at the end.
OPERATIONS = (
    "ADD SUB MUL DIV NEG SQ TWICE INV SQRT SIN COS TAN ASIN ACOS ATAN ATAN2 EXP LOG POW SINH COSH TANH ASINH ACOSH ATANH FABS "
    "SIGN FLOOR CEIL FMOD REMAINDER COPYSIGN FMIN FMAX HYPOT LOG1P EXPM1 ERF LT LE EQ NE NOT AND OR IF ASSIGN FIND LOAD "
    "PUT VALUE"
)
SANITIZER = "the C compiler has no sanitisers"


@pytest.fixture(scope="session")
def made(tmp_path_factory):
    """Compile a driver once."""
    folder, known = tmp_path_factory.mktemp("drivers"), {}

    def make(source: str, sanitized: bool = False) -> Path:
        if not own_compiler():
            pytest.skip("there is no C compiler")
        if (source, sanitized) not in known:
            path = folder / f"{Path(source).stem}{'-sanitized' * sanitized}"
            if sanitized and not sanitizes(own_compiler(), folder):
                pytest.skip(SANITIZER)
            known[source, sanitized] = driver(source, path, own_compiler(), *(SANITIZED if sanitized else ()))
        return known[source, sanitized]

    return make


def why(content: bytes) -> int:
    """How the library answers to a file."""
    core, found = ctypes.CDLL(loaded()._name), ctypes.c_int32(-1)
    core.ac_model_read.restype = ctypes.c_void_p
    core.ac_model_read.argtypes = ctypes.c_char_p, ctypes.c_size_t, ctypes.POINTER(ctypes.c_int32)
    core.ac_model_free.argtypes = (ctypes.c_void_p,)
    model = core.ac_model_read(content, len(content), ctypes.byref(found))
    assert bool(model) == (found.value == READ)
    core.ac_model_free(model)
    return found.value


def same(path: Path, name: str, command: list[str], span: float, library: str = "") -> None:
    own = integrated(scene(name), span, 20, 1e-6, "ida" if library else "rodas")
    found = replayed(command, path, span, 20, 1e-6, library)
    assert (found.names, found.end, found.counts, found.time) == (own.names, own.end, own.counts, own.time)
    assert found.end == End.DONE
    assert found.rows.tobytes() == own.rows.tobytes()


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=pytest.mark.slow) if n == "free-vibration" else n for n in SCENES]
)
def test_a_scene_from_its_file_is_the_same_bit_by_bit(name, made, tmp_path):
    same(written(name, tmp_path), name, [str(made("replay.c"))], SPANS[name] / 20)


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_a_scene_under_the_sanitisers_is_the_same_bit_by_bit(name, made, tmp_path):
    same(written(name, tmp_path), name, [str(made("replay.c", sanitized=True))], SPANS[name])


@pytest.mark.slow
@pytest.mark.parametrize("name", ["simple-pendulum", "four-bar", "bricard"])
def test_a_scene_reads_no_memory_that_is_not_its_own(name, made, tmp_path):
    if not shutil.which("valgrind"):
        pytest.skip("there is no valgrind")
    watched = ["valgrind", "--quiet", "--leak-check=full", "--error-exitcode=9", str(made("replay.c"))]
    same(written(name, tmp_path), name, watched, SPANS[name] / 10)


@pytest.mark.parametrize("name", ["simple-pendulum", "four-bar", "spin-up"])
def test_idas_under_the_sanitisers_is_the_same_bit_by_bit(name, made, tmp_path):
    if why_no_idas():
        pytest.skip(why_no_idas())
    command = [str(made("replay.c", sanitized=True))]
    same(written(name, tmp_path), name, command, SPANS[name] / 10, str(sundials.path()))


def damaged(made, file: Path, changes: int) -> None:
    """Damage a file in every way, and so many times at random: some is refused, some is not, and nothing else happens."""
    command = [str(made("damage.c", sanitized=True)), str(file), str(changes)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert 0 < int(done.stdout) < 0.9 * changes


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("simple-pendulum", 400),
        pytest.param("simple-pendulum", 500_000, marks=pytest.mark.slow),
        pytest.param("car-axis", 20_000, marks=pytest.mark.slow),
        pytest.param("governor", 20_000, marks=pytest.mark.slow),
        pytest.param("four-bar", 3_000, marks=pytest.mark.slow),
    ],
)
def test_damaged_files_are_refused_and_never_believed(name, changes, made, tmp_path):
    damaged(made, written(name, tmp_path), changes)


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("simple-pendulum", 5_000),
        pytest.param("simple-pendulum", 500_000, marks=pytest.mark.slow),
        pytest.param("ball", 200_000, marks=pytest.mark.slow),
        pytest.param("hybrid", 200_000, marks=pytest.mark.slow),
        pytest.param("car-axis", 5_000, marks=pytest.mark.slow),
    ],
)
def test_damaged_files_of_exported_models_are_refused_and_never_believed(name, changes, made, tmp_path):
    pytest.importorskip("fmpy")
    from tests.acausal.export.importing import unit

    damaged(made, unit(name, 3, tmp_path).resources / "model.bin", changes)


def test_what_is_no_whole_file_is_told():
    content = scene("simple-pendulum").content
    assert why(content) == READ
    assert why(b"") == why(b"PK\x03\x04" + content) == FOREIGN
    assert why(content[:-8]) == why(content[:9]) == why(content + bytes(8)) == LENGTH
    assert why(content[:100] + b"?" + content[101:]) == CHECKSUM
    assert why(framed(VERSION + 1, {})) == OTHER_VERSION
    assert why(framed(VERSION, {})) == why(framed(VERSION, {"guards": b""})) == CONTENT


def changed(array: np.ndarray, place: int, value: float) -> np.ndarray:
    array = array.copy()
    array[place] = value
    return array


def tape(model: StoredModel, **parts: object) -> StoredModel:
    return replace(model, equations=replace(model.equations, values=replace(model.equations.values, **parts)))


def pattern(model: StoredModel, **parts: object) -> StoredModel:
    return replace(model, equations=replace(model.equations, **parts))


def wrong(m: StoredModel) -> dict[str, StoredModel]:
    """Models that cannot be."""
    e, t = m.equations, m.equations.values
    results = t.size - len(t.first)
    return {
        "operation": tape(m, kinds=changed(t.kinds, 0, len(KINDS))),
        "negative operation": tape(m, kinds=changed(t.kinds, -1, -1)),
        "argument of its own": tape(m, first=changed(t.first, -1, t.size - 1)),
        "second argument beyond": tape(m, second=changed(t.second, 0, results)),
        "argument before the first": tape(m, second=changed(t.second, -1, -1)),
        "early and of a state": tape(m, early=1, first=changed(t.first, 0, len(t.constants))),
        "more early runs than runs": tape(m, early=len(t.kinds) + 1),
        "runs longer than the results": tape(m, lengths=changed(t.lengths, -1, t.lengths[-1] + 1)),
        "runs shorter than the results": tape(m, lengths=changed(t.lengths, -1, 0)),
        "negative length": tape(m, lengths=changed(t.lengths, 0, -1)),
        "output beyond": tape(m, outputs=(changed(t.output, 0, t.size),)),
        "an output less": tape(m, outputs=(t.output[1:],)),
        "other inputs": tape(m, sizes=(*t.sizes, 1)),
        "no slopes": pattern(m, slopes=t),
        "three powers": pattern(m, powers=t),
        "rows that descend": pattern(m, row=e.row[::-1].copy()),
        "row beyond": pattern(m, row=changed(e.row, -1, e.nx + e.nz)),
        "columns that do not begin": pattern(m, start=changed(e.start, 0, 1)),
        "columns that end before they begin": pattern(m, start=changed(e.start, 1, e.start[2] + 1)),
        "more entries than rows": pattern(m, start=changed(e.start, -1, 2**30)),
        "diagonal beside": pattern(m, diagonal=changed(e.diagonal, 0, e.diagonal[0] + 1)),
        "size 0": replace(m, size=changed(m.size, 0, 0.0)),
        "infinite size": replace(m, size=changed(m.size, 0, np.inf)),
        "neither rate nor not": replace(m, rate=changed(m.rate, 0, 2)),
        "start without value": replace(m, x=changed(m.x, 0, np.nan)),
        "time without value": replace(m, time=np.nan),
        "name too many": replace(m, names=(m.names[0], f"{m.names[1]}\0")),
    }


def test_what_cannot_be_is_refused():
    found = {what: why(model.content) for what, model in wrong(scene("simple-pendulum")).items()}
    assert found == dict.fromkeys(found, CONTENT)


def test_a_start_that_does_not_fit_is_not_written():
    with pytest.raises(ValueError, match="does not fit"):
        _ = replace(scene("simple-pendulum"), x=np.zeros(1)).content


def test_numbers_of_operations_stay():
    enum = re.search(r"enum \{([^}]*)AC_OPERATIONS", (CORE / "source/core.h").read_text())
    assert enum
    assert re.findall(r"AC_(\w+),", enum[1]) == OPERATIONS.split()
    names = {"IF": "IF_ELSE_ZERO"}
    own = {"FIND": FIND, "LOAD": LOAD, "PUT": PUT, "VALUE": VALUE}
    assert list(KINDS) == [own.get(name) or getattr(ca, f"OP_{names.get(name, name)}") for name in OPERATIONS.split()]
