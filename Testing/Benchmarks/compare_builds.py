# SPDX-License-Identifier: BSD-3-Clause
"""Runs the same benchmarks alternately with two builds, and prints the ratio of their fastest times.

compare_builds.py OLD-BUILD NEW-BUILD INPUTS [--rows delaunay,io,resample] [--points N] [--rounds R]

INPUTS is a folder in which input files are kept. N is the number of points of the largest inputs. A row whose
ratio is above 1.02 is repeated with twice the rounds, so that one disturbed run does not look like a loss.
"""
import argparse
import pathlib
import re
import shutil
import subprocess


def delaunay_times(output):
    """TIPP's nanoseconds per point in a table of benchmarkDelaunay, by input, number of points and threads."""
    pattern = r"^(\S+)\s+(\d+)\s+TIPP, (\d) threads?\s+[\d.]+\s+([\d.]+)"
    return {f"{m[1]} {m[2]}, threads: {m[3]}": float(m[4]) for m in re.finditer(pattern, output, re.M)}


def loader_times(output):
    """The microseconds per cell in the table of loaders of benchmarkIo, by row and loader."""
    times = {}
    pattern = r"^(random|local)\s+(warm|cold)\s+(\S+)\s+(\d+)((?:\s+[\d.]+){7})"
    for m in re.finditer(pattern, output, re.M):
        columns = [float(value) for value in m[5].split()]
        for loader, column in (("direct", 0), ("fine", 1), ("auto, M", 4), ("auto", 6)):
            times[f"{m[1]} {m[2]} {m[3]} {m[4]}: {loader}"] = columns[column]
    return times


def named_times(output):
    """The times in lines such as `name: 1.5 s`, in seconds, by name."""
    return {m[1]: float(m[2]) for m in re.finditer(r"^(.+?): ([\d.]+) s\b", output, re.M) if not m[1].startswith("vtk")}


def table_times(output):
    """TIPP's first time in each row of a table, in seconds, by the text of the row's first cell."""
    times = {}
    for m in re.finditer(r"^\| ([^|]+?) \|(?: \d+ and \d+ \|)? ([\d.]+) s", output, re.M):
        times[re.sub(r"; of it.*", "", m[1])] = float(m[2])
    return times


def cases(rows, inputs, points):
    """The commands of the requested rows, each with the function that reads its output; {bin}: a build's bin folder."""
    large, mesh = inputs / f"mesh-{points}", inputs / f"local-{points}"
    delaunay = ["{bin}/benchmarkDelaunay", "--peers", "none", "--repeat", "1"]
    resample = ["{bin}/benchmarkResample"]
    if "delaunay" in rows:
        for kind in ("uniform", "clustered", "coast", "lattice", "lattice-jittered"):
            yield delaunay + ["--input", f"{kind}:{points}"], delaunay_times
        for count in (points // 10, 100_000, 10_000):
            yield delaunay + ["--repeat", "5", "--input", f"uniform:{count}"], delaunay_times
        for kind in ("collinear", "collinear-and-one", "circle", "spiral", "parabola", "two-clusters", "one-far-away",
                     "sorted", "survey-lines"):
            yield delaunay + ["--input", f"{kind}:{points // 10}"], delaunay_times
    if "io" in rows:
        yield ["{bin}/benchmarkIo", "loaders", "--repeat", "1", "--parts", "1,8", "--chunks", "4096,65536", large,
               mesh], loader_times
        yield ["{bin}/benchmarkIo", "reading", "--repeat", "1", inputs / f"{points}.vtu",
               inputs / "fine.tipp"], named_times
        yield ["{bin}/benchmarkIo", "borrowing", "--repeat", "1", inputs / "by-reference.tipp",
               inputs / "copied.tipp"], named_times
    if "resample" in rows:
        for kind, count, samples, part in (("local", points // 10, 2048, 1), ("uniform", points // 10, 2048, 1),
                                           ("clustered", points // 10, 2048, 1), ("uniform", points // 2, 1024, 0.01),
                                           ("tetrahedra", points // 18, 256, 1)):
            yield resample + [kind, str(count), str(samples), "1", str(part)], table_times
        yield resample + ["stored", inputs / "stored", str(points // 2), "1024", "1", "0.01"], table_times


def make_inputs(build, inputs, points):
    """The meshes that the rows of io read; they are made once."""
    tipp = build / "bin" / "tipp"
    repository = pathlib.Path(__file__).parent

    def run(*command):
        subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL)

    inputs.mkdir(parents=True, exist_ok=True)
    large, local = inputs / f"mesh-{points}", inputs / f"local-{points}"
    if not local.exists():
        for folder, first in ((large, [tipp, "points", "--distribution", "uniform", "--count", points // 2, "-o"]),
                              (local, ["/usr/bin/python3", repository / "hilbert-order.py", large / "points.npy"])):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            run(*first, folder / "points.npy")
            run(tipp, "delaunay", folder / "points.npy", "-o", folder / "cells.npy")
        run("/usr/bin/python3", repository / "flat-to-vtu.py", large, inputs / f"{points}.vtu")
        run(tipp, "partition", large, "-o", inputs / "fine.tipp", "--tiling", "grid:16x16")
        run(tipp, "partition", large, "-o", inputs / "by-reference.tipp", "--tiling", "grid:4x4")
        run(tipp, "partition", large, "-o", inputs / "copied.tipp", "--tiling", "grid:4x4", "--borrowers", "duplicate")
    (inputs / "stored").mkdir(exist_ok=True)


def compare(builds, command, read, rounds):
    """The fastest time of each build, by the names that `read` returns. The builds run alternately."""
    fastest = {}
    for turn in range(rounds):
        for which in (0, 1) if turn % 2 == 0 else (1, 0):
            line = [str(part).format(bin=builds[which] / "bin") for part in command]
            done = subprocess.run(line, check=True, capture_output=True, text=True)
            for row, time in read(done.stdout).items():
                times = fastest.setdefault(row, [float("inf"), float("inf")])
                times[which] = min(times[which], time)
    return {row: times for row, times in fastest.items() if max(times) < float("inf") and min(times) > 0}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("inputs", type=pathlib.Path)
    parser.add_argument("--rows", default="delaunay,io,resample")
    parser.add_argument("--points", type=int, default=10_000_000)
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    builds = (arguments.old.resolve(), arguments.new.resolve())
    make_inputs(builds[1], arguments.inputs, arguments.points)
    print(f"{'row':70} {'old':>10} {'new':>10}  new/old", flush=True)
    for command, read in cases(arguments.rows.split(","), arguments.inputs, arguments.points):
        rows = compare(builds, command, read, arguments.rounds)
        if any(new > 1.02 * old for old, new in rows.values()):
            for row, again in compare(builds, command, read, 2 * arguments.rounds).items():
                rows[row] = [min(pair) for pair in zip(rows.get(row, again), again)]
        for row, (old, new) in rows.items():
            print(f"{row:70} {old:10.4f} {new:10.4f}  {new / old:.3f}", flush=True)


if __name__ == "__main__":
    main()
