"""`python -m components [WORD]`: the table of all parts, or of those with a word in their name or domain."""

from __future__ import annotations

import argparse

from components import table

if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m components", description="Print the table of all parts.")
    parser.add_argument("word", nargs="?", default="", help="only parts with it in their name or domain")
    word = parser.parse_args().word
    print(table(word) or f"No part has `{word}` in its name or domain.")
