"""Compile the library: for all platforms where the package `ziglang` is installed, else for this one."""

from __future__ import annotations

import subprocess
import sys

from acausal.core.build.compiling import CORE, PLATFORMS, compile_core, own_compiler, own_platform, ziglang


def main() -> int:
    """Compile and say how large the files are."""
    compiler = ziglang() or own_compiler()
    if not compiler:
        print("there is no C compiler: install one, or `python -m pip install ziglang`", file=sys.stderr)
        return 2
    for name in dict.fromkeys([own_platform(), *(PLATFORMS if ziglang() else ())]):
        try:
            path = compile_core(name, compiler)
        except (subprocess.CalledProcessError, OSError) as error:
            print(f"{name}: {error}\n{getattr(error, 'stderr', '')}", file=sys.stderr)
            return 1
        print(f"{path.relative_to(CORE)}  {path.stat().st_size / 1000:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
