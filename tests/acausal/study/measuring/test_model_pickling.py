"""Models of a user's own files, sent to a process that cannot import them."""

import subprocess
import sys
from pathlib import Path

import numpy as np

from acausal.cli.scenes import find_scene
from acausal.study import pack

NEIGHBOUR = """
from acausal import Component, Scalar, input, structural, variable, der

class Integrator(Component):
    u: Scalar = input("rate")
    axis = structural("needed, without a default", shape=(3,))
    s: Scalar = variable("integral", start=0.0, fixed=True)

    def equations(self):
        yield der(self.s) == self.axis[2] * self.u
"""
MINE = """
from acausal import Model, Scalar, cos, output, parameter, piecewise, time
from neighbour_that_is_sent import Integrator

def doubled(x):
    return 2 * x

class Mine(Model):
    gain: Scalar = parameter("gain", default=3)
    part = Integrator(u=piecewise((gain * cos(time), time < 1), 0), axis=(0, 0, 1))
    x: Scalar = output("result")

    def equations(self):
        yield self.x == doubled(self.part.s)
"""
RECEIVER = """
import sys
import acausal as ac
from acausal.study.measuring.model_pickling import unpack
model = unpack(sys.stdin.buffer.read())
print(ac.simulate(model, stop_time=2, tolerance=1e-9)["x"][-1])
"""


def test_a_model_arrives(tmp_path):
    (tmp_path / "neighbour_that_is_sent.py").write_text(NEIGHBOUR)
    (tmp_path / "mine.py").write_text(MINE)
    data = pack(find_scene(f"{tmp_path}/mine.py:Mine")())
    command = [sys.executable, "-c", RECEIVER]
    done = subprocess.run(command, input=data, capture_output=True, cwd=Path(__file__).parents[4], check=False)
    assert done.stderr == b""
    assert abs(float(done.stdout) - 6 * np.sin(1)) < 1e-6
