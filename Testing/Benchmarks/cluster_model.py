# SPDX-License-Identifier: BSD-3-Clause
"""Simulates tipp delaunay on clusters: masters, workers and messages, event by event.

Usage: cluster_model.py STATISTICS.json...

Each STATISTICS.json is what a run of `mpirun -np N tipp delaunay --stats` wrote. The costs of a
partition, of a master's work and of messages are fitted to them; then the same runs are simulated,
so that the model can be judged, and larger clusters are predicted.
"""
import heapq
import json
import math
import os
import sys

NETWORKS = {  # seconds a message, bytes a second and rank
    "1 Gb/s Ethernet": (50e-6, 1.1e8),
    "fast interconnect": (2e-6, 1.0e10),
}
BYTES_PER_POINT = 24  # that travel to an owner: two coordinates and an id


class Costs:
    """What one thread needs, from the figures of measured runs."""

    def __init__(self, runs):
        points = compute = exchange = 0.0
        master = handled = task_bytes = boundary = 0.0
        for run in runs:
            points += run["points"]
            compute += sum(rank["compute_seconds"] for rank in run["ranks"])
            exchange += sum(rank["exchange_seconds"] + rank["collect_seconds"]
                            for rank in run["ranks"])
            master += sum(m["seconds"] for m in run["masters"])
            boundary += boundary_units(run["points"], run["partitions"])
            handled += run["partitions"]
            remote = 1 - 1 / len(run["ranks"])
            if remote > 0 and not run["major_partitions"]:
                sent = sum(t["bytes"] for t in run["traffic"] if t["kind"] in ("task", "partition done"))
                task_bytes = max(task_bytes, sent / remote
                                 / boundary_units(run["points"], run["partitions"]))
        self.point = compute / points
        self.exchange = exchange / points
        self.boundary = master / max(boundary, 1.0)  # seconds of a master, a unit of boundary
        self.bytes = task_bytes or 100.0             # both ways, a unit of boundary


def boundary_units(points, partitions):
    """Boundary triangles of all partitions grow as the root of a partition's points."""
    return partitions * math.sqrt(points / partitions)


class Master:
    """One who serves requests one after the other."""

    def __init__(self):
        self.free = 0.0
        self.busy = 0.0

    def serve(self, now, seconds):
        begin = max(now, self.free)
        self.free = begin + seconds
        self.busy += seconds
        return self.free


def simulate_area(costs, points, partitions, workers, network, start=0.0):
    """Time until one master's partitions are all triangulated by its workers, and its own work.

    A quarter of the partitions left can be active together (table 2.1).
    """
    latency, bandwidth = network
    size = points / partitions
    unit = math.sqrt(size)
    transfer = latency + costs.bytes * unit / 2 / bandwidth
    serve = costs.boundary * unit / 2
    master = Master()
    left, active, now = partitions, 0, start
    done = []
    idle = workers
    while left > 0 or active > 0:
        limit = max(1, math.ceil(0.25 * (left + active)))
        while idle > 0 and left > 0 and active < limit:
            sent = master.serve(now, serve)
            heapq.heappush(done, sent + transfer + size * costs.point + transfer)
            left, active, idle = left - 1, active + 1, idle - 1
        now = heapq.heappop(done)
        now = master.serve(now, serve)
        active, idle = active - 1, idle + 1
    return now, master.busy


def predict(costs, points, ranks, network, design, per_partition=49152):
    """Seconds in all, and the first master's share."""
    latency, bandwidth = network
    partitions = max(8 * ranks, round(points / per_partition))
    exchange = (costs.exchange * points / ranks + latency * ranks
                + (1 - 1 / ranks) * points / ranks * BYTES_PER_POINT / bandwidth)
    initial = 8 * partitions * costs.point
    if design == "single":
        workers = ranks if ranks < 32 else ranks - 1
        end, busy = simulate_area(costs, points, partitions, workers, network)
        return exchange + initial + end, (initial + busy) / (exchange + initial + end)
    majors = max(16, 2 * ranks)
    groups = max(1, min(ranks, majors // 4))
    group = ranks / groups
    minors = max(1, partitions // majors)
    one, _ = simulate_area(costs, points / majors, minors, max(1, int(group)), network,
                           start=8 * minors * costs.point)
    unit = math.sqrt(points / majors)
    serve = costs.boundary * unit
    shifts = math.ceil(majors / groups)
    initial = 8 * majors * costs.point
    top = initial + majors * serve
    end = max(top, initial + shifts * (one + 2 * latency + costs.bytes * unit / bandwidth))
    return exchange + end, top / (exchange + end)


def check(costs, runs):
    print(f"{'ranks':>5} {'points':>10} {'partitions':>10} {'masters':>7} "
          f"{'measured s':>10} {'model s':>8}")
    for run in runs:
        ranks = len(run["ranks"])
        single = not run["major_partitions"]
        network = (2e-6, 4e9)  # within one machine
        cores = min(ranks, os.cpu_count())
        seconds, _ = predict(costs, run["points"], cores, network,
                             "single" if single else "multi",
                             run["points"] / run["partitions"])
        print(f"{ranks:5} {run['points']:10} {run['partitions']:10} "
              f"{'one' if single else 'many':>7} {run['seconds']:10.3f} {seconds:8.3f}")


def tables(costs):
    for name, network in NETWORKS.items():
        for points in (10**9, 10**10, 10**11):
            print(f"\n{points:.0e} points, {name}")
            print(f"{'ranks':>6} {'one master s':>13} {'efficiency':>10} {'its share':>9} "
                  f"{'many masters s':>15} {'efficiency':>10} {'its share':>9}")
            alone = points * (costs.point + costs.exchange)
            for ranks in (10, 32, 64, 128, 256, 512, 1024):
                row = f"{ranks:6}"
                for design, width in (("single", 13), ("multi", 15)):
                    seconds, share = predict(costs, points, ranks, network, design)
                    row += (f" {seconds:{width}.2f} {alone / ranks / seconds:10.0%} "
                            f"{share:9.1%}")
                print(row)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    runs = [json.load(open(path, encoding="utf-8")) for path in sys.argv[1:]]
    costs = Costs(runs)
    print(f"{costs.point * 1e9:.0f} ns a point, {costs.exchange * 1e9:.0f} ns to bring it to its "
          f"owner and its triangles back; a partition of n points costs its master "
          f"{costs.boundary * 1e9:.0f} ns and the network {costs.bytes:.0f} bytes, times sqrt(n)\n")
    check(costs, runs)
    tables(costs)


if __name__ == "__main__":
    main()
