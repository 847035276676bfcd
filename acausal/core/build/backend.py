"""Build backend: setuptools, and the library compiled first.

The library of this platform comes from the machine's C compiler, or from the package `ziglang`, which is fetched where it
is not installed. Without either, and with ACAUSAL_WITHOUT_CORE set, acausal is installed without its core. The wheel for
all platforms, made with `--config-settings platforms=all`, holds all libraries, or is not made.
"""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import sysconfig
import tempfile
from typing import Any

from compiling import PLATFORMS, compile_core, own_compiler, own_platform, ziglang
from setuptools import build_meta
from setuptools.build_meta import (
    build_sdist,
    get_requires_for_build_editable,
    get_requires_for_build_sdist,
    prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel,
)

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
    "prepare_metadata_for_build_editable",
    "prepare_metadata_for_build_wheel",
]


def _for_all(config_settings: Any) -> bool:
    return (config_settings or {}).get("platforms") == "all"


def _fetched(folder: str) -> list[str]:
    """Return the command of a compiler that is fetched into a folder."""
    # Isolated, as installers hide their own packages from what they call.
    install = [sys.executable, "-I", "-m", "pip", "install", "--retries", "1", "--target", folder, "ziglang"]
    subprocess.run(install, check=True, capture_output=True, text=True)
    return ziglang(folder)


def _compile() -> None:
    """Compile the library of this platform; without it models are compiled and not integrated."""
    if os.environ.get("ACAUSAL_WITHOUT_CORE"):
        return
    with tempfile.TemporaryDirectory() as folder:
        for find in (own_compiler, ziglang, lambda: _fetched(folder)):
            try:
                if compiler := find():
                    compile_core(own_platform(), compiler)
                    return
            except (subprocess.CalledProcessError, OSError) as error:
                print(f"{error}\n{getattr(error, 'stderr', '')}", file=sys.stderr)
    print("acausal is installed without its core", file=sys.stderr)


def own_tag() -> str:
    """Return the tag of wheels for this platform alone, of one processor also where Python runs on two."""
    tag = sysconfig.get_platform()
    if tag.endswith("universal2"):
        return "macosx_11_0_arm64" if platform.machine() == "arm64" else tag.replace("universal2", "x86_64")
    return tag


def get_requires_for_build_wheel(config_settings: Any = None) -> list[str]:
    """Return what a wheel needs.

    A requirement that cannot be had ends the installation: the compiler is one only where there is no wheel without it.
    """
    needed = build_meta.get_requires_for_build_wheel(config_settings)
    return [*needed, "ziglang"] if _for_all(config_settings) else needed


def build_wheel(wheel_directory: str, config_settings: Any = None, metadata_directory: str | None = None) -> str:
    """Compile and build a wheel: for any platform if it holds the libraries of all, else for this one."""
    settings = dict(config_settings or {})
    if _for_all(settings):
        for name in PLATFORMS:
            compile_core(name, ziglang())
    else:
        _compile()
        settings["--build-option"] = ["--plat-name", own_tag()]
    return build_meta.build_wheel(wheel_directory, settings, metadata_directory)


def build_editable(wheel_directory: str, config_settings: Any = None, metadata_directory: str | None = None) -> str:
    """Compile the library and build an editable wheel."""
    _compile()
    return build_meta.build_editable(wheel_directory, config_settings, metadata_directory)
