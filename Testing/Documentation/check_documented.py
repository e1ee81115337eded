# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every public class, method and property of the plugin is documented.

Usage: check_documented.py SOURCE SCRATCH [DOXYGEN]
       check_documented.py --gaps SOURCE SCRATCH [DOXYGEN]     (checks that removed documentation is found)

DOXYGEN's warnings show undocumented methods (Documentation/Doxyfile). Without it, methods are not checked.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

PROXIES = ("SourceProxy", "WriterProxy")


def is_empty(element):
    return element is None or not (element.text or "").strip()


def gaps_in_xml(text, name):
    """Missing texts: a proxy's short and long help, or a property's documentation."""
    gaps = []
    proxies = [element for element in ElementTree.fromstring(text).iter() if element.tag in PROXIES]
    if not proxies:
        gaps.append(f"{name}: no proxy")
    for proxy in proxies:
        help_text = proxy.find("Documentation")
        for kind in ("short_help", "long_help"):
            if help_text is None or not help_text.get(kind, "").strip():
                gaps.append(f"{name}: {proxy.get('name')} has no {kind}")
        for child in proxy:
            if child.tag.endswith("Property") and is_empty(child.find("Documentation")):
                gaps.append(f"{name}: {proxy.get('name')}.{child.get('name')} has no Documentation")
    return gaps


def public_headers(source):
    """The headers that declare VTK classes, relative to the source folder."""
    return {str(path.relative_to(source)) for folder in ("Accelerators", "IO", "Filters", "Plugins")
            for path in (source / folder).rglob("vtk*.h") if "public vtk" in path.read_text(encoding="utf-8")}


def headers_of_doxygen(source):
    text = (source / "Documentation/Doxyfile").read_text(encoding="utf-8")
    return set(re.search(r"^INPUT\s*=((?:.*\\\n)*.*)", text, re.M).group(1).replace("\\", " ").split())


def gaps_in_headers(source, scratch, doxygen):
    gaps = [f"{header}: not in Documentation/Doxyfile" for header in public_headers(source) - headers_of_doxygen(source)]
    if doxygen:
        configuration = (source / "Documentation/Doxyfile").read_text(encoding="utf-8")
        configuration += f'\nOUTPUT_DIRECTORY = "{scratch}"\n'
        result = subprocess.run([doxygen, "-"], input=configuration, cwd=source, text=True, capture_output=True)
        warnings = [line for line in result.stderr.splitlines() if "warning:" in line or "error:" in line]
        gaps += warnings or ([result.stderr] if result.returncode else [])
    return gaps


def plugin_files(source):
    return sorted((source / "Plugins").rglob("*.xml"))


def check(source, scratch, doxygen):
    gaps = gaps_in_headers(source, scratch, doxygen)
    for file in plugin_files(source):
        gaps += gaps_in_xml(file.read_text(encoding="utf-8"), file.name)
    return gaps


def check_xml_gaps(source):
    """Removes each text of each file in turn, and returns the files in which this was not found."""
    unseen = []
    for file in plugin_files(source):
        text = file.read_text(encoding="utf-8")
        spoiled = [text[:found.start(2)] + text[found.end(2):]
                   for found in re.finditer(r"(<Documentation>)([^<]+)(?=</Documentation>)", text)]
        spoiled += [text.replace(kind + "=", "other=", 1) for kind in ("short_help", "long_help")]
        unseen += [file.name for each in spoiled if not gaps_in_xml(each, file.name)]
    return unseen


def check_header_gaps(source, scratch, doxygen):
    """Checks that a header without a page, and a method without a comment, are found in a copy of the headers."""
    copy = scratch / "copy"
    shutil.rmtree(copy, ignore_errors=True)
    for header in public_headers(source) | {"Documentation/Doxyfile"}:
        (copy / header).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source / header, copy / header)
    unseen = []
    extra = copy / "Filters/vtkTIPPUndocumented.h"
    extra.write_text("class vtkTIPPUndocumented : public vtkObject\n{\n};\n", encoding="utf-8")
    if not gaps_in_headers(copy, copy, None):
        unseen.append("a header that no page is made of")
    extra.unlink()
    if doxygen:
        header = copy / "Filters/vtkTIPPDelaunay2D.h"
        text = header.read_text(encoding="utf-8")
        header.write_text(text.replace("\nprotected:", "\n  void SetNothing(int value);\n\nprotected:", 1),
                          encoding="utf-8")
        if not any("SetNothing" in gap for gap in gaps_in_headers(copy, copy, doxygen)):
            unseen.append("a method without a comment")
    return unseen


def main(arguments):
    on_purpose = arguments[:1] == ["--gaps"]
    source, scratch, *doxygen = arguments[1:] if on_purpose else arguments
    source, scratch, doxygen = pathlib.Path(source), pathlib.Path(scratch), (doxygen or [None])[0]
    scratch.mkdir(parents=True, exist_ok=True)
    if on_purpose:
        unseen = check_xml_gaps(source) + check_header_gaps(source, scratch, doxygen)
        sys.exit("not found: " + "; ".join(unseen) if unseen else 0)
    gaps = check(source, scratch, doxygen)
    sys.exit("\n".join(gaps) if gaps else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
