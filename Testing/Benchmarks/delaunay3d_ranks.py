# SPDX-License-Identifier: BSD-3-Clause
"""Compares runs of `tipp delaunay3d --stats` on one and two ranks of one thread each.

Usage: delaunay3d_ranks.py FOLDER REPEATS      (reads FOLDER/RANKS-RUN.json; the fastest run counts)

Prints wall-clock seconds until the tetrahedra are on the ranks that own them, and the processor seconds of the rank
that computes longest.
"""
import json
import pathlib
import sys


def least(folder, ranks, repeats):
    runs = [json.loads((folder / f"{ranks}-{run}.json").read_text()) for run in range(1, repeats + 1)]
    total = min(max(rank["total_seconds"] for rank in run["ranks"]) for run in runs)
    compute = min(max(rank["compute_seconds"] for rank in run["ranks"]) for run in runs)
    return total, compute


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, repeats = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    one = least(folder, 1, repeats)
    for ranks in (1, 2):
        total, compute = least(folder, ranks, repeats)
        print(f"{ranks} ranks of one thread: {total:.3f} s, {one[0] / total:.2f}x; "
              f"computation {compute:.3f} s, {one[1] / compute:.2f}x")


if __name__ == "__main__":
    main()
