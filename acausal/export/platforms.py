"""Platforms of the libraries in an exported model, and their folders according to FMI."""

from __future__ import annotations

from collections.abc import Sequence

from acausal.core.build.compiling import file_of, own_platform, version
from acausal.core.library import MEND, why_not
from acausal.errors import ExportError
from acausal.nearest import most_similar
from acausal.result import shown_name

# FMI 2 has one folder for both processors of macOS: x86-64 takes precedence.
FOLDERS = {
    2: {
        "linux-x86_64": "linux64",
        "linux-aarch64": "aarch64-linux",
        "windows-x86_64": "win64",
        "macos-x86_64": "darwin64",
        "macos-arm64": "darwin64",
    },
    3: {
        "linux-x86_64": "x86_64-linux",
        "linux-aarch64": "aarch64-linux",
        "windows-x86_64": "x86_64-windows",
        "macos-x86_64": "x86_64-darwin",
        "macos-arm64": "aarch64-darwin",
    },
}
BUILD_ALL = "`python -m pip install ziglang`, then `python -m acausal.core.build` compiles it for all platforms"


def chosen(fmi_version: int, platforms: Sequence[str]) -> dict[str, str]:
    """Return the platform of the library in each folder.

    Parameters
    ----------
    fmi_version : int
        2 or 3.
    platforms : sequence of str
        Names of platforms, "own" or "all".

    Raises
    ------
    ExportError
        If a version or platform is unknown, or a library, including that of this platform, is missing or outdated.
    """
    if fmi_version not in FOLDERS:
        raise ExportError(f"fmi_version must be 2 or 3, not {fmi_version!r}.")
    folders = FOLDERS[fmi_version]
    asked = [platforms] if isinstance(platforms, str) else platforms
    wanted = {name for given in asked for name in _meant(given, list(folders))}
    if not wanted:
        raise ExportError(f"platforms is empty: name own, all, or some of {', '.join(folders)}.")
    found: dict[str, str] = {}
    for name, folder in folders.items():
        if name in wanted:
            found.setdefault(folder, name)
    if missing := [name for name in found.values() if not _is_installed(name)]:
        mend = MEND if missing == [own_platform()] else BUILD_ALL
        raise ExportError(f"the core is not installed for {', '.join(missing)}: {mend}.")
    if why := why_not(runs=False):
        raise ExportError(f"the export needs the core for this platform, which is missing: {why}.")
    return found


def _meant(given: str, known: list[str]) -> list[str]:
    if given == "all":
        return known
    name = own_platform() if given == "own" else given
    if name in known:
        return [name]
    choice = f"Platforms: own, all, {', '.join(known)}."
    if given == "own":
        raise ExportError(f"FMI has no folder for {name}, this platform; name others. {choice}")
    near = most_similar(given, [*known, "own", "all"], 0.5)
    raise ExportError(
        f"there is no platform `{shown_name(given)}`{f'; did you mean `{near}`?' if near else '.'} {choice}"
    )


def _is_installed(name: str) -> bool:
    path = file_of(name)
    # A library of another platform cannot be loaded: read the hash of its sources from the file.
    return path.is_file() and version().encode() in path.read_bytes()
