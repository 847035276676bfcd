"""Tables of ModelicaTest.Tables, as published.

`published_tables.json` holds for each model its table, about 21 instants away from points and events, and the values there of
the table and of its derivatives. Of three rows at one time the middle one is left out.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Table, der, output, piecewise, structural, table
from acausal import time as now

PUBLISHED = json.loads((Path(__file__).parent / "published_tables.json").read_text())


class Looked(Model):
    data: Table = structural("points", cls=Table)
    order: int = structural("highest derivative")
    start_time: float = structural("start of the signal", default=0.0)
    shift_time: float = structural("time 0 of the table", default=0.0)
    y = output("values", shape=lambda s: (max(1, s.data.width),))
    d = output("first derivatives", shape=lambda s: (max(1, s.data.width),))
    dd = output("second derivatives", shape=lambda s: (max(1, s.data.width),))

    def equations(self):
        value, n = table(now - self.shift_time, self.data), max(1, self.data.width)
        for k in range(n):
            own = value[k] if self.data.width else value
            yield self.y[k] == (piecewise((0, now < self.start_time), own) if self.start_time else own)
            yield self.d[k] == (der(self.y[k]) if self.order > 0 else 0)
            yield self.dd[k] == (der(self.d[k]) if self.order > 1 else 0)


@pytest.mark.parametrize("name", PUBLISHED)
def test_published_tables(name):
    given = PUBLISHED[name]
    points = np.array(given["points"])
    values = points[:, 1] if points.shape[1] == 2 else points[:, 1:]
    data = Table(points[:, 0], values, given["kind"], given["extrapolation"])
    start = given.get("start_time", 0.0)
    model = Looked(data=data, order=given["order"], start_time=start, shift_time=given.get("shift_time", start))
    times = np.array(given["time"])
    result = ac.simulate(model, start_time=given.get("from", 0.0), stop_time=given["stop_time"], intervals=10_000)
    for path, expected in given["values"].items():
        index = re.search(r"\[(\d+)\]", path)
        own = result["y" if path.startswith("t_new") else "d" if path.startswith("d_") else "dd"]
        found = np.interp(times, result.time, own[:, int(index[1]) - 1 if index else 0]) + given.get("offset", 0.0)
        size = max(np.max(np.abs(expected)), 1e-3)
        np.testing.assert_allclose(found, expected, atol=1e-3 * size, rtol=0)
