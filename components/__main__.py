"""`python -m components [WORD]`: print the table of parts, optionally filtered by name or domain."""

from __future__ import annotations

import argparse

from components import table

if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m components", description="Print the table of all parts.")
    parser.add_argument("word", nargs="?", default="", help="select parts whose name or domain contains it")
    word = parser.parse_args().word
    print(table(word) or f"No part has `{word}` in its name or domain.")
