"""Origin of errors: files of the package are skipped, files beside it are the user's."""

from __future__ import annotations

from pathlib import Path

import pytest

import acausal as ac

TEXT = """
import acausal as ac

class M(ac.Model):
    def equations(self):
        yield self.missing == 1
"""


@pytest.mark.parametrize("name", ["acausal_models/m.py", "acausal.py"])
def test_a_file_whose_path_begins_as_that_of_the_package_is_the_users(name):
    space = {"__name__": "somewhere"}
    file = str(Path(ac.__file__).parents[1] / name)
    exec(compile(TEXT, file, "exec"), space)
    with pytest.raises(ac.DeclarationError, match=rf"{file}:6: M has no `missing`"):
        ac.compile(space["M"]())
