# SPDX-License-Identifier: BSD-3-Clause
"""Prints a row of figures of the fastest of several runs: run_row.py TITLE STATISTICS.json..."""
import json
import sys


def seconds(run):
    return run.get("seconds", run.get("triangulate_seconds"))


runs = []
for path in sys.argv[2:]:
    with open(path, encoding="utf-8") as file:
        runs.append(json.load(file))
best = min(runs, key=seconds)
cells = [
    sys.argv[1],
    f"{best['triangles']} triangles",
    f"{seconds(best):.2f} s",
    f"{seconds(best) / best['points'] * 1e9:.0f} ns a point",
    f"peak {best['peak_memory_bytes'] / 1e6:.0f} MB",
]
for name, what in (("read_bytes", "read"), ("written_bytes", "written")):
    if name in best:
        cells.append(f"{best[name] / best['points']:.1f} bytes a point {what}")
for phase in best["phases"]:
    cells.append(f"{phase['name']} {phase['seconds']:.2f} s")
print(" | ".join(cells))
