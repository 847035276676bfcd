"""Build backend: setuptools, and the library compiled first.

It takes the machine's C compiler, or the one of the package `ziglang` where that is installed. Without either, and with
ACAUSAL_WITHOUT_CORE set, acausal is installed without its core.
"""

from __future__ import annotations

import os
import subprocess
import sys
from typing import Any

from compiling import compile_core, own_compiler, own_platform, ziglang
from setuptools import build_meta
from setuptools.build_meta import (
    build_sdist,
    get_requires_for_build_editable,
    get_requires_for_build_sdist,
    get_requires_for_build_wheel,
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


def _compile() -> None:
    """Compile the library of this platform; everything works without it, slower."""
    compiler = own_compiler() or ziglang()
    try:
        if compiler and not os.environ.get("ACAUSAL_WITHOUT_CORE"):
            compile_core(own_platform(), compiler)
    except (subprocess.CalledProcessError, OSError) as error:
        print(f"acausal is installed without its core: {error}\n{getattr(error, 'stderr', '')}", file=sys.stderr)


def build_wheel(wheel_directory: str, config_settings: Any = None, metadata_directory: str | None = None) -> str:
    """Compile the library and build a wheel."""
    _compile()
    return build_meta.build_wheel(wheel_directory, config_settings, metadata_directory)


def build_editable(wheel_directory: str, config_settings: Any = None, metadata_directory: str | None = None) -> str:
    """Compile the library and build an editable wheel."""
    _compile()
    return build_meta.build_editable(wheel_directory, config_settings, metadata_directory)
