"""Studies from scripts: beside the model's file, without a guard, with models of their own; and who can reach a cluster."""

from __future__ import annotations

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import acausal as ac
from acausal.study import pack
from acausal.study.measuring import workers
from acausal.study.measuring.pool import cluster, processes

ROOT = Path(__file__).parents[4]
CRANE = """
from acausal import Model, Scalar, der, fixed, output, parameter, variable
from beside_the_crane import doubled

class Crane(Model):
    k: Scalar = parameter("rate", default=1.0)
    y: Scalar = variable("y", start=1.0, fixed=True)
    x: Scalar = output("x")
    stop_time = 1.0

    def equations(self):
        yield der(self.y) == -self.k * self.y
        yield self.x == doubled(self.y)
"""
BESIDE = "def doubled(x):\n    return 2 * x\n"
OWN = """
class Mine(crane.Crane):
    def equations(self):
        yield from super().equations()

model = Mine(k=own(1.0))
"""
RUN = "print(len(ac.{what}(model, {options}).rows))\n"
HEAD = "import acausal as ac\nimport crane\n"
STUDY = {"what": "study", "options": "tolerances=(1e-3, 1e-4), workers=1, repeats=1"}
GUARD = 'if __name__ == "__main__":\n    '
SCRIPTS = {
    "beside the model": HEAD + "model = crane.Crane()\n" + GUARD + RUN.format(**STUDY),
    "without a guard": HEAD + "print('once')\nmodel = crane.Crane()\n" + RUN.format(**STUDY),
    "a model of its own": HEAD + "def own(x):\n    return x\n" + OWN + GUARD + RUN.format(**STUDY),
    "its own, without a guard": HEAD + "def own(x):\n    return x\n" + OWN + RUN.format(**STUDY),
}


def run(tmp_path, text, name="script.py", *, elsewhere=False):
    folder = tmp_path / "models" if elsewhere else tmp_path
    folder.mkdir(exist_ok=True)
    (folder / "crane.py").write_text(CRANE)
    (folder / "beside_the_crane.py").write_text(BESIDE)
    (tmp_path / name).write_text(text)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), str(folder)])}
    return subprocess.run(
        [sys.executable, tmp_path / name],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env=environment,
        check=False,
        timeout=120,
    )


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(text, id=name, marks=() if name == "its own, without a guard" else pytest.mark.slow)
        for name, text in SCRIPTS.items()
    ],
)
def test_scripts(tmp_path, text):
    done = run(tmp_path, text)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split()[-1] == "2"
    assert done.stdout.count("once") == ("print('once')" in text)


def test_a_script_from_standard_input(tmp_path):
    (tmp_path / "crane.py").write_text(CRANE)
    (tmp_path / "beside_the_crane.py").write_text(BESIDE)
    done = subprocess.run(
        [sys.executable],
        input=SCRIPTS["its own, without a guard"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), str(tmp_path)])},
        check=False,
        timeout=120,
    )
    assert done.stdout.split()[-1:] == ["2"], done.stderr


DATA = """
import numpy as np

class Rate:
    def __init__(self, value):
        self.value = value
    def __repr__(self):
        return f"Rate({self.value})"

class Own(crane.Crane):
    rate = ac.structural("rate", cls=Rate)
    def equations(self):
        yield ac.der(self.y) == -self.rate.value * self.y
        yield self.x == 2 * self.y

model = Own(rate=Rate(1.0))
"""


def test_data_of_classes_of_a_script(tmp_path):
    options = "tolerances=(1e-4,), workers=1, repeats=1, switches={'rate': [Rate(1.0), Rate(2.0)]}"
    done = run(tmp_path, HEAD + DATA + RUN.format(what="study", options=options))
    assert done.stdout.split()[-1:] == ["2"], done.stderr


@pytest.mark.slow
def test_a_script_in_another_folder(tmp_path):
    done = run(tmp_path, SCRIPTS["without a guard"], elsewhere=True)
    assert done.stdout.split() == ["once", "2"], done.stderr


@pytest.mark.slow
def test_dask_workers_do_not_run_the_script_again(tmp_path):
    pytest.importorskip("distributed")
    text = SCRIPTS["its own, without a guard"].replace("workers=1", "workers=1, executor='local'")
    done = run(tmp_path, "print('once')\n" + text)
    assert done.stdout.split() == ["once", "2"], done.stderr


def test_a_local_cluster_is_for_this_machine_alone():
    distributed = pytest.importorskip("distributed")
    with cluster("local", 1):
        client = distributed.get_client()
        scheduler = client.cluster.scheduler
        assert scheduler.address.startswith("tcp://127.0.0.1:")
        assert scheduler.http_server is not None
        sockets = list(scheduler.http_server._sockets.values())
        assert sockets
        assert {s.getsockname()[0] for s in sockets} == {"127.0.0.1"}
        assert all(name.startswith("tcp://127.0.0.1:") for name in scheduler.workers)


def test_models_are_packed_by_threads():
    from tests.acausal.study.decay import Decay

    with ThreadPoolExecutor(4) as pool:
        packed = list(pool.map(lambda _: pack(Decay()), range(40)))
    assert len(set(packed)) == 1


def test_the_script_is_as_it_was():
    main = sys.modules["__main__"]
    before = getattr(main, "__spec__", None)
    with processes(1) as pool:
        assert pool.submit(os.getpid).result() != os.getpid()
    with workers.without_main():
        assert main.__spec__.name == "__main__"
    assert getattr(main, "__spec__", None) is before


@pytest.mark.slow
def test_points_in_threads():
    from tests.acausal.study.decay import Decay

    options = {"stop_time": 1.0, "tolerances": (1e-3, 1e-4), "repeats": 1}
    with ThreadPoolExecutor(2) as pool:
        found = ac.study(Decay(), executor=pool, **options)
    serial = ac.study(Decay(), workers=1, **options)
    assert [row.error for row in found.rows] == [row.error for row in serial.rows]
