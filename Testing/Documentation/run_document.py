# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands that a Markdown file shows.

Usage: run_document.py SOURCE_DIR BUILD_DIR DOCUMENT SCRATCH_DIR

The blocks of a document are run in order, in a scratch copy of the tracked files, in one shell:

  ```sh                      run
    ```cpp, ```cmake, ```python  must equal the listing of a file in Examples/ (which tests run)
  ```text                    shown, not run

A document that names $DATA needs the real data sets in the folder TIPP_SHARED_DATA. A document that names
build-paraview/ needs the plugin, which must be built there. If one is missing, the test is skipped.

If a document runs configure, it uses this copy; otherwise the existing build is used as build/. A command that would
repeat the whole build or this test is replaced by a short form, see LIGHT. xvfb-run is replaced by display.py of the
ParaView tests, which starts one server at a time.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

FENCE = re.compile(r"^```(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LISTINGS = {"cpp", "cmake", "python"}
SKIPPED = 77

# Command (a pattern for one line), and what runs instead of it.
LIGHT = [
    (r"^pip install tipp$", r'export PYTHONPATH="$PWD/build/lib/python3/dist-packages" PATH="$PWD/build/bin:$PATH"'),
    (r"^python3 (?=Examples/)", r"/usr/bin/python3 "),
    (r"^sh Utilities/test\.sh$", r"sh Utilities/test.sh format"),
    (r"^sh Utilities/test\.sh build.*$", r"sh Utilities/test.sh format"),
    (r"^sh Utilities/(build\.sh (?:paraview|default .*)|paraview\.sh .*|package\.sh .*)$", r"sh -n Utilities/build.sh"),
    (r"^sh Utilities/test\.sh paraview$", r"sh Utilities/test.sh format"),
    (r"^(\w+=\S+ )*sh Utilities/benchmark\.sh.*$", r'for script in Utilities/benchmark.sh Utilities/benchmarks/*.sh; do sh -n "$script"; done'),
    (r"^(cmake --build --preset \S+)$", r"\1 -- -n"),
    (r"^(ctest --preset default -R .*)$", r"\1 -N --no-tests=error"),
    (r"^((?:xvfb-run -a )?ctest --preset (?!.* -N).*)$", r"\1 -N --no-tests=ignore"),
]


def fail(document, text, place, message):
    line = text.count("\n", 0, place) + 1
    sys.exit(f"{document}:{line}: {message}")


def examples(source):
    suffixes = {".cxx", ".py", ".txt"}
    return [p.read_text() for p in (source / "Examples").rglob("*") if p.suffix in suffixes]


def without_licence(text):
    return re.sub(r"\A(//|#) SPDX-License-Identifier:.*\n", "", text)


def script_of(source, document, text):
    """The document's commands as one script. Exits if a block is of an unknown kind."""
    known = [without_licence(t) for t in examples(source)]
    lines = ["set -eu"]
    for match in FENCE.finditer(text):
        kind, body = match.groups()
        if kind in LISTINGS:
            if body not in known:
                fail(document, text, match.start(), "this listing is no file of Examples/")
        elif kind == "sh":
            lines += [lighten(line) for line in body.splitlines()]
        elif kind != "text":
            fail(document, text, match.start(), f"a block is sh, cpp, cmake, python or text, not '{kind}'")
    return "\n".join(lines) + "\n"


def lighten(line):
    for pattern, replacement in LIGHT:
        line = re.sub(pattern, replacement, line)
    return line


def copy_tracked(source, scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    listing = subprocess.run(["git", "-C", source, "ls-files", "-z"], check=True,
                             capture_output=True, text=True).stdout
    for name in filter(None, listing.split("\0")):
        if (source / name).is_file():
            (scratch / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source / name, scratch / name)


def skip(reason):
    print(f"Skipped: {reason}")
    sys.exit(SKIPPED)


def needs(source, scratch, script):
    """Environment variables that the commands need. Exits if something that they need is missing."""
    settings = {}
    if "$DATA" in script:
        data = pathlib.Path(os.environ.get("TIPP_SHARED_DATA", ""))
        if not (data / "SOURCES.md").is_file():
            skip(f"there are no real data sets at '{data}'")
        settings["DATA"] = str(data)
    if "build-paraview/" in script:
        tree = source / "build-paraview"
        if not list(tree.glob("lib/paraview-*/plugins/TIPPPlugin/TIPPPlugin.so")):
            skip(f"{tree} has no plugin; build it: sh Utilities/build.sh paraview")
        (scratch / "build-paraview").symlink_to(tree)
    return settings


def locked_display(source, folder):
    """Writes a program xvfb-run into the folder."""
    folder.mkdir()
    program = folder / "xvfb-run"
    display = source / "Testing" / "ParaView" / "display.py"
    program.write_text(f'#!/bin/sh\n[ "$1" != -a ] || shift\nexec "{sys.executable}" "{display}" "$@"\n')
    program.chmod(0o755)


def environment(source, scratch, build, own_build):
    settings = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "DESTDIR")}
    # A git repository of its own, so that scripts that list tracked files list those of the scratch copy.
    subprocess.run(["git", "init", "-q", scratch], check=True)
    subprocess.run(["git", "-C", scratch, "add", "--all"], check=True)
    programs = scratch / ".git" / "programs"
    locked_display(source, programs)
    settings |= {"HOME": str(scratch), "TIPP_DEMO_POINTS": "20000",
                 "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}"}
    if not own_build:
        (scratch / "build").symlink_to(build)
        settings["TIPP_BUILD_DIR"] = str(build)
    return settings


def main():
    source, build, document, scratch = sys.argv[1:]
    source, build, scratch = (pathlib.Path(p).resolve() for p in (source, build, scratch))
    text = (source / document).read_text()
    script = script_of(source, document, text)
    copy_tracked(source, scratch)
    own_build = "cmake --preset" in script
    settings = environment(source, scratch, build, own_build) | needs(source, scratch, script)
    print(script, flush=True)
    sys.exit(subprocess.run(["sh", "-x", "-c", script], cwd=scratch, env=settings).returncode)


if __name__ == "__main__":
    main()
