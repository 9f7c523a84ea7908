"""Files that are there whole or not at all."""

import os


def write(path, text):
    beside = path.with_name(path.name + ".tmp")
    with open(beside, "w", encoding="utf-8", errors="surrogateescape") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    os.replace(beside, path)
