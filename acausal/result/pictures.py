"""Pictures of a result: animations, and the page that explores it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from acausal.animation.frames import FRAMES
from acausal.language.call_arguments import checked_arguments
from acausal.locks import exclusive
from acausal.result.lookup import Key


class Pictures:
    """Base of results that can be animated and explored."""

    @checked_arguments
    @exclusive
    def animate(
        self: Any,
        path: str | Path,
        *,
        frames: int = FRAMES,
        plots: Sequence[Key] = (),
        values: Sequence[str] = (),
        title: str = "",
        deformation: float = 1.0,
        trails: Sequence[Key] = (),
        size: tuple[int, int] | None = None,
        view: str | None = None,
        fps: int | None = None,
    ) -> None:
        """Write an animation of the machine, with plots of the outputs below it.

        Parameters
        ----------
        path : str or Path
            Name of the file: .html, a page for any browser; .gif or .mp4, a film; .png, several instants in one picture.
        frames : int
            Approximate number of frames to which a longer result is thinned.
        plots : sequence of str, Path or Expr
            Quantities plotted below the picture; the outputs if empty.
        values : sequence of str
            Extra quantities by which beams can be coloured, such as "bending moment", "torque", "axial force"; or "all".
        title : str
            Title of the picture.
        deformation : float
            Scale of deformations, 1 to 1000; the page can change it.
        trails : sequence of str, Path or Expr
            Points whose paths are drawn: frames, such as "rod.frame_b", or positions.
        size : pair of int, optional
            Width and height of a film or still, in pixels; by default 640 and what the scene needs.
        view : str, optional
            "front", "top", "right" or "iso"; by default from the front for a flat scene, else from a corner. The page can change
            it.
        fps : int, optional
            Frames per second of a film, 1 to 50; by default 20 of .gif and 30 of .mp4.

        Raises
        ------
        ExportError
            If the file cannot be written, before anything is computed; .mp4 needs the program ffmpeg.
        DeclarationError
            If the result has no times, no model, nothing visible, no such values or points, or an option is invalid.
        """
        from acausal.result.animated import AnimationOptions, write

        options = AnimationOptions(frames, plots, values, title, deformation, trails, size, view, fps)
        write({self.title or self._model: self}, path, options)

    @checked_arguments
    @exclusive
    def explore(self: Any, path: str | Path, *, variables: Sequence[str] | None = None, frames: int = 1000) -> None:
        """Write one page that shows every variable: a tree of the parts, plots, and the moving machine.

        The page needs no network. To stay below 1.5 MB it may contain fewer times, and says how many; only large meshes exceed
        that. Values are exact to 1e-5 of the range of the variable.

        Parameters
        ----------
        path : str or Path
            Name of the file, ending in .html.
        variables : sequence of str, optional
            Paths of variables and parameters with * and ?, such as ["crank.*"]; all if not given.
        frames : int
            Approximate number of times to which a longer result is thinned, 2 or more.

        Raises
        ------
        ExportError
            If the file cannot be written, before anything is computed.
        DeclarationError
            If the result has no times, a pattern matches nothing, or the variables are too many for the page.
        """
        from acausal.result.explored import write

        write(self, path, variables, frames)

    @exclusive
    def _repr_html_(self: Any) -> str:
        """Show a summary in a notebook, and the animation if something is visible."""
        from acausal.result.notebook import result_html

        return result_html(self)
