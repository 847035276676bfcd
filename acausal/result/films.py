"""GIF films and PNG stills of scenes, for documents: drawn by matplotlib, written by Pillow."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from acausal.animation.camera import Camera, camera
from acausal.animation.drawing import Drawing, Polygon, rgb
from acausal.animation.scene import ALL, Scene, corners
from acausal.result.plots import DPI, canvas

WIDTH, LEAST, MOST = 640, 240, 560  # width, and limits of the height, in pixels
MARGIN = 0.06  # fraction of the width
RATE = 20  # frames per second of a film
SHORTEST, LONGEST, USUAL = 2.0, 10.0, 6.0  # seconds of a film that plays in real time; seconds otherwise
MOMENTS = 5  # instants in a still
FAINT = 0.75  # fraction of white mixed into the earliest instant, and into all runs but the first
NEARLY_WHITE = 245  # of 255: brighter colours of the palette become white
COLOURS, SAMPLES = 128, 8  # size of the palette, and number of frames from which it is computed
OTHERS = ("#2f6fdf", "#d1495b", "#2a9d78", "#a05fc9")


def film(scenes: Mapping[str, Scene], title: str, values: Sequence[str] = (), deformation: float = 1.0) -> bytes:
    """Return the motion as GIF, in real time or at a speed that the picture states.

    Parameters
    ----------
    scenes : mapping of str to Scene
        Scenes with sizes. The first is drawn in its own colours, the others faintly.
    title : str
        Title above the picture.
    values : sequence of str
        The first one colours beams, unless it is "all".
    deformation : float
        Scale of deformations.
    """
    picture = _Picture(scenes, title, values, deformation)
    from PIL import Image  # a dependency of matplotlib, which is loaded now

    begin, end = picture.span
    speed = _speed(end - begin)
    count = max(2, round((end - begin) / speed * RATE))
    digits = max(0, 2 - int(np.floor(np.log10(end - begin)))) if end > begin else 2
    frames = []
    for t in np.linspace(begin, end, count):
        caption = f"t = {t:.{digits}f} s"
        frames.append(picture.pixels([(float(t), 0.0)], caption + (f"   (speed x {speed:g})" if speed != 1 else "")))
    palette = _joined(frames[:: max(1, len(frames) // SAMPLES)]).quantize(COLOURS)
    # A background that is not quite white would show as a box on a white page.
    palette.putpalette([255 if c > NEARLY_WHITE else c for c in palette.getpalette() or ()])
    images = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    file = io.BytesIO()
    images[0].save(file, "GIF", save_all=True, append_images=images[1:], duration=1000 // RATE, loop=0, optimize=True)
    return file.getvalue()


def still(scenes: Mapping[str, Scene], title: str, values: Sequence[str] = (), deformation: float = 1.0) -> bytes:
    """Return several instants in one PNG, earlier ones fainter; arguments as in `film`."""
    picture = _Picture(scenes, title, values, deformation)
    begin, end = picture.span
    times = np.linspace(begin, end, MOMENTS) if end > begin else [end]
    faint = np.linspace(FAINT, 0, len(times))
    caption = f"t = {begin:.4g} to {end:.4g} s" if end > begin else f"t = {end:.4g} s"
    file = io.BytesIO()
    picture.pixels(list(zip(map(float, times), map(float, faint), strict=True)), caption).save(
        file, "PNG", optimize=True
    )
    return file.getvalue()


def _joined(frames: Sequence[Any]) -> Any:
    """Stack pictures vertically."""
    from PIL import Image

    return Image.fromarray(np.concatenate([np.asarray(frame) for frame in frames]))


def _speed(seconds: float) -> float:
    """Return the playback speed: 1, or 1, 2 or 5 times a power of ten."""
    if SHORTEST <= seconds <= LONGEST or seconds <= 0:
        return 1.0
    wanted = seconds / USUAL
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * min((1, 2, 5, 10), key=lambda m: abs(np.log(m * power / wanted))))


class _Picture:
    """Draws instants of scenes on one canvas."""

    def __init__(self, scenes: Mapping[str, Scene], title: str, values: Sequence[str], deformation: float) -> None:
        self.scenes = list(scenes.values())
        low = np.min([s.low for s in self.scenes], axis=0)
        high = np.max([s.high for s in self.scenes], axis=0)
        self.view = camera(low, high, self.scenes[0].up)
        self.span = float(min(s.run.time[0] for s in self.scenes)), float(max(s.run.time[-1] for s in self.scenes))
        self._lay_out(self.view, low, high)
        by = values[0] if values and values[0] != ALL else ""
        colours = self._colour_bar(by)
        self.drawings = [Drawing(scene, self.view, colours, by, deformation) for scene in self.scenes]
        more = f"   (deformation x {deformation:g})" if deformation != 1 else ""
        self._title((title or self.scenes[0].run.title) + more, list(scenes))

    def _lay_out(self, view: Camera, low: np.ndarray, high: np.ndarray) -> None:
        from matplotlib.collections import PolyCollection

        seen = view.project(corners(low, high))[:, :2]
        middle, size = (seen.min(axis=0) + seen.max(axis=0)) / 2, np.ptp(seen, axis=0) + 0.1 * self.scenes[0].size
        height = int(np.clip(WIDTH * size[1] / size[0], LEAST, MOST)) // 2 * 2
        scale = max(size[0] / WIDTH, size[1] / (height - 50)) / (1 - 2 * MARGIN)
        self.figure = canvas(WIDTH / DPI, height / DPI, "tight")
        self.figure.set_layout_engine("none")
        self.axes = self.figure.add_axes((0, 0, 1, 1))
        self.axes.set_axis_off()
        self.axes.set_xlim(middle[0] - WIDTH / 2 * scale, middle[0] + WIDTH / 2 * scale)
        self.axes.set_ylim(middle[1] - height / 2 * scale, middle[1] + height / 2 * scale)
        self.shown = PolyCollection([], antialiaseds=True, linewidths=0.3)
        self.axes.add_collection(self.shown, autolim=False)
        self.time = self.axes.text(0.98, 0.97, "", transform=self.axes.transAxes, ha="right", va="top", fontsize=6)

    def _title(self, title: str, names: list[str]) -> None:
        place = {"transform": self.axes.transAxes, "va": "top", "parse_math": False}
        self.axes.text(0.02, 0.97, title, fontsize=7, weight="bold", **place)
        for k, name in enumerate(names if len(names) > 1 else ()):
            self.axes.text(0.02, 0.9 - 0.05 * k, name, color=OTHERS[k % len(OTHERS)], fontsize=6, **place)

    def _colour_bar(self, by: str) -> Any:
        """Draw the colour bar; return the function from values to colours, None without values."""
        found = [v for s in self.scenes for one in s.shapes for v in getattr(one.shape, "values", ()) if v.name == by]
        if not found:
            return None
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import Normalize

        most = max(float(np.max(np.abs(v.entries))) for v in found) or 1.0
        mapped = ScalarMappable(Normalize(-most, most), "turbo")
        place = self.figure.add_axes((0.68, 0.1, 0.28, 0.02))
        bar = self.figure.colorbar(mapped, cax=place, orientation="horizontal", ticks=[-most, 0, most], format="%.2g")
        bar.ax.set_title(f"{by} [{found[0].unit}]", fontsize=6)
        bar.ax.tick_params(labelsize=6)
        return lambda numbers: mapped.to_rgba(numbers)[:, :3]

    def pixels(self, moments: list[tuple[float, float]], caption: str) -> Any:
        """Return a picture of several instants, each a time and its fraction of white."""
        from PIL import Image

        polygons: list[tuple[Polygon, np.ndarray]] = [(p, p.colour) for p in self.drawings[0].grid()]
        for t, faint in moments:
            for n, (scene, drawing) in reversed(list(enumerate(zip(self.scenes, self.drawings, strict=True)))):
                for polygon in drawing.frame(int(np.argmin(np.abs(scene.run.time - t)))):
                    own = rgb(OTHERS[n % len(OTHERS)]) if len(self.scenes) > 1 else polygon.colour
                    colour = 0.6 * own + 0.4 * polygon.colour
                    white = FAINT if n else faint
                    polygons.append((polygon, white + (1 - white) * colour))
        self.shown.set_verts([polygon.corners for polygon, _ in polygons])
        colours = [tuple(colour.tolist()) for _, colour in polygons]
        self.shown.set_facecolor(colours)
        self.shown.set_edgecolor(colours)
        self.time.set_text(caption)
        self.figure.canvas.draw()
        canvas_: Any = self.figure.canvas
        return Image.fromarray(np.asarray(canvas_.buffer_rgba())[:, :, :3].copy())
