# SPDX-License-Identifier: BSD-3-Clause
"""Compares decoding of LAZ with lazrs and LASzip, and a raster from LAZ with the same from LAS.

Usage: laz_peers.py BINARIES FOLDER [--tile N] [--large N] [--repeat R] [--part PART]...

BINARIES is the folder of tipp and benchmarkIo, PART is decode, threads, peers or large. The inputs, made by laz_tile.py,
stay in FOLDER. Needs laspy with lazrs; laszip, startinpy, scipy and rasterio are left out if they are not installed.
Programs run by turns, so that a busy machine slows all alike; a ratio is that of the medians.
"""
import argparse
import importlib.util
import math
import pathlib
import shutil
import statistics
import struct
import subprocess
import sys

import dem_peers

TILE = pathlib.Path(__file__).with_name("laz_tile.py")
REPEATED = 2  # decodings of a process; the fastest counts

PEER = """
import struct, sys, time, laspy, numpy
path, backend, kind, repeat = sys.argv[1:]
selection = laspy.DecompressionSelection.base().decompress_z().decompress_classification()
if kind == "all":
    selection = laspy.DecompressionSelection.all()
with laspy.open(path) as file:
    header, backend = file.header, laspy.LazBackend[backend]
for _ in range(int(repeat)):
    with laspy.open(path, laz_backend=backend, decompression_selection=selection) as file:
        decoder = file.point_source
        start = time.process_time()
        left = header.point_count
        while left:
            count = min(left, 1000000)
            decoder.read_n_points(count)
            left -= count
        print(kind, header.point_count, "points", 0, "s", time.process_time() - start, "s")
"""


def tile(options, number, points, name):
    path = options.folder / f"{name}-{number}-{points}.laz"
    if not path.exists():
        subprocess.run([sys.executable, TILE, str(number), str(points), path], check=True)
    return path


def seconds_of(command):
    """The least wall-clock and processor seconds that each kind of decoding took, by its name."""
    lines = subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout.splitlines()
    best = {}
    for line in lines:
        kind, _, _, wall, _, processor, *_ = line.split()
        run = float(processor), float(wall)
        best[kind] = min(best.get(kind, run), run)
    return best


def decode(options):
    backends = ["Lazrs"] + (["Laszip"] if importlib.util.find_spec("laszip") else [])
    for number in (6, 3):
        path = tile(options, number, options.tile, "tile")
        runs = {}
        for _ in range(options.repeat):
            ours = seconds_of([options.binaries / "benchmarkIo", "laz", "--threads", 1, "--repeat", REPEATED, path])
            for kind in ("some", "all"):
                runs.setdefault(("TIPP", kind), []).append(ours[kind][0])
                for backend in backends:
                    peer = seconds_of([sys.executable, "-c", PEER, path, backend, kind, REPEATED])
                    runs.setdefault((backend, kind), []).append(peer[kind][0])
        print(f"{options.tile} points of format {number}, {path.stat().st_size / options.tile:.2f} bytes a point; median of "
              f"{options.repeat} runs by turns, one thread")
        for (name, kind), processor in runs.items():
            middle = statistics.median(processor)
            ratio = middle / statistics.median(runs["TIPP", kind])
            what = "x, y, z, classes, returns" if kind == "some" else "all"
            print(f"  {name:8} {what:26} {options.tile / middle / 1e6:6.2f} million points per processor second, "
                  f"{ratio:5.2f} times our time", flush=True)


def threads(options):
    for number in (6, 3):
        path = tile(options, number, options.tile, "tile")
        runs = {1: [], 2: []}
        for _ in range(options.repeat):
            for count in runs:
                times = seconds_of([options.binaries / "benchmarkIo", "laz", "--threads", count, "--repeat", REPEATED, path])
                runs[count].append(times["some"][1])
        one, two = (statistics.median(runs[count]) for count in (1, 2))
        print(f"format {number}, x, y, z, classes, returns: two threads are {one / two:.2f} times as fast as one "
              f"(fastest runs: {min(runs[1]) / min(runs[2]):.2f})", flush=True)


def peers(options):
    """From a file to a raster: our processor time a point beside that of laspy, startinpy or scipy, and rasterio."""
    path = tile(options, 6, options.tile // 10, "tile")
    info = subprocess.run([options.tipp, "info", path], check=True, capture_output=True, text=True).stdout
    box = {line.split()[0]: [float(line.split()[1]), float(line.split()[3])] for line in info.splitlines()
           if line.split()[0] in ("x", "y")}
    west, south = box["x"][0], box["y"][0]
    width, height = box["x"][1] - west, box["y"][1] - south
    size = round(float((width * height / options.tile * 10) ** 0.5), 3)
    columns, rows = int(width / size), int(height / size)
    bounds = [west, west + columns * size, south, south + rows * size]
    output = options.folder / "out.tif"
    ours = dem_peers.measure([options.tipp, "dem", path, "-o", output, "--class", 2, "--resolution", size, "--align", "bounds",
                              "--threads", 2, "--bounds", *bounds], options.repeat)
    print(f"{options.tile // 10} points, those of class 2 to {columns} x {rows} pixels")
    dem_peers.row("tipp dem", ours)
    for name, script in (("startinpy", dem_peers.STARTIN), ("scipy", dem_peers.SCIPY)):
        missing = [m for m in ("laspy", "lazrs", "rasterio", name) if importlib.util.find_spec(m) is None]
        if missing:
            print(f"{name}: left out, {', '.join(missing)} is not installed")
        else:
            dem_peers.row(f"laspy, {name}, rasterio", dem_peers.measure(
                [sys.executable, "-c", script + dem_peers.WRITE, path, output, west, south, columns, rows, size]), ours, "5 x")
    output.unlink(missing_ok=True)


def copies(path, count):
    """Copies of a tile side by side, which differ in the header's offsets and box; their width and height together."""
    with open(path, "rb") as file:
        header = bytearray(file.read(227))
    offset, box = struct.unpack_from("<2d", header, 155), struct.unpack_from("<4d", header, 179)
    width, height = box[0] - box[1] + 1, box[2] - box[3] + 1
    side = math.ceil(math.sqrt(count))
    paths = []
    for i in range(count):
        east, north = i % side * width, i // side * height
        struct.pack_into("<2d", header, 155, offset[0] + east, offset[1] + north)
        struct.pack_into("<4d", header, 179, box[0] + east, box[1] + east, box[2] + north, box[3] + north)
        paths.append(path.with_name(f"{path.stem}-copy{i}{path.suffix}"))
        shutil.copyfile(path, paths[-1])
        with open(paths[-1], "r+b") as file:
            file.write(header)
    return paths, side * width, math.ceil(count / side) * height


def large(options):
    """A raster of as many pixels as points within 512 MB, from LAZ and from LAS: the tile side by side."""
    laz = tile(options, 6, options.tile, "tile")
    las = laz.with_suffix(".las")
    if not las.exists():
        subprocess.run([options.tipp, "points", laz, "-o", las], check=True)
    count = math.ceil(options.large / options.tile)
    times = {}
    for kind, path in (("las", las), ("laz", laz)):
        paths, width, height = copies(path, count)
        size = round(math.sqrt(width * height / (count * options.tile)), 3)
        times[kind] = dem_peers.measure([options.tipp, "dem", *paths, "-o", options.folder / f"out-{kind}.tif", "--resolution",
                                         size, "--memory", "512M", "--threads", 2])
        dem_peers.row(f"tipp dem, {count * options.tile} points of .{kind}", times[kind], times["las"], "1.35 x")
        for copy in paths:
            copy.unlink()
    first, second = (options.folder / f"out-{kind}.tif" for kind in ("las", "laz"))
    is_same = first.read_bytes() == second.read_bytes()
    print("the files are equal" if is_same else "the files DIFFER")
    first.unlink()
    second.unlink()
    if not is_same:
        sys.exit(1)


PARTS = {"decode": decode, "threads": threads, "peers": peers, "large": large}


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--tile", type=int, default=20_000_000)
    parser.add_argument("--large", type=int, default=500_000_000)
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--part", action="append", choices=PARTS)
    options = parser.parse_args()
    options.tipp = options.binaries / "tipp"
    for part in options.part or PARTS:
        PARTS[part](options)


if __name__ == "__main__":
    main()
