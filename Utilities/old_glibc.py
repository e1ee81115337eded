# SPDX-License-Identifier: BSD-3-Clause
"""Makes a folder of libraries to link with, so that the result runs with an older release of the C library (glibc).

Usage: old_glibc.py COMPILER RELEASE FOLDER     (for example: old_glibc.py gcc 2.28 build/glibc)

Later releases keep every version of a symbol that earlier ones had. So the newest version up to RELEASE of each symbol of
the installed libraries is what RELEASE itself has. The libraries in FOLDER have these symbols and no code; a program that
needs a later symbol does not link. Link with -L FOLDER. old_glibc.c defines symbols that headers and libraries of later
releases use.
"""
import pathlib
import re
import subprocess
import sys

# The libraries that had these functions before release 2.34 moved them to libc.so.6.
MOVED = {"libpthread.so.0": re.compile(r"_*(pthread|sem)_"), "libdl.so.2": re.compile(r"dl(open|sym|vsym|error|close|addr|info)")}
LIBRARIES = ("libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def number_of(version):
    """GLIBC_2.2.5 as (2, 2, 5); None for private and other versions."""
    found = re.fullmatch(r"GLIBC_(\d+(?:\.\d+)+)", version)
    return found and tuple(map(int, found[1].split(".")))


def symbols_of(library, release):
    """For each symbol that the release has: its type and its newest version up to then."""
    symbols = {}
    for line in run("readelf", "--dyn-syms", "--wide", library).splitlines():
        found = re.search(r"\b(FUNC|IFUNC|OBJECT|TLS)\s+(?:GLOBAL|WEAK)\s+DEFAULT\s+\d+\s+(\S+?)@@?(\S+)", line)
        number = found and number_of(found[3])
        if number and number <= release and number > symbols.get(found[2], ((0,),))[0]:
            symbols[found[2]] = (number, found[3], found[1])
    return symbols


def make_library(compiler, folder, name, symbols):
    lines = [".text"]
    for i, (symbol, (_, version, kind)) in enumerate(sorted(symbols.items())):
        section = {"TLS": ".section .tbss,\"awT\",%nobits", "OBJECT": ".data"}.get(kind, ".text")
        kind = {"TLS": "%tls_object", "OBJECT": "%object"}.get(kind, "%function")
        lines += [section, f".globl symbol{i}", f".type symbol{i}, {kind}", f"symbol{i}: .skip 8", f".size symbol{i}, 8",
                  f".symver symbol{i}, {symbol}@@@{version}"]
    versions = sorted({(number, version) for number, version, _ in symbols.values()})
    source, script = folder / f"{name}.s", folder / f"{name}.map"
    source.write_text("\n".join([*lines, '.section .note.GNU-stack,"",%progbits', ""]))
    script.write_text("".join(f"{version} {{ }};\n" for _, version in versions))
    run(*compiler, "-shared", "-nostdlib", f"-Wl,-soname,{name}", f"-Wl,--version-script={script}", "-o", folder / name, source)


def main():
    compiler, release, folder = sys.argv[1].split(), tuple(map(int, sys.argv[2].split("."))), pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)

    def path_of(name):
        return run(*compiler, f"-print-file-name={name}").strip()

    # The compiler answers with the name itself if it has no such library.
    libraries = {name: symbols_of(path_of(name), release) for name in LIBRARIES if path_of(name) != name}
    for name, pattern in MOVED.items():
        moved = {symbol for symbol in libraries["libc.so.6"] if pattern.match(symbol)}
        libraries[name] = {symbol: libraries["libc.so.6"].pop(symbol) for symbol in moved}
    for name, symbols in libraries.items():
        if symbols:
            make_library(compiler, folder, name, symbols)
    made = folder / "old_glibc.o"
    run(*compiler, "-O2", "-std=c11", "-fPIC", "-fvisibility=hidden", "-ffunction-sections", "-fdata-sections",
        "-x", "c", "-c", pathlib.Path(__file__).with_suffix(".c"), "-o", made)
    archive = folder / "libold_glibc.a"
    archive.unlink(missing_ok=True)
    run(run(*compiler, "-print-prog-name=ar").strip(), "rcs", archive, made)
    others = [str(folder.resolve() / name) for name in libraries if name not in ("libc.so.6", "libm.so.6") and libraries[name]]
    (folder / "libm.so").write_text(f"INPUT({folder.resolve() / 'libm.so.6'})\n")
    (folder / "libc.so").write_text(f"GROUP({folder.resolve() / 'libc.so.6'} {archive.resolve()} {path_of('libc_nonshared.a')} "
                                    f"AS_NEEDED({' '.join(others)}))\n")


main()
