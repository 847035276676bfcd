"""Films and PNG stills of scenes, for documents: drawn by matplotlib, written by Pillow or ffmpeg."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import chain
from pathlib import Path
from subprocess import DEVNULL, PIPE, Popen
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from acausal.animation.camera import camera, standard
from acausal.animation.colours import ARROWS, DIVERGING
from acausal.animation.drawing import Drawing, Polygon, rgb
from acausal.animation.scene import ALL, Scene, corners
from acausal.errors import ExportError
from acausal.result.animation_options import AnimationOptions
from acausal.result.plots import DPI, canvas

WIDTH, LEAST, MOST = 640, 240, 560  # width, and limits of the height, in pixels
MARGIN = 0.06  # fraction of the width
TITLE, BAR = 50, 60  # heights of the title and of the colour bar in pixels at the usual width
LETTERS = 0.5, 4.0  # limits of the scale of letters
RATE, MOVIE_RATE = 20, 30  # frames per second of .gif and .mp4
UNITS = {"force": "N", "torque": "N.m"}
SHORTEST, LONGEST, USUAL = 2.0, 10.0, 6.0  # seconds of a film that plays in real time; seconds otherwise
MOMENTS = 5  # instants in a still
FAINT = 0.75  # fraction of white mixed into the earliest instant, and into all runs but the first
NEARLY_WHITE = 245  # of 255: brighter colours of the palette become white
COLOURS, SAMPLES = 256, 8  # size of the palette, and number of frames from which it is computed
OTHERS = ("#2f6fdf", "#d1495b", "#2a9d78", "#a05fc9")


def film(scenes: Mapping[str, Scene], options: AnimationOptions) -> bytes:
    """Return the motion as GIF, in real time or at a speed that the picture states.

    Parameters
    ----------
    scenes : mapping of str to Scene
        Scenes with sizes. The first is drawn in its own colours, the others faintly.
    options : AnimationOptions
        Options; the first of its values colours beams, unless it is "all".
    """
    from PIL import Image  # a dependency of matplotlib, which is loaded now

    rate = options.fps or RATE
    frames = list(_frames(scenes, options, rate))
    palette = _joined(frames[:: max(1, len(frames) // SAMPLES)]).quantize(COLOURS)
    # A background that is not quite white would show as a box on a white page.
    palette.putpalette([255 if c > NEARLY_WHITE else c for c in palette.getpalette() or ()])
    images = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    file = io.BytesIO()
    # Delays are multiples of 10 ms; their sum is that of the film.
    ends = np.round(np.arange(len(images) + 1) * 100 / rate).astype(int)
    delays = [10 * int(delay) for delay in np.diff(ends)]
    images[0].save(file, "GIF", save_all=True, append_images=images[1:], duration=delays, loop=0, optimize=True)
    return file.getvalue()


def movie(scenes: Mapping[str, Scene], options: AnimationOptions) -> bytes:
    """Return the motion as MP4, written by ffmpeg; arguments as in `film`.

    Raises
    ------
    ExportError
        If ffmpeg fails.
    """
    rate = options.fps or MOVIE_RATE
    with TemporaryDirectory() as folder:
        file = Path(folder) / "film.mp4"
        frames = _frames(scenes, options, rate)
        first = next(frames)
        taken = (
            "-f",
            "rawvideo",
            "-pix_fmt",
            "rgb24",
            "-s",
            f"{first.width}x{first.height}",
            "-r",
            str(rate),
            "-i",
            "-",
        )
        # Most players need even sizes and this format of pixels.
        made = ("-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p", "-movflags", "+faststart")
        command = ["ffmpeg", "-y", "-loglevel", "error", *taken, *made, str(file)]
        with Popen(command, stdin=PIPE, stdout=DEVNULL, stderr=PIPE) as process:
            with suppress(BrokenPipeError):  # its message follows
                for frame in chain([first], frames):
                    process.stdin.write(frame.tobytes())  # type: ignore[union-attr]
            _, message = process.communicate()
        if process.returncode or not file.exists():
            raise ExportError(
                f"ffmpeg cannot write the film: {message.decode(errors='replace').strip() or 'no reason given'}."
            )
        return file.read_bytes()


def still(scenes: Mapping[str, Scene], options: AnimationOptions) -> bytes:
    """Return several instants in one PNG, earlier ones fainter; arguments as in `film`."""
    picture = _Picture(scenes, options)
    begin, end = picture.span
    times = np.linspace(begin, end, MOMENTS) if end > begin else [end]
    faint = np.linspace(FAINT, 0, len(times))
    caption = f"t = {begin:.4g} to {end:.4g} s" if end > begin else f"t = {end:.4g} s"
    file = io.BytesIO()
    picture.pixels(list(zip(map(float, times), map(float, faint), strict=True)), caption).save(
        file, "PNG", optimize=True
    )
    return file.getvalue()


FILES = {".gif": film, ".mp4": movie, ".png": still}


def _frames(scenes: Mapping[str, Scene], options: AnimationOptions, rate: int) -> Iterator[Any]:
    """Yield the pictures of a film."""
    picture = _Picture(scenes, options)
    begin, end = picture.span
    speed = _speed(end - begin)
    count = max(2, round((end - begin) / speed * rate))
    digits = max(0, 2 - int(np.floor(np.log10(end - begin)))) if end > begin else 2
    for t in np.linspace(begin, end, count):
        caption = f"t = {t:.{digits}f} s"
        yield picture.pixels([(float(t), 0.0)], caption + (f"   (speed x {speed:g})" if speed != 1 else ""))


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

    def __init__(self, scenes: Mapping[str, Scene], options: AnimationOptions) -> None:
        self.scenes = list(scenes.values())
        low = np.min([s.low for s in self.scenes], axis=0)
        high = np.max([s.high for s in self.scenes], axis=0)
        up = self.scenes[0].up
        self.view = standard(options.view, up) if options.view else camera(low, high, up)
        self.span = float(min(s.run.time[0] for s in self.scenes)), float(max(s.run.time[-1] for s in self.scenes))
        by = options.values[0] if options.values and options.values[0] != ALL else ""
        self._lay_out(low, high, options.size, BAR if by else 0)
        colours = self._colour_bar(by)
        self.drawings = [Drawing(scene, self.view, colours, by, options.deformation) for scene in self.scenes]
        more = f"   (deformation x {options.deformation:g})" if options.deformation != 1 else ""
        self._title((options.title or self.scenes[0].run.title) + more, list(scenes))
        self._arrow_scale()

    def _lay_out(self, low: np.ndarray, high: np.ndarray, wanted: tuple[int, int] | None, bar: int) -> None:
        from matplotlib.collections import PolyCollection

        seen = self.view.project(corners(low, high))[:, :2]
        middle, size = (seen.min(axis=0) + seen.max(axis=0)) / 2, np.ptp(seen, axis=0) + 0.1 * self.scenes[0].size
        fitting = WIDTH, int(np.clip(WIDTH * size[1] / size[0] + bar, LEAST, MOST)) // 2 * 2
        width, height = wanted or fitting
        self.letter = float(np.clip(min(width / WIDTH, height / LEAST), *LETTERS))
        below, above = bar * self.letter, min(TITLE * self.letter, height / 4)
        scale = max(size[0] / width, size[1] / max(height - above - below, height / 4)) / (1 - 2 * MARGIN)
        self.figure = canvas(width / DPI, height / DPI, "tight")
        self.figure.set_layout_engine("none")
        self.axes = self.figure.add_axes((0, 0, 1, 1))
        self.axes.set_axis_off()
        self.axes.set_xlim(middle[0] - width / 2 * scale, middle[0] + width / 2 * scale)
        lowest = middle[1] - (height + below - above / 2) / 2 * scale
        self.axes.set_ylim(lowest, lowest + height * scale)
        self.shown = PolyCollection([], antialiaseds=True, linewidths=0.3)
        self.axes.add_collection(self.shown, autolim=False)
        self.time = self._text(0.98, 0.97, "", 6, ha="right", va="top")

    def _text(self, x: float, y: float, text: str, size: float, **more: Any) -> Any:
        """Write a text at a place in fractions of the picture; its size is for the usual width."""
        more = {"transform": self.axes.transAxes, "parse_math": False, "fontsize": size * self.letter} | more
        return self.axes.text(x, y, text, **more)

    def _title(self, title: str, names: list[str]) -> None:
        self._text(0.02, 0.97, title, 7, weight="bold", va="top")
        for k, name in enumerate(names if len(names) > 1 else ()):
            self._text(0.02, 0.9 - 0.05 * k, name, 6, color=OTHERS[k % len(OTHERS)], va="top")

    def _arrow_scale(self) -> None:
        """Write the lengths of the longest arrows."""
        place = 0.02
        for quantity, unit in UNITS.items():
            longest = max(drawing.longest[quantity] for drawing in self.drawings)
            if any(drawing.shows(quantity) for drawing in self.drawings):
                self._text(
                    0.02, place, f"longest {quantity} {longest:.3g} {unit}", 6, color=ARROWS[quantity], va="bottom"
                )
                place += 0.05

    def _colour_bar(self, by: str) -> Any:
        """Draw the colour bar; return the function from values to colours, None without values."""
        found = [v for s in self.scenes for one in s.shapes for v in getattr(one.shape, "values", ()) if v.name == by]
        if not found:
            return None
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import LinearSegmentedColormap, Normalize

        most = max(float(np.max(np.abs(v.entries))) for v in found) or 1.0
        mapped = ScalarMappable(Normalize(-most, most), LinearSegmentedColormap.from_list("", DIVERGING))
        place = self.figure.add_axes((0.68, 0.1, 0.28, 0.02))
        bar = self.figure.colorbar(mapped, cax=place, orientation="horizontal", ticks=[-most, 0, most], format="%.2g")
        bar.ax.set_title(f"{by} [{found[0].unit}]", fontsize=6 * self.letter)
        bar.ax.tick_params(labelsize=6 * self.letter)
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
