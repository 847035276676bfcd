"""The directive `scene`: picture, page to explore, command and source of a scene."""

from __future__ import annotations

import inspect
import shlex
import warnings
from html import escape
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util.docutils import SphinxDirective

import acausal as ac
from generate.docstrings import table
from generate.used import SCENES, on_command_line

FOLDER = "_generated/extra/explore"  # in the folder of the pages; copied to `explore` of the site


class Scene(SphinxDirective):
    """Simulate a scene and show it; a warning is an error.

    Options: `set` as on the command line, `values` and `deformation` as of `Result.animate`, `plot` of the outputs instead of
    the machine, `warns` the reason why the page to explore warns.
    """

    required_arguments = 1
    option_spec: ClassVar[Any] = {
        "set": directives.unchanged,
        "values": directives.unchanged,
        "deformation": float,
        "plot": directives.flag,
        "warns": directives.unchanged,
    }

    def run(self) -> list[Any]:
        """Return the nodes of the page."""
        name = self.arguments[0]
        cls, folder = SCENES[name], Path(self.env.srcdir, FOLDER)
        try:
            result = self._simulated(cls, folder, name)
        except (ac.AcausalError, ac.AcausalWarning) as error:
            raise self.error(f"{name}: {error}") from error
        self.env.note_dependency(inspect.getfile(cls))
        return self.parse_text_to_nodes(self._text(name, cls, result))

    def _simulated(self, cls: type, folder: Path, name: str) -> Any:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            result = ac.simulate(cls(), parameters=self._parameters())
            self._draw(result, folder / f"{name}.png")
            if "warns" in self.options:
                warnings.simplefilter("ignore")
            result.explore(folder / f"{name}.html")
        return result

    def _parameters(self) -> dict[str, Any]:
        pairs = (word.partition("=") for word in shlex.split(self.options.get("set", "")))
        return {name: _value(text) for name, _, text in pairs}

    def _draw(self, result: Any, path: Path) -> None:
        if "plot" in self.options:
            result.plot(*result.outputs, path=path)
            return
        values = [self.options["values"]] if "values" in self.options else []
        result.animate(path, values=values, deformation=self.options.get("deformation", 1.0))

    def _text(self, name: str, cls: type, result: Any) -> str:
        scene, given = on_command_line(name), "".join(f" --set {word}" for word in self.options.get("set", "").split())
        source = Path(inspect.getfile(cls)).read_text(encoding="utf-8").strip()
        outputs = [(f"`{name}`", cls.fields[name].description) for name in result.outputs]
        return "\n".join(
            (
                f'<p><img src="../explore/{name}.png" alt="{name}"></p>\n',
                f'<p><a class="explore" href="../explore/{name}.html">Explore the result: moving picture and plots</a></p>\n',
                f"    acausal simulate {scene}{given} --explore {name}.html\n",
                table(("output", "meaning"), outputs) + "\n" if outputs else "",
                f"<details><summary>{cls.__module__.replace('.', '/')}.py</summary>\n\n```python\n{source}\n```\n\n</details>",
            )
        )


class Gallery(SphinxDirective):
    """Small pictures of all scenes, with links to their pages."""

    def run(self) -> list[Any]:
        """Return the cards."""
        folder = Path(self.env.srcdir, "gallery")
        cards = []
        for name in SCENES:
            title = (folder / f"{name}.md").read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ")
            cards.append(
                f'<a href="{name}.html"><img src="../explore/{name}.png" alt="" loading="lazy"><span>{escape(title)}</span></a>'
            )
        return [nodes.raw("", f'<div class="cards">{"".join(cards)}</div>', format="html")]


def _value(text: str) -> Any:
    try:
        return float(text) if not text.isdigit() else int(text)
    except ValueError:
        return {"True": True, "False": False}.get(text, text)


def setup(app: Any) -> dict[str, bool]:
    """Add the directive."""
    app.add_directive("scene", Scene)
    app.add_directive("gallery", Gallery)
    return {"parallel_read_safe": True}
