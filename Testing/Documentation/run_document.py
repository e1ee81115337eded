# SPDX-License-Identifier: BSD-3-Clause
"""Runs what a Markdown file tells its readers to type.

Usage: run_document.py SOURCE_DIR BUILD_DIR DOCUMENT SCRATCH_DIR

The blocks of a document are run in order, in a scratch copy of the tracked files, in one shell:

  ```sh                      run
  ```cpp, ```cmake, ```python  the listing of a file in Examples/, word for word (which the tests run)
  ```text                    shown, not run

A document that configures is run on that copy, any other on the build at hand as build/. A command
that would repeat the whole build or this test is run in its light form, see LIGHT.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

FENCE = re.compile(r"^```(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LISTINGS = {"cpp", "cmake", "python"}

# Command (a pattern over one line), and what runs in its place.
LIGHT = [
    (r"^sh Utilities/test\.sh$", r"sh Utilities/test.sh format"),
    (r"^sh Utilities/test\.sh build.*$", r"sh Utilities/test.sh format"),
    (r"^sh Utilities/benchmark\.sh.*$", r'for script in Utilities/benchmark.sh Utilities/benchmarks/*.sh; do sh -n "$script"; done'),
    (r"^(cmake --build --preset \S+)$", r"\1 -- -n"),
    (r"^((?:xvfb-run -a )?ctest --preset .*)$", r"\1 -N --no-tests=ignore"),
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
    """The document's commands as one script; exits if a block is of no known kind."""
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


def environment(scratch, build, own_build):
    settings = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "DESTDIR")}
    # A repository of its own: scripts that ask git for the tracked files get the scratch copy's.
    subprocess.run(["git", "init", "-q", scratch], check=True)
    subprocess.run(["git", "-C", scratch, "add", "--all"], check=True)
    settings |= {"HOME": str(scratch), "TIPP_DEMO_POINTS": "20000"}
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
    settings = environment(scratch, build, own_build)
    print(script, flush=True)
    sys.exit(subprocess.run(["sh", "-x", "-c", script], cwd=scratch, env=settings).returncode)


if __name__ == "__main__":
    main()
