"""Where a document's shapes are, worked out from its numbers with matrices, independently of the page."""

from __future__ import annotations

import base64
import zlib
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from tests.acausal.animation.made import Array


def unpacked(text: str, kind: str = "<f4") -> np.ndarray:
    """Return numbers that stand in a document."""
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), dtype=kind)


class Frame:
    """The numbers of a run at one of its frames."""

    def __init__(self, run: dict[str, Any], index: int) -> None:
        frames, varying = run["frames"], run["varying"]
        data = unpacked(run["data"]).astype(float)
        self.run = run
        self.time = float(unpacked(run["time"], "<f8")[index])
        self.values = np.concatenate(
            [data[: varying * frames].reshape(varying, frames)[:, index], data[varying * frames :]]
        )
        self.all = [*data[: varying * frames].reshape(varying, frames), *data[varying * frames :, None]]
        for k, offset in run.get("offsets", {}).items():
            self.values[int(k)] += offset
            self.all[int(k)] = self.all[int(k)] + offset

    def at(self, pose: int, points: Any) -> Array:
        """Return local points of a pose in the world."""
        it = self.run["poses"][pose]
        w, x, y, z = self.values[it["q"]]
        turn = Rotation.from_quat([x, y, z, w]).as_matrix()
        return self.values[it["r"]] + np.reshape(points, (-1, 3)) @ turn.T

    def places(self, shape: dict[str, Any], longest: dict[str, float]) -> Array:
        """Return the points (n, 3) that the page tells of a shape; `longest` are the vectors' lengths in the document."""
        return np.reshape(getattr(self, f"_{shape['kind']}")(shape, longest), (-1, 3))

    def _ground(self, *_: Any) -> Array:
        return np.zeros((0, 3))

    def _box(self, s: dict[str, Any], _: Any) -> Array:
        half = np.array(s["axes"][0]) * s["size"][0] / 2
        return self.at(s["pose"], [np.array(s["center"]), s["center"] - half, s["center"] + half])

    def _cylinder(self, s: dict[str, Any], _: Any) -> Array:
        return self.at(s["pose"], [(np.array(s["from"]) + s["to"]) / 2, s["from"], s["to"]])

    def _sphere(self, s: dict[str, Any], _: Any) -> Array:
        return self.at(s["pose"], s["center"])

    def _axle(self, s: dict[str, Any], _: Any) -> Array:
        half = np.array(s["axis"]) / np.linalg.norm(s["axis"]) * s["length"] / 2
        return self.at(s["pose"], [np.array(s["center"]), s["center"] - half, s["center"] + half])

    def _span(self, s: dict[str, Any], _: Any) -> Array:
        return self.values[[s["a"], s["b"]]]

    def _trail(self, s: dict[str, Any], _: Any) -> Array:
        return self.values[s["at"]]

    def _arrow(self, s: dict[str, Any], longest: dict[str, float]) -> Array:
        at, vector = self.values[s["at"]], self.values[s["vector"]]
        return np.array([at, at + (vector * longest[s["quantity"]] if longest[s["quantity"]] else 0)])

    def _curve(self, s: dict[str, Any], _: Any) -> Array:
        return self.values[np.array(s["points"])]

    def _mesh(self, s: dict[str, Any], _: Any) -> Array:
        vertices = unpacked(s["vertices"]).reshape(-1, 3).astype(float)
        if s["modes"]:
            vertices = vertices + np.tensordot(
                self.values[s["q"]], unpacked(s["modes"]).reshape(-1, *vertices.shape), 1
            )
        return self.at(s["pose"], vertices[:8])

    def longest(self, quantity: str) -> float:
        """Return the length of the longest vector of a quantity over time."""
        lengths = [0.0]
        for s in self.run["shapes"]:
            if s["kind"] == "arrow" and s["quantity"] == quantity:
                columns = np.broadcast_arrays(*(self.all[k] for k in s["vector"]))
                lengths.append(float(np.linalg.norm(columns, axis=0).max()))
        return max(lengths)


def extent_of(document: dict[str, Any]) -> float:
    """Return the diagonal of the box that holds all runs (m)."""
    low = np.min([run["extent"]["low"] for run in document["runs"]], axis=0)
    high = np.max([run["extent"]["high"] for run in document["runs"]], axis=0)
    return float(np.linalg.norm(high - low)) or document["runs"][0]["size"]


def places(document: dict[str, Any], index: int, run: int = 0) -> tuple[float, list[Array]]:
    """Return the time of a frame and where all shapes of a run are then."""
    extent = extent_of(document)
    factors = {}
    for quantity in ("force", "torque"):
        longest = max(Frame(one, 0).longest(quantity) for one in document["runs"])
        factors[quantity] = 0.25 * extent / longest if longest else 0.0
    frame = Frame(document["runs"][run], index)
    return frame.time, [frame.places(shape, factors) for shape in document["runs"][run]["shapes"]]
