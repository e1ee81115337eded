# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the files and functions that Documentation/Tour.md names exist: check_tour.py SOURCE"""
import pathlib
import re
import sys

PATH = r"`((?:Accelerators|IO|Filters|Tools)/[\w/.]+)`"


def missing(source, text):
    gone = [path for path in re.findall(PATH, text) if not (source / path).is_file()]
    for path, names in re.findall(PATH + r": ((?:`\w+`(?:, )?)+)", text):
        if path not in gone:
            code = (source / path).read_text(encoding="utf-8")
            gone += [f"{name} in {path}" for name in re.findall(r"\w+", names) if not re.search(rf"\b{name}\b", code)]
    return gone


def main(source):
    text = (source / "Documentation/Tour.md").read_text(encoding="utf-8")
    gone = missing(source, text)
    named = len(re.findall(PATH, text))
    if gone or named < 10:
        sys.exit("Tour.md names what does not exist: " + "; ".join(gone) if gone else "Tour.md names too few files")
    # The check itself: a changed file name and a changed function name are found.
    if not missing(source, text.replace(".h`", ".hh`", 1)) or not missing(source, text.replace("`runInMemory`", "`gone`")):
        sys.exit("check_tour.py does not find what is missing")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
