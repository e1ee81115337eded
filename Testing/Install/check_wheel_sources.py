# SPDX-License-Identifier: BSD-3-Clause
"""Fails if a source of the Python wheel, which is built without VTK, includes a VTK header directly or indirectly.

Usage: python check_wheel_sources.py TOP SOURCE...
"""
import pathlib
import re
import sys

MODULES = ("Accelerators", "IO", "Filters", "Tools", "Plugins/Wheel")
OWN = re.compile(r"vtkTIPP\w+Module\.h")  # made by CMake, also in the wheel's build


def vtk_headers(top, sources):
    """VTK headers that the sources include, each with the including file and the chain of includes."""
    waiting = [(source, "") for source in sources]
    seen = set(sources)
    while waiting:
        file, through = waiting.pop()
        # The wheel has no MPI: these blocks, and their includes of VTK, are not compiled.
        text = re.sub(r"^#ifdef TIPP_HAVE_MPI\n.*?^#endif\n", "", file.read_text(), flags=re.MULTILINE | re.DOTALL)
        for name in re.findall(r'^\s*#\s*include "(.+?)"', text, re.MULTILINE):
            if name.startswith("vtk") and not OWN.fullmatch(name):
                yield name, f"{file.relative_to(top)}{through}"
            for folder in (file.parent, *(top / module for module in MODULES)):
                header = folder / name
                if header.exists() and header not in seen:
                    seen.add(header)
                    waiting.append((header, f", which {file.relative_to(top)}{through} includes"))


def main():
    top, *sources = map(pathlib.Path, sys.argv[1:])
    wheel = sorted((top / "Plugins/Wheel").glob("*.cxx"))
    if len(sources) < 50 or not wheel:
        sys.exit("These are not all sources of the wheel.")
    found = [f"{header} is included by {chain}." for header, chain in vtk_headers(top, [*sources, *wheel])]
    if found:
        sys.exit("The wheel is built without VTK, but:\n" + "\n".join(found))


main()
