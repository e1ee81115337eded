# SPDX-License-Identifier: BSD-3-Clause
"""Damages input files of every format that a command reads. Each command must succeed, or end with a clear message and
exit code 1 or 2, within 2 GB of memory, files of 256 MB and 20 s. The ids of a mesh that it writes must be in range."""
import concurrent.futures
import functools
import os
import pathlib
import re
import resource
import shutil
import struct
import subprocess
import sys

import campaign
import seeds

MUTANTS = 40  # per trial
AT_ONCE = 2
SECONDS = 20
MEMORY = 2 << 30
FILE = 256 << 20  # so that images of distant points do not take longer to write than the time limit
HOSTILE = ["-1", "0", "1", "4", "255", "4294967296", "4294967299", "999999999999", "9000000000000000000",
           "18446744073709551616", "nan", "inf", "-inf", "1e308", "-1e308", "1e-320", "", "x", "2147483647", "-2147483648"]
NUMBER = re.compile(rb"[-+]?[0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?")
ATTRIBUTE = re.compile(rb'([A-Za-z_]+)="([^"]*)"')
TEMPORARY = re.compile(r"\.tmp\.")


def flip(random, data):
    at = random.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << random.randrange(8)]) + data[at + 1:]


def change(random, data):
    at = random.randrange(len(data))
    return data[:at] + random.choice([b"\x00", b"\xff", b"\x80", b" ", b"-", b"9", b"\n"]) + data[at + 1:]


def word(random, data):
    """Replaces four or eight bytes by a hostile number, mostly at a multiple of that many bytes."""
    size, code = random.choice([(4, "i"), (8, "q"), (8, "d"), (4, "f")])
    values = [-1, 0, 16, 2**31 - 1, -2**31] if size == 4 else [-1, 0, 16, 2**32, 2**32 + 3, 999999999999, 2**62, -2**63]
    if code in "df":
        values = [float("nan"), float("inf"), -1.0, 1e300 if code == "d" else 1e30, 0.0]
    at = random.randrange(max(len(data) - size, 1))
    return data[:at] + struct.pack(random.choice("<>") + code, random.choice(values)) + data[at + size:]


def cut(random, data):
    return data[:random.randrange(len(data))]


def block(random, data):
    begin = random.randrange(len(data))
    return begin, min(len(data), begin + random.choice([1, 4, 8, 64, 512]))


def drop(random, data):
    begin, end = block(random, data)
    return data[:begin] + data[end:]


def repeat(random, data):
    begin, end = block(random, data)
    return data[:end] + data[begin:end] * random.choice([1, 1, 50]) + data[end:]


def swap(random, data):
    a, b = block(random, data)
    c, d = block(random, data)
    return data if c < b else data[:a] + data[c:d] + data[b:c] + data[a:b] + data[d:]


def replace_number(random, data):
    found = list(NUMBER.finditer(data[:20000]))
    if not found:
        return flip(random, data)
    match = random.choice(found)
    return data[:match.start()] + random.choice(HOSTILE).encode() + data[match.end():]


def change_attribute(random, data):
    found = list(ATTRIBUTE.finditer(data[:20000]))
    if not found:
        return replace_number(random, data)
    match = random.choice(found)
    value = random.choice(HOSTILE + ["Float32", "Int8", "String", "Int64", "appended", "ascii", "binary", "points"]).encode()
    if random.random() < 0.2:
        return data[:match.start()] + data[match.end():]
    return data[:match.start(2)] + value + data[match.end(2):]


def delete_line(random, data):
    lines = data.split(b"\n")
    del lines[random.randrange(len(lines))]
    return b"\n".join(lines)


MUTATIONS = [flip, change, word, cut, drop, repeat, swap, delete_line] + 4 * [replace_number] + 3 * [change_attribute]


def mutate(random, data):
    for _ in range(random.choice([1, 1, 1, 2, 3])):
        data = random.choice(MUTATIONS)(random, data) if data else data
    return data


@functools.lru_cache(maxsize=None)
def partitioned(tipp):
    """The contents of the files of a partitioned mesh, by relative path."""
    import tempfile
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "mesh.vtu"
        source.write_bytes(seeds.vtu(seeds.SURFACE, "raw"))
        subprocess.run([tipp, "partition", source, "-o", f"{folder}/mesh.tipp", "--tiling", "grid:2x2"], check=True,
                       capture_output=True)
        return campaign.contents(f"{folder}/mesh.tipp")


def write_folder(folder, files):
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)


def make_input(random, folder, tipp):
    """Writes a mutant. Returns its path, and whether the format has cells."""
    kind = random.random()
    if kind < 0.12:
        files = seeds.flat_folder() if random.random() < 0.5 else partitioned(tipp)
        name = random.choice(sorted(files))
        path = folder / ("flat" if "cells.npy" in files else "mesh.tipp")
        write_folder(path, {**files, name: mutate(random, files[name])})
        return path, True
    if kind < 0.2:
        piece = seeds.vtu(seeds.SURFACE, random.choice(["raw", "zlib"]))
        whole = seeds.pvtu("piece.vtu")
        first = random.random() < 0.7
        (folder / "piece.vtu").write_bytes(piece if first else mutate(random, piece))
        (folder / "mesh.pvtu").write_bytes(mutate(random, whole) if first else whole)
        return folder / "mesh.pvtu", True
    files = seeds.points() if kind < 0.36 else seeds.meshes()
    name = random.choice(sorted(files))
    path = folder / name
    path.write_bytes(mutate(random, files[name]))
    return path, kind >= 0.36


def make_command(random, path, has_cells, folder):
    """The arguments of `tipp`, and the output of the command."""
    is_file = path.is_file()
    choices = ["delaunay", "delaunay", "dem", "info", "like", "store"] if is_file else []
    choices += ["check"] if is_file else []
    choices += ["resample", "resample", "partition", "flatten"] if has_cells else []
    command = random.choice(choices)
    if command == "delaunay":
        out = folder / random.choice(["out.npy", "out.npy", "out.vtu", "out.vtp"])
        return ["delaunay", path, "-o", out], out
    if command == "store":
        return ["delaunay", path, "-o", folder / "out.tipp"], folder / "out.tipp"
    if command == "dem":
        where = ["--resolution", "0.5", "--bounds", "0", "4", "0", "4"]
        return ["dem", path, "-o", folder / random.choice(["out.npy", "out.vti", "out.tif"]), *where,
                *random.choice([[], ["--memory", "8M"]])], None
    if command == "info":
        return ["info", path], None
    if command == "like":
        return ["points", "--like", path, "--count", "20", "-o", folder / "out.npy"], None
    if command == "check":
        return ["check", path, path], None
    if command == "partition":
        return ["partition", path, "-o", folder / "out.tipp", "--tiling", random.choice(["grid:2x2", "quadtree:10"])], folder / "out.tipp"
    if command == "flatten":
        return ["flatten", path, "-o", folder / "out"], folder / "out"
    words = ["resample", path, "-o", folder / "out.vti"]
    words += random.choice([["--dims", "8", "8", "1"], ["--dims", "4", "4", "4"], ["--delta", "0.5", "0.5", "0.5"],
                            ["--dims", "6", "0", "0"]])
    words += random.choice([[], ["--bounds", "0", "2", "0", "2", "0", "1"]])
    words += random.choice([["--device", "openmp"]] * 9 + [["--device", "opencl"]])
    words += ["--no-data", "1"] if random.random() < 0.1 else []
    return words, None


def read_npy(path):
    """The shape and the values of an array of integers."""
    data = path.read_bytes()
    size = struct.unpack("<H", data[8:10])[0]
    header = eval(data[10:10 + size].decode(), {"__builtins__": {}})  # the file was written by tipp
    code = {"i8": "q", "i4": "i", "u4": "I"}.get(header["descr"][1:])
    body = data[10 + size:]
    return header["shape"], struct.unpack(f"<{len(body) // struct.calcsize(code)}{code}", body) if code else None


def require_ids(result, ids, points):
    if ids and (min(ids) < 0 or max(ids) >= points):
        raise campaign.Failure(f"{result}\n  wrote ids from {min(ids)} to {max(ids)} for {points} points")


def check_output(result, out, tipp, env):
    if out is None:
        return
    if out.suffix == ".npy":
        points = int(re.search(r"^(\d+) points", result.output, re.MULTILINE).group(1))
        require_ids(result, read_npy(out)[1], points)
    elif out.suffix == ".tipp":
        image = ["resample", out, "-o", out.parent / "again.npy", "--arrays", "GlobalCellIds", "--dims", "4", "4", "1"]
        campaign.require_clear_end(run([tipp] + image, env))
    elif not out.suffix:
        require_ids(result, read_npy(out / "cells.npy")[1], read_npy(out / "points.npy")[0][0])
    else:
        flat = out.parent / "flattened"
        again = run([tipp, "flatten", out, "-o", flat], env)
        if again.code == 0:
            check_output(again, flat, tipp, env)
        elif "no cells with an area" not in again.error:
            raise campaign.Failure(f"{result}\n  but then {again}")


def run(command, env):
    return campaign.run(command, timeout=SECONDS, memory=None, env=env)


def mutant(job):
    words, out, tipp, env = job
    result = run([tipp] + words, env)
    if words[0] == "check" and (result.code == 1 and "FAULTY" in result.output
                                or result.code == 3 and "cannot decide" in result.output):
        return
    campaign.require_clear_end(result)
    if TEMPORARY.search(result.error):
        raise campaign.Failure(f"{result}\n  its message names a temporary file")
    lines = result.error.strip().splitlines()
    if result.code != 0 and (not lines[-1].startswith("tipp") or not lines[-1].endswith(".")):
        raise campaign.Failure(f"{result}\n  its message is not one sentence")
    if result.code == 0:
        check_output(result, out, tipp, env)


def trial(random, folder, tools):
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.RLIM_INFINITY))  # the commands inherit the limit
    resource.setrlimit(resource.RLIMIT_FSIZE, (FILE, resource.RLIM_INFINITY))
    env = {**os.environ, "OMP_NUM_THREADS": "2"}
    jobs = []
    for number in range(MUTANTS):
        place = folder / str(number)
        place.mkdir()
        path, has_cells = make_input(random, place, tools.tipp)
        jobs.append((*make_command(random, path, has_cells, place), tools.tipp, env))
    failures = []
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
        for job in [pool.submit(mutant, job) for job in jobs]:
            try:
                job.result()
            except campaign.Failure as failure:
                failures.append(str(failure))
    if failures:
        if os.environ.get("TIPP_KEEP_MUTANTS"):
            shutil.copytree(folder, pathlib.Path(os.environ["TIPP_KEEP_MUTANTS"]) / folder.name, dirs_exist_ok=True)
        raise campaign.Failure(f"{len(failures)} of {MUTANTS} mutants:\n" + "\n".join(failures))
    return len(jobs)


if __name__ == "__main__":
    sys.exit(campaign.main("mutants", trial, __doc__))
