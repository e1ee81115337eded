# SPDX-License-Identifier: BSD-3-Clause
"""Prints one row of a table from the statistics of `tipp delaunay --stats` on several ranks.

Usage: rank_row.py LABEL STATISTICS.json   (LABEL "head" prints the names of the columns)
"""
import json
import sys

COLUMNS = ("run", "seconds", "points/s", "master", "sub-masters", "largest mesh", "compute max/mean",
           "longest path", "bytes/output")


def row(cells):
    print(f"{cells[0]:34}" + "".join(f"{cell:>17}" for cell in cells[1:]))


def main():
    if len(sys.argv) == 2 and sys.argv[1] == "head":
        row(COLUMNS)
        return
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[2], encoding="utf-8") as file:
        run = json.load(file)
    seconds = run["seconds"]
    compute = [rank["compute_seconds"] for rank in run["ranks"]]
    mean = sum(compute) / len(compute)
    master = sum(m["seconds"] for m in run["masters"] if m["area"] == 0)
    # The sum over all stages of the longest computation of a rank between two barriers.
    path = sum(m["path_seconds"] for m in run["masters"] if m["area"] == 0)
    largest = max((m["largest_mesh"] for m in run["masters"]), default=0)
    # Without the points' way to their owners: only vertices of boundary triangles.
    sent = sum(t["bytes"] for t in run["traffic"] if t["kind"] in ("task", "partition done"))
    row((sys.argv[1], f"{seconds:.3f}", f"{run['points'] / seconds:.0f}",
         f"{master / seconds:.2%}",
         f"{sum(m['seconds'] for m in run['masters'] if m['area'] > 0) / seconds:.2%}",
         f"{largest}", f"{max(compute) / mean if mean else 1:.3f}", f"{path:.3f}",
         f"{sent / (12 * run['triangles']):.2%}"))


if __name__ == "__main__":
    main()
