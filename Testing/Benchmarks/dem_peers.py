# SPDX-License-Identifier: BSD-3-Clause
"""Compares `tipp dem` with gdal_grid, startinpy and scipy, from a LAS file to a GeoTIFF, and within a memory limit.

Usage: dem_peers.py BINARIES AUTZEN.las FOLDER [--tile N] [--small N] [--large N] [--repeat R] [--part PART]...

BINARIES is the folder of tipp and benchmarkIo, PART is peers, read, same or large. Each program runs as a process from
file to file. Prints wall-clock and processor seconds, and the peak memory. Behind each ratio is its target. Peers
that are not installed are named and left out. The inputs stay in FOLDER for the next run.
"""
import argparse
import importlib.util
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import time

import numpy as np

HEADER = 227
RECORD = np.dtype([("x", "<i4"), ("y", "<i4"), ("z", "<i4"), ("intensity", "<u2"), ("returns", "u1"), ("class", "u1"),
                   ("angle", "i1"), ("user", "u1"), ("source", "<u2")])

SCIPY = """
import sys, laspy, numpy, rasterio, scipy.interpolate
las = laspy.read(sys.argv[1])
chosen = numpy.asarray(las.classification) == 2
x, y, z = (numpy.asarray(a)[chosen] for a in (las.x, las.y, las.z))
west, south, columns, rows, size = (float(a) for a in sys.argv[3:])
columns, rows = int(columns), int(rows)
gx = west + size * (numpy.arange(columns) + 0.5)
gy = south + size * (numpy.arange(rows) + 0.5)
surface = scipy.interpolate.LinearNDInterpolator(numpy.c_[x, y], z)
grid = numpy.vstack([surface(*numpy.meshgrid(gx, gy[i:i + 256])) for i in range(0, rows, 256)])
"""
STARTIN = """
import sys, laspy, numpy, rasterio, startinpy
las = laspy.read(sys.argv[1])
chosen = numpy.asarray(las.classification) == 2
west, south, columns, rows, size = (float(a) for a in sys.argv[3:])
columns, rows = int(columns), int(rows)
triangulation = startinpy.DT()
triangulation.insert(numpy.c_[las.x, las.y, las.z][chosen], insertionstrategy="BBox")
gx = west + size * (numpy.arange(columns) + 0.5)
gy = south + size * (numpy.arange(rows) + 0.5)
grid = numpy.vstack([numpy.asarray(triangulation.interpolate({"method": "TIN"}, numpy.c_[
    numpy.tile(gx, len(part)), numpy.repeat(part, columns)], strict=False)).reshape(len(part), columns)
    for part in (gy[i:i + 64] for i in range(0, rows, 64))])
"""
WRITE = """
with rasterio.open(sys.argv[2], "w", driver="GTiff", width=columns, height=rows, count=1, dtype="float32", nodata=-9999,
                   tiled=True, compress="deflate", predictor=3, zlevel=1, num_threads=2,
                   transform=rasterio.Affine(size, 0, west, 0, -size, south + rows * size)) as out:
    out.write(numpy.where(numpy.isnan(grid), -9999, grid).astype("float32")[::-1], 1)
"""


def make_tile(source, path, count, seed, column=0):
    """Writes jittered copies of the points side by side as LAS 1.2 of format 0. The tile is in the given column of
    tiles, counted from the west. Returns west, south, width and height. A file that exists is kept."""
    with open(source, "rb") as file:
        data = file.read()
    offset, length = struct.unpack_from("<I", data, 96)[0], struct.unpack_from("<H", data, 105)[0]
    number = struct.unpack_from("<I", data, 107)[0]
    raw = np.frombuffer(data, np.uint8, number * length, offset).reshape(number, length)
    points = np.zeros(number, RECORD)
    for name in RECORD.names:
        at = RECORD.fields[name][1]
        points[name] = raw[:, at:at + RECORD[name].itemsize].copy().view(RECORD[name])[:, 0]
    copies = -(-count // number)
    side = int(np.ceil(np.sqrt(copies)))
    low = [int(points[a].min()) for a in "xy"]
    step = [int(points[a].max()) - low[i] + 1 for i, a in enumerate("xy")]
    scale = struct.unpack_from("<3d", data, 131)
    width, height = side * step[0] * scale[0], -(-copies // side) * step[1] * scale[1]
    west, south = column * width, 0.0
    if not path.exists():
        random = np.random.default_rng(seed)
        header = bytearray(data[:HEADER])
        struct.pack_into("<HII", header, 94, HEADER, HEADER, 0)
        struct.pack_into("<BHI", header, 104, 0, RECORD.itemsize, count)
        struct.pack_into("<2d", header, 155, west, south)
        left = count
        unfinished = path.with_suffix(".unfinished")
        with open(unfinished, "wb") as file:
            file.write(header)
            for copy in range(copies):
                block = points[:left].copy()
                for i, axis in enumerate("xy"):
                    shift = (copy % side if i == 0 else copy // side) * step[i] - low[i]
                    block[axis] += shift + random.integers(-40, 41, len(block))
                file.write(block.tobytes())
                left -= len(block)
        unfinished.rename(path)
    return west, south, width, height


def make_tiles(options, folder, points):
    """The paths of four files side by side, the pixel size that makes as many pixels as points, and both extents."""
    count = points // 4
    paths = [folder / f"part-{count}-{i}.las" for i in range(4)]
    for number, path in enumerate(paths):
        _, _, width, height = make_tile(options.autzen, path, count, number, number)
    return paths, round(float(np.sqrt(4 * width * height / points)), 3), width * 4, height


def measure(command, repeat=1):
    """Wall-clock and processor seconds of the fastest run, and its memory in MB; None if it fails."""
    best = None
    for _ in range(repeat):
        start = time.perf_counter()
        process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.perf_counter() - start
        if status != 0:
            return None
        run = seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e3
        best = run if best is None or run[0] < best[0] else best
    return best


def row(name, run, ours=None, asked=None):
    if run is None:
        print(f"{name:44} failed", flush=True)
        return
    ratio = f" {run[0] / ours[0]:7.2f} x {run[1] / ours[1]:7.2f} x of processor" if ours else ""
    print(f"{name:44} {run[0]:8.2f} s {run[1]:8.2f} s of processor {run[2]:8.0f} MB{ratio}" +
          (f" (asked: {asked})" if asked else ""), flush=True)


def beside_peers(options, folder):
    path = folder / f"tile-{options.tile}.las"
    west, south, width, height = make_tile(options.autzen, path, options.tile, 1)
    size = round(float(np.sqrt(width * height / (1.5 * options.tile))), 3)
    columns, rows = int(width / size), int(height / size)
    bounds = [west, west + columns * size, south, south + rows * size]
    print(f"{options.tile} points, those of class 2 to {columns} x {rows} pixels, two threads")
    output, first = folder / "out.tif", folder / "ours.tif"
    ours = measure([options.tipp, "dem", path, "-o", first, "--class", 2, "--resolution", size, "--align", "bounds",
                    "--threads", 2, "--bounds", *bounds], options.repeat)
    row("tipp dem", ours)
    if ours is None:
        sys.exit(1)
    for name, script, asked in (("startinpy", STARTIN, 15), ("scipy", SCIPY, 25)):
        missing = [m for m in ("laspy", "rasterio", name) if importlib.util.find_spec(m) is None]
        if missing:
            print(f"{name}: left out, {', '.join(missing)} is not installed")
        else:
            row(name, measure([sys.executable, "-c", script + WRITE, path, output, west, south, columns, rows, size]), ours,
                f"{asked} x")
            compare(first, output)
    if shutil.which("gdal_grid") is None:
        print("gdal_grid: left out, it is not installed")
    else:
        row("gdal_grid (linear, from .csv)", measure(gdal_command(options, folder, path, output, bounds, columns, rows)), ours,
            "18 x")
        compare(first, output)
    output.unlink(missing_ok=True)
    first.unlink(missing_ok=True)


def compare(ours, theirs):
    """Prints how many pixels of a peer agree with ours."""
    if importlib.util.find_spec("rasterio") is None:
        return
    import rasterio

    with rasterio.open(ours) as a, rasterio.open(theirs) as b:
        a, b = a.read(1), b.read(1)
    both = (a != -9999) & (b != -9999)
    near = np.abs(a[both] - b[both]) < 0.01
    print(f"    pixels with a value: {(a != -9999).sum()} and {(b != -9999).sum()}, in both {both.sum()}, of these "
          f"{100 * near.mean() if both.any() else 0:.2f} % within 0.01", flush=True)


def gdal_command(options, folder, path, output, bounds, columns, rows):
    """gdal_grid does not read LAS: writes the ground points as .csv, which is not timed."""
    ground = folder / f"ground-{options.tile}.csv"
    data = np.fromfile(path, RECORD, offset=HEADER)
    data = data[data["class"] & 31 == 2]
    with open(path, "rb") as file:
        header = file.read(HEADER)
    scale, origin = struct.unpack_from("<3d", header, 131), struct.unpack_from("<3d", header, 155)
    np.savetxt(ground, np.c_[tuple(data[a] * scale[i] + origin[i] for i, a in enumerate("xyz"))], "%.2f", ",", header="x,y,z",
               comments="")
    vrt = folder / "ground.vrt"
    vrt.write_text(f"""<OGRVRTDataSource><OGRVRTLayer name="ground"><SrcDataSource>{ground}</SrcDataSource>
<SrcLayer>{ground.stem}</SrcLayer>
<GeometryType>wkbPoint</GeometryType><GeometryField encoding="PointFromColumns" x="x" y="y" z="z"/>
</OGRVRTLayer></OGRVRTDataSource>""")
    return ["gdal_grid", "-q", "--config", "GDAL_NUM_THREADS", "ALL_CPUS", "-a", "linear:radius=0:nodata=-9999", "-ot",
            "Float32", "-of", "GTiff", "-co", "TILED=YES", "-co", "COMPRESS=DEFLATE", "-txe", bounds[0], bounds[1], "-tye",
            bounds[3], bounds[2], "-outsize", columns, rows, vrt, output]


ALL = ["--keep", "overlap,synthetic,withheld", "--threads", 2]


def read_rate(options, folder):
    paths, *_ = make_tiles(options, folder, options.small)
    for threads in (1, 2):
        print(f"Reading {options.small // 4} points of LAS on {threads} threads (target: 15 million per second and thread)", flush=True)
        subprocess.run([options.binaries / "benchmarkIo", "points", "--threads", str(threads), paths[0]], check=True)


def same_pixels(options, folder):
    paths, size, width, height = make_tiles(options, folder, options.small)
    print(f"{options.small} points in four LAS files to {int(width / size)} x {int(height / size)} pixels")
    outputs = []
    for memory in ("128M", "4G"):
        outputs.append(folder / f"out-{memory}.tif")
        run = measure([options.tipp, "dem", *paths, "-o", outputs[-1], "--resolution", size, *ALL, "--memory", memory])
        row(f"tipp dem --memory {memory}", run)
        if run is None:
            sys.exit(1)
    is_same = subprocess.run(["cmp", *outputs]).returncode == 0
    print("the files are equal" if is_same else "the files DIFFER")
    for output in outputs:
        output.unlink()
    if not is_same:
        sys.exit(1)


def large(options, folder):
    paths, size, width, height = make_tiles(options, folder, options.large)
    keep = [*ALL, "--memory", "512M"]
    print(f"{options.large} points in four LAS files to {int(width / size)} x {int(height / size)} pixels in 512 MB")
    counted = measure([options.tipp, "delaunay", *paths, "-o", folder / "out.tipp", "--sink", "count", *keep])
    row("tipp delaunay --sink count", counted)
    row("tipp dem", measure([options.tipp, "dem", *paths, "-o", folder / "out.tif", "--resolution", size, *keep]), counted,
        "1.6 x, and below 300 s for 500 million")
    (folder / "out.tif").unlink(missing_ok=True)


PARTS = {"peers": beside_peers, "read": read_rate, "same": same_pixels, "large": large}


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("autzen")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--tile", type=int, default=15_000_000)
    parser.add_argument("--small", type=int, default=100_000_000)
    parser.add_argument("--large", type=int, default=500_000_000)
    parser.add_argument("--repeat", type=int, default=2)
    parser.add_argument("--part", action="append", choices=PARTS)
    options = parser.parse_args()
    options.tipp = options.binaries / "tipp"
    for part in options.part or PARTS:
        PARTS[part](options, options.folder)


if __name__ == "__main__":
    main()
