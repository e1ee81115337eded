# SPDX-License-Identifier: BSD-3-Clause
"""Compares refined meshes with those of Triangle, CGAL and Gmsh: times by turns, memory, numbers of points.

Usage: mesh_peers.py BENCHMARK FILE FOLDER [--angle A] [--area A]... [--repeat R] [--slow-area A]

BENCHMARK is the program benchmarkMesh, FILE has the lines of the domain. Triangle (package triangle) and Gmsh (package
gmsh) are left out if Python cannot import them; both run in processes of their own. A time is that of the mesh alone, in
processor seconds and, for two threads, on the clock; the least of the runs counts. CGAL and Gmsh get --slow-area.
"""
import argparse
import pathlib
import subprocess
import sys

PEERS = """
import resource, sys, time
import numpy
engine, path, angle, area = sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4])
words = open(path).read().split()
n, m = int(words[0]), int(words[1])
points = numpy.array(words[2:2 + 2 * n], float).reshape(n, 2)
segments = numpy.array(words[2 + 2 * n:], int).reshape(m, 2)
module = __import__(engine)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
start, processor = time.time(), time.process_time()
if engine == "triangle":
    mesh = module.triangulate({"vertices": points, "segments": segments}, f"pq{angle:g}a{area:.12f}")
    count, triangles = len(mesh["vertices"]), len(mesh["triangles"])
    result = 16 * count + 4 * count + 12 * triangles
else:
    size = (area * 4 / 3 ** .5) ** .5
    module.initialize()
    module.option.setNumber("General.Terminal", 0)
    geo = module.model.geo
    tags = [geo.addPoint(x, y, 0, size) for x, y in points]
    lines = {}
    for a, b in segments:
        lines.setdefault(a, []).append((b, len(lines)))
        lines.setdefault(b, []).append((a, len(lines)))
    used, loops = set(), []
    for first in range(n):
        loop, at = [], first
        while True:
            step = next((b for b, _ in lines[at] if frozenset((at, b)) not in used), None)
            if step is None:
                break
            used.add(frozenset((at, step)))
            loop.append(geo.addLine(tags[at], tags[step]))
            at = step
        if loop:
            loops.append(loop)
    loops.sort(key=len, reverse=True)
    geo.addPlaneSurface([geo.addCurveLoop(loop) for loop in loops])
    geo.synchronize()
    module.model.mesh.generate(2)
    count = len(module.model.mesh.getNodes()[0])
    triangles = len(module.model.mesh.getElementsByType(2)[0])
    result = 0
wall, cpu = time.time() - start, time.process_time() - processor
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print(count, triangles, wall, cpu, ((peak - before) * 1024 - result) / max(1, triangles))
"""


def figures(command):
    points, triangles, wall, processor, memory = subprocess.run(
        [str(word) for word in command], check=True, capture_output=True, text=True).stdout.split()
    return int(points), int(triangles), float(wall), float(processor), float(memory)


def compare(options, text, area, engines):
    def command(engine):
        name, threads = engine
        if name in ("tipp", "cgal"):
            return [options.benchmark, name, options.file, options.angle, area, threads]
        return [sys.executable, "-c", PEERS, name, text, options.angle, area]

    runs = {engine: [] for engine in engines}
    for _ in range(options.repeat):
        for engine in engines:
            runs[engine].append(figures(command(engine)))
    best = {engine: min(run[2] if engine[1] > 1 else run[3] for run in runs[engine]) for engine in engines}
    ours = runs[engines[0]][0]
    print(f"{ours[1]} triangles at {options.angle:g} degrees, areas up to {area:g}:")
    for engine in engines:
        points, triangles, _, _, memory = runs[engine][-1]
        rate = triangles / best[engine]
        print(f"  {engine[0]:9} {engine[1]} thread{'s' if engine[1] > 1 else ' '} {points:10} points {triangles:10} triangles "
              f"{best[engine]:8.3f} s {rate / 1e6:7.3f} M/s  {memory:6.1f} bytes a triangle besides the result")
    rate = {engine: runs[engine][-1][1] / best[engine] for engine in engines}
    for peer in engines:
        if peer[0] != "tipp":
            ratios = ", ".join(f"{rate[e] / rate[peer]:.2f} on {e[1]}" for e in engines if e[0] == "tipp")
            count = f"; {ours[0] / runs[peer][-1][0]:.3f} of its points" if runs[peer][-1][0] else ""
            print(f"  times {peer[0]}: {ratios} threads{count}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("benchmark", type=pathlib.Path)
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--angle", type=float, default=30)
    parser.add_argument("--area", type=float, action="append")
    parser.add_argument("--slow-area", type=float, default=0.02)
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    text = options.folder / "lines.txt"
    subprocess.run([options.benchmark, "write", options.file, text], check=True)
    found = [(name, 1) for name in ("triangle", "gmsh")
             if subprocess.run([sys.executable, "-c", f"import {name}"], capture_output=True).returncode == 0]
    ours = [("tipp", 1), ("tipp", 2)]
    for area in options.area or [0.002, 0.0004, 0.0001]:
        compare(options, text, area, ours + [peer for peer in found if peer[0] == "triangle"])
    compare(options, text, options.slow_area, ours + [("cgal", 1)] + found)


if __name__ == "__main__":
    main()
