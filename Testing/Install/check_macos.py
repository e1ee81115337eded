# SPDX-License-Identifier: BSD-3-Clause
"""Checks that macOS's compiler accepts the core: compiles its sources with clang and the headers of macOS.

Usage: check_macos.py TOP SOURCE...

Both come with PyPI's package ziglang. Without it, nothing is checked and the exit status is 77.
"""
import concurrent.futures
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

MODULES = ("Accelerators", "IO", "Filters")
# Headers that do not depend on the system.
OTHERS = ("nlohmann", "xxhash.h", "CLI", "fmt")


def make_includes(folder):
    """What CMake makes, and links to headers of other projects: the folder they are in has those of this system, too."""
    for module in MODULES:
        name = f"VTKTIPP{module.upper()}"
        (folder / f"vtkTIPP{module}Module.h").write_text(f"#define {name}_EXPORT\n#define {name}_NO_EXPORT\n")
    for name in OTHERS:
        (folder / name).symlink_to(pathlib.Path("/usr/include") / name)


def compile_source(source, top, scratch):
    """Returns the compiler's messages; empty if it accepts the source."""
    command = [sys.executable, "-m", "ziglang", "c++", "-target", "aarch64-macos", "-std=c++17", "-c", "-O0", "-Wall",
               "-Wextra", "-Werror", "-DTIPP_WITHOUT_VTK", "-DTIPP_CHECK_WITHOUT_GMP", "-isystem", str(scratch),
               "-DFMT_HEADER_ONLY", "-DTIPP_VERSION=\"0\"",
               *(f"-I{top / module}" for module in (*MODULES, "Tools")),
               source, "-o", f"{scratch}/{source.stem}.o"]
    environment = {**os.environ, "ZIG_GLOBAL_CACHE_DIR": f"{scratch}/cache", "ZIG_LOCAL_CACHE_DIR": f"{scratch}/cache"}
    result = subprocess.run(command, capture_output=True, text=True, env=environment)
    return result.stderr or "failed" if result.returncode else ""


def main():
    if not importlib.util.find_spec("ziglang"):
        print("Skipped: PyPI's package ziglang is not installed.")
        return 77
    top, *sources = map(pathlib.Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        make_includes(pathlib.Path(scratch))
        messages = list(threads.map(lambda source: compile_source(source, top, scratch), sources))
    for source, message in zip(sources, messages):
        if message:
            print(f"== {source}\n{message}")
    print(f"{len(sources)} sources, {sum(map(bool, messages))} of which macOS's compiler refuses.")
    return 1 if not sources or any(messages) else 0


sys.exit(main())
