#!/usr/bin/python3
"""The code blocks of a page: `fenced_blocks.py PAGE LANGUAGE` prints those of one language."""

import re
import sys
from pathlib import Path


def fenced_blocks(page):
    """(language, text) of every block between ``` lines, in order."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", Path(page).read_text(), flags=re.MULTILINE | re.DOTALL)


if __name__ == "__main__":
    print("".join(text for language, text in fenced_blocks(sys.argv[1]) if language == sys.argv[2]), end="")
