"""Folders and files of the user that shadow `components` or `models` are named, with the remedy."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MODEL = """from acausal import Model
from components import World


class M(Model):
    world = World()
"""


def told(folder, *arguments):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, *arguments], cwd=folder, env=environment, capture_output=True, text=True)
    return done.stderr


@pytest.mark.parametrize(
    ("hides", "what", "name"),
    [
        ("components/__init__.py", "folder", "components"),
        ("components.py", "file", "components"),
        ("models/__init__.py", "folder", "models"),
    ],
)
@pytest.mark.parametrize("command", [("-m", "acausal", "list"), ("-m", "acausal", "check", "four-bar")])
def test_what_hides_a_package_is_named(tmp_path, hides, what, name, command):
    path = tmp_path / hides
    path.parent.mkdir(exist_ok=True)
    path.write_text("x = 1\n")
    place = path if what == "file" else path.parent
    text = told(tmp_path, *command)
    assert f"the {what} {place} hides the package `{name}` of acausal" in text
    assert "Rename it, or start Python in another folder." in text


def test_an_import_that_fails_for_it(tmp_path):
    (tmp_path / "components.py").write_text("x = 1\n")
    (tmp_path / "own.py").write_text(MODEL)
    text = told(tmp_path, "-m", "acausal", "check", "own.py:M")
    assert "cannot import name 'World' from 'components': the file" in text
    assert f"Error: {tmp_path / 'own.py'}:2: ImportError" in text


def test_an_import_that_fails_in_a_script(tmp_path):
    (tmp_path / "components.py").write_text("x = 1\n")
    (tmp_path / "own.py").write_text(MODEL)
    text = told(tmp_path, "own.py")
    assert "cannot import name 'World' from 'components'" in text
    assert f"The file {tmp_path / 'components.py'} hides the package `components` of acausal" in text


def test_other_packages_of_these_names_are_nobodys_business(tmp_path):
    (tmp_path / "models.py").write_text("x = 1\n")
    assert told(tmp_path, "-c", "import acausal, models; print(models.x)") == ""


def test_a_folder_that_is_no_package_hides_nothing(tmp_path):
    (tmp_path / "models").mkdir()
    (tmp_path / "own.py").write_text(MODEL)
    assert told(tmp_path, "-m", "acausal", "check", "own.py:M") == ""
