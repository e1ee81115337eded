# SPDX-License-Identifier: BSD-3-Clause
"""Prints those of the tests' sources that include a VTK header, directly or indirectly, as a list for CMake.

Usage: python vtk_users.py TOP SOURCE...
"""
import pathlib
import re
import sys

OWN = re.compile(r"vtkTIPP\w+Module\.h")  # made by CMake, also without VTK
MPI = re.compile(r"^#ifdef TIPP_HAVE_MPI\n.*?^#endif\n", re.MULTILINE | re.DOTALL)


def included_files(file, folders):
    """Pairs of an included name and its file, or None if it is not in the folders."""
    text = MPI.sub("", file.read_text(encoding="utf-8"))
    for name in re.findall(r'^\s*#\s*include ["<](.+?)[">]', text, re.MULTILINE):
        yield name, next((path for path in (folder / name for folder in (file.parent, *folders)) if path.exists()), None)


def uses_vtk(file, folders, known):
    """`known` keeps the answers."""
    if file not in known:
        known[file] = False  # also ends the search at a header that includes itself
        known[file] = any(
            uses_vtk(path, folders, known) if path else name.startswith("vtk") and not OWN.fullmatch(name)
            for name, path in included_files(file, folders))
    return known[file]


def main():
    top, *sources = map(pathlib.Path, sys.argv[1:])
    tests = [folder for folder in sorted((top / "Testing/Cxx").iterdir()) if folder.is_dir()]
    folders = [*(top / module for module in ("Accelerators", "IO", "Filters", "Tools")), *tests]
    known = {}
    print(";".join(str(source) for source in sources if uses_vtk(source, folders, known)), end="")


main()
