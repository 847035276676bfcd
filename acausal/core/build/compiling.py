"""Compile the library, for this platform or for others. Stands alone: it runs before anything is installed."""

from __future__ import annotations

import hashlib
import importlib.machinery
import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

CORE = Path(__file__).resolve().parents[1]
SOURCE = CORE / "source"
FLAGS = ("-O3", "-std=c99", "-shared", "-fvisibility=hidden", "-Wall", "-Wextra", "-pedantic", "-Werror=implicit")
# Name of each platform: target of the compiler that builds for all of them, and file.
PLATFORMS = {
    "linux-x86_64": ("x86_64-linux-gnu.2.17", "libacausal-linux-x86_64.so"),
    "linux-aarch64": ("aarch64-linux-gnu.2.17", "libacausal-linux-aarch64.so"),
    "musl-x86_64": ("x86_64-linux-musl", "libacausal-musl-x86_64.so"),
    "musl-aarch64": ("aarch64-linux-musl", "libacausal-musl-aarch64.so"),
    "windows-x86_64": ("x86_64-windows-gnu", "acausal-windows-x86_64.dll"),
    "macos-x86_64": ("x86_64-macos.10.13", "libacausal-macos-x86_64.dylib"),
    "macos-arm64": ("aarch64-macos.11.0", "libacausal-macos-arm64.dylib"),
}


def own_platform() -> str:
    """Return the name of this platform, whether or not the library is built for it."""
    system = {"win32": "windows", "darwin": "macos"}.get(sys.platform, sys.platform)
    if system == "linux" and platform.libc_ver()[0] != "glibc":
        system = "musl"
    machine = {"amd64": "x86_64", "x64": "x86_64"}.get(platform.machine().lower(), platform.machine().lower())
    return f"{system}-{'arm64' if (system, machine) == ('macos', 'aarch64') else machine}"


def file_of(name: str) -> Path:
    """Return where the library of a platform stands."""
    return CORE / "lib" / (PLATFORMS[name][1] if name in PLATFORMS else f"libacausal-{name}.so")


def version() -> str:
    """Return what tells the sources from others: the library says of which it was made."""
    found = hashlib.sha256()
    for source in sorted(SOURCE.glob("*.[ch]")):
        found.update(source.read_bytes())
    return found.hexdigest()[:16]


def own_compiler() -> list[str]:
    """Return the command of this machine's C compiler; empty where there is none that takes these options."""
    if given := os.environ.get("CC"):
        return shlex.split(given)
    return next(([found] for name in ("cc", "gcc", "clang") if (found := shutil.which(name))), [])


def ziglang(folder: str | None = None) -> list[str]:
    """Return the command of the compiler that builds for all platforms; empty where it is not installed.

    Parameters
    ----------
    folder : str, optional
        Where to look for its package, instead of among those that are installed.
    """
    found = importlib.machinery.PathFinder.find_spec("ziglang", None if folder is None else [folder])
    return [str(Path(found.origin).with_name("zig")), "cc"] if found and found.origin else []


def compile_core(name: str, compiler: list[str]) -> Path:
    """Compile the library of a platform, and return its file, which is written whole or not at all.

    Raises
    ------
    subprocess.CalledProcessError
        If the compiler refuses; its words are in `stderr`.
    """
    path = file_of(name)
    path.parent.mkdir(exist_ok=True)
    # Without a target this compiler takes every instruction of the processor at hand.
    every = any(Path(word).stem in ("zig", "ziglang") for word in compiler) and name in PLATFORMS
    target = ["-target", PLATFORMS[name][0], "-s"] if every else []
    alone = [] if name.startswith("windows") else ["-fPIC", "-lm"]
    named = [f"-Wl,-install_name,@rpath/{path.name}"] if name.startswith("macos") else []
    sources = sorted(str(source) for source in SOURCE.glob("*.c"))
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        made = Path(folder) / path.name
        command = [*compiler, *target, *FLAGS, f"-DAC_SOURCES={version()}", *named, *sources, *alone, "-o", str(made)]
        subprocess.run(command, check=True, capture_output=True, text=True)
        return made.replace(path)
