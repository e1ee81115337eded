# SPDX-License-Identifier: BSD-3-Clause
"""Compares results in memory, out of core and on ranks, for random points and constraints.

Points have duplicates, lie on lattices, lines and circles, and may not be finite. Constraints meet points, cross and
overlap each other. Rasters must be equal byte for byte, and meshes must have the same triangles. A command that fails
must fail in each of these ways. TIPP_KEEP_FAILURES names a folder for the inputs of failed trials.
"""
import ast
import math
import os
import pathlib
import shutil
import struct
import sys

import campaign

ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="2", OMPI_ALLOW_RUN_AS_ROOT="1",
                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_mpi_yield_when_idle="1")


def make_points(rng, most):
    """Random x and y of one of several kinds, about `most` of them at most."""
    count = rng.choice((rng.randint(1, 12), rng.randint(10, 300), rng.randint(300, most)))
    side = rng.choice((1, 10, 100, 1000, 0.1))
    kind = rng.choice(("uniform", "lattice", "line", "clusters", "circles", "decimal"))
    points = []
    while len(points) < count:
        if kind == "lattice":
            steps = max(2, int(math.sqrt(count)))
            p = (rng.randint(0, steps) * side / 8, rng.randint(0, steps) * side / 8)
        elif kind == "line":
            at = rng.randint(0, count)
            p = (at * side / 4, at * side / 2 if rng.random() < 0.97 else rng.random() * side)
        elif kind == "clusters":
            p = tuple(side * (rng.randint(0, 3) + rng.random() ** 6) for _ in range(2))
        elif kind == "circles":
            a, b = rng.choice(((3, 4), (4, 3), (5, 0), (0, 5)))
            ring = rng.randint(1, 40)
            p = (rng.choice((-1, 1)) * a * ring * side, rng.choice((-1, 1)) * b * ring * side)
        elif kind == "decimal":
            p = (round(side * rng.random(), 2), round(side * rng.random(), 2))
        else:
            p = (side * rng.random(), side * rng.random())
        points.append(p)
    for _ in range(rng.choice((0, 0, count // 10, count // 2))):  # duplicates
        points.append(rng.choice(points))
    rng.shuffle(points)
    return points


def write_points(rng, path, most):
    """Writes a file of points, some of which are not finite. Returns x and y as they were before."""
    points = make_points(rng, most)
    has_bad = rng.random() < 0.3
    with open(path, "w", encoding="ascii") as file:
        file.write("x,y,z,w\n")
        for x, y in points:
            z = rng.choice((rng.randint(0, 9), rng.random()))
            values = [repr(float(x)), repr(float(y)), repr(z), str(rng.randint(0, 99))]
            if has_bad and rng.random() < 0.02:
                values[rng.randint(0, 2)] = rng.choice(("nan", "inf", "-inf"))
            file.write(",".join(values) + "\n")
    return points


def end_of(rng, points):
    """An end of a constraint: at a point, between two, or anywhere."""
    (ax, ay), (bx, by) = rng.choice(points), rng.choice(points)
    where = rng.random()
    if where < 0.6:
        return ax, ay
    if where < 0.75:
        return (ax + bx) / 2, (ay + by) / 2
    beyond = 3 if rng.random() < 0.1 else 1
    return ax + beyond * (bx - ax) * rng.random(), ay + beyond * (by - ay) * rng.random()


def write_lines(rng, path, points):
    """Writes segments; some continue others, some repeat a part of another."""
    has_heights = rng.random() < 0.3
    ends = []
    with open(path, "w", encoding="ascii") as file:
        for _ in range(rng.choice((1, 2, 5, rng.randint(1, 30)))):
            a = rng.choice(ends) if ends and rng.random() < 0.3 else end_of(rng, points)
            b = end_of(rng, points)
            ends.append(b)
            values = [*a, rng.randint(0, 9), *b, rng.randint(0, 9)] if has_heights else [*a, *b]
            file.write(",".join(repr(float(value)) for value in values) + "\n")


def write_boundary(rng, path, points):
    """Writes a closed line around most of the points, or through some of them."""
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    corners = [(min(xs), min(ys)), (max(xs), min(ys)), (max(xs), max(ys)), (min(xs), max(ys))]
    if rng.random() < 0.5:
        corners = [rng.choice(points) for _ in range(rng.randint(3, 6))]
    with open(path, "w", encoding="ascii") as file:
        for a, b in zip(corners, corners[1:] + corners[:1]):
            if a != b:
                file.write(",".join(repr(float(value)) for value in (*a, *b)) + "\n")


def read_npy(path):
    """The shape and the values of an .npy file, as a tuple of numbers."""
    data = path.read_bytes()
    length = struct.unpack_from("<H", data, 8)[0]
    header = ast.literal_eval(data[10:10 + length].decode("ascii"))
    count = math.prod(header["shape"])
    return header["shape"], struct.unpack_from("<" + {"<f8": "d", "<i8": "q", "<i4": "i"}[header["descr"]] * count,
                                               data, 10 + length)


def triangles_in(tools, path, flat):
    """The triangles of a mesh file: for each the coordinates of its corners, sorted."""
    result = campaign.run([tools.tipp, "flatten", path, "-o", flat], env=ENVIRONMENT, memory=0)
    if result.code != 0:
        if "no cells" in result.error:
            return []
        raise campaign.Failure(f"{result}")
    (_, width), values = read_npy(flat / "points.npy")
    points = [struct.pack(f"<{width}d", *values[i:i + width]) for i in range(0, len(values), width)]
    _, ids = read_npy(flat / "cells.npy")
    shutil.rmtree(flat)
    return [tuple(sorted(points[i] for i in ids[t:t + 3])) for t in range(0, len(ids), 3)]


def triangles_of(tools, output):
    """The sorted triangles of an output: a mesh file, or a partitioned mesh, whose ghosts are left out."""
    files = sorted((output / "pieces").glob("*.vtu")) if output.suffix == ".tipp" else [output]
    return sorted(t for path in files for t in triangles_in(tools, path, output.parent / "flat"))


def ways_of(tools, command, suffix, memory):
    """The ways to run a command: name, words and output."""
    ranks = [tools.mpiexec, "--oversubscribe", "--bind-to", "none", "-n", "2"]
    yield "memory", [tools.tipp, *command], "a" + suffix
    if suffix == ".vtu":
        yield "on ranks", [*ranks, tools.tipp, *command], "b.vtu"
        suffix = ".tipp"
    yield "out of core", [tools.tipp, *command, *memory], "c" + suffix
    yield "out of core on ranks", [*ranks, tools.tipp, *command, *memory], "d" + suffix


def compare(tools, folder, command, suffix, memory, read):
    """Runs a command in all ways. Fails where one has another result, or fails where another does not."""
    expected = first = None
    for name, words, output in ways_of(tools, command, suffix, memory):
        path = folder / output
        words = [*words, "-o", path.name]
        result = campaign.run(words, cwd=folder, env=ENVIRONMENT, memory=0)
        campaign.require_clear_end(result)
        found = read(path) if result.code == 0 else f"exit code {result.code}"
        if first is None:
            expected, first = found, result
        elif found != expected:
            differing = "another outcome"
            if isinstance(found, list) and isinstance(expected, list):
                differing = (f"{len(set(expected) - set(found))} triangles are missing, "
                             f"{len(set(found) - set(expected))} are others, {len(expected)} expected")
            elif isinstance(found, bytes) and isinstance(expected, bytes):
                unequal = sum(a != b for a, b in zip(found, expected))
                differing = f"{len(found)} bytes instead of {len(expected)}, {unequal} differ"
            raise campaign.Failure(f"{name}: {differing}\n  {first}\n  {result}")


def dem_command(rng, points):
    """A raster of the points with random options."""
    side = max(max(p[0] for p in points) - min(p[0] for p in points),
               max(p[1] for p in points) - min(p[1] for p in points), 1e-3)
    bands = ["elevation", "w", "slope", "aspect", "hillshade", "density", "void"]
    command = ["dem", "points.csv", "--resolution", repr(side / rng.randint(3, 60)), "--attributes",
               ",".join(rng.sample(bands, rng.randint(1, 4)))]
    if rng.random() < 0.3:
        command += ["--thin", f"{side / rng.randint(5, 40)!r}:{rng.choice(('min', 'max', 'nearest'))}"]
    if rng.random() < 0.5:
        command += ["--breaklines", "lines.csv"]
    if rng.random() < 0.3:
        command += ["--boundary", "boundary.csv"]
    return command, ["--memory", "1M"]


def delaunay_command(rng, points):
    """A triangulation of the points with random options."""
    command = ["delaunay", "points.csv"]
    constrained = rng.random() < 0.6
    if constrained:
        command += ["--constraints", "lines.csv"]
        command += ["--refuse-crossings"] if rng.random() < 0.1 else []
        if rng.random() < 0.3:
            command += ["--hole", *(repr(float(value)) for value in rng.choice(points))]
    if rng.random() < 0.3:
        command += ["--boundary", "boundary.csv"]
    memory = ["--partitions", f"{rng.randint(1, 4)}x{rng.randint(1, 4)}"] if rng.random() < 0.7 else []
    return command, [*memory, "--memory", "1M"]


def trial(rng, folder, tools):
    """Makes an input, and compares the results of one command."""
    is_raster = rng.random() < 0.5
    points = write_points(rng, folder / "points.csv", 15000 if is_raster else 4000)  # several pieces
    write_lines(rng, folder / "lines.csv", points)
    write_boundary(rng, folder / "boundary.csv", points)
    command, memory = (dem_command if is_raster else delaunay_command)(rng, points)
    if rng.random() < 0.4:
        command += ["--duplicates", rng.choice(("min", "max", "mean"))]
    if rng.random() < 0.2:
        command += ["--max-edge", repr(rng.choice(points)[0] / 3 or 1.0).lstrip("-")]
    try:
        if is_raster:
            compare(tools, folder, command, ".npy", memory, pathlib.Path.read_bytes)
        else:
            compare(tools, folder, command, ".vtu", memory, lambda path: triangles_of(tools, path))
    except campaign.Failure:
        keep = os.environ.get("TIPP_KEEP_FAILURES")
        if keep:
            shutil.copytree(folder, pathlib.Path(keep) / folder.name, dirs_exist_ok=True)
        raise
    return 1


if __name__ == "__main__":
    sys.exit(campaign.main("agree", trial, __doc__))
