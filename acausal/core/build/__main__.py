"""Compile the library for all platforms: `pip install ziglang && python -m acausal.core.build`."""

from __future__ import annotations

import subprocess
import sys

from acausal.core.build.compiling import CORE, PLATFORMS, compile_core, ziglang


def main() -> int:
    """Compile and say how large the files are."""
    if not ziglang():
        print("pip install ziglang", file=sys.stderr)
        return 2
    for name in PLATFORMS:
        try:
            path = compile_core(name, ziglang())
        except subprocess.CalledProcessError as error:
            print(f"{name}: {error.stderr}", file=sys.stderr)
            return 1
        print(f"{path.relative_to(CORE)}  {path.stat().st_size / 1000:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
