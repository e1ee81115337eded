# SPDX-License-Identifier: BSD-3-Clause
"""Simulates tipp delaunay without a master on a cluster: events of partitions, threads and messages.

Usage: cluster_model.py [--costs STATISTICS.json] [--check STATISTICS.json...] [--points N...] TRACE...

A TRACE is the output of `benchmarkOrder POINTS.npy RANKS`: the measured cost of each partition, the later partitions
that it conflicts with, and the number of vertices that it sends to each. If there are several traces of the same
points and ranks, the lowest cost of each partition counts. The costs of moving points to their owners, and triangles
back, are those of a measured run (--costs). To validate the model, measured runs on several ranks (--check) are
simulated with the number of cores that this machine has.
"""
import argparse
import heapq
import json
import math
import os
import statistics

NETWORKS = {  # seconds per message; bytes per second and rank
    "1 Gb/s Ethernet": (50e-6, 1.1e8),
    "10 Gb/s Ethernet": (20e-6, 1.1e9),
    "within a machine": (2e-6, 4e9),
}
BYTES_OF_POINT = 24   # sent to an owner: two coordinates and an id
BYTES_OF_VERTEX = 32  # of a vertex in a message
NOTHING = (0.0, float("inf"))


class Trace:
    """The partitions of one triangulation, in their order."""

    def __init__(self, path):
        self.path = path
        with open(path, encoding="ascii") as lines:
            head = next(lines).split()
            self.ranks, self.points = int(head[1]), int(head[3])
            initial = next(lines).split()
            self.initial_seconds, self.initial_bytes = float(initial[3]), int(initial[7])
            self.owner, self.seconds, self.vertices, self.later = [], [], [], []
            numbers = {}
            for line in lines:
                words = line.split()
                numbers[words[0]] = len(self.owner)
                self.owner.append(int(words[1]))
                self.seconds.append(float(words[2]))
                self.vertices.append(int(words[3]))
                self.later.append([pair.split(":") for pair in words[4:]])
        self.later = [[(numbers[q], int(vertices)) for q, vertices in pairs] for pairs in self.later]
        self.chain = [0] * len(self.owner)  # length of the longest chain of partitions that wait for each
        for p in reversed(range(len(self.owner))):
            self.chain[p] = max((1 + self.chain[q] for q, _ in self.later[p]), default=0)

    def compute(self):
        return sum(self.seconds)

    def cut_outliers(self):
        """Limits costs to twice the usual cost per vertex: higher ones are caused by other work of the machine."""
        usual = statistics.median(s / v for s, v in zip(self.seconds, self.vertices))
        limits = [2 * usual * v for v in self.vertices]
        self.cut = sum(s > limit for s, limit in zip(self.seconds, limits))
        self.seconds = list(map(min, self.seconds, limits))

    def is_of_same_run(self, other):
        return self.owner == other.owner and self.points == other.points

    def merge(self, other):
        """Keeps the lower cost of each partition, since other work of the machine only increases costs."""
        self.seconds = list(map(min, self.seconds, other.seconds))
        self.initial_seconds = min(self.initial_seconds, other.initial_seconds)


def read_traces(paths):
    traces = []
    for path in paths:
        trace = Trace(path)
        same = next((t for t in traces if t.is_of_same_run(trace)), None)
        same.merge(trace) if same else traces.append(trace)
    for trace in traces:
        trace.cut_outliers()
    return traces


def simulate(trace, cores, network, scale=1.0):
    """Seconds until all partitions are triangulated, if rank r computes on core r % cores.

    Of its ready partitions, a core starts the one that the longest chain waits for (Engine/PartitionSchedule.h). With
    `scale` times the points, a partition costs `scale` times as much. It sends sqrt(scale) times as many vertices,
    since these are at its boundary.
    """
    latency, bandwidth = network
    awaited = [0] * len(trace.owner)
    for pairs in trace.later:
        for q, _ in pairs:
            awaited[q] += 1
    ready = [[] for _ in range(cores)]  # (-chain, partition)
    ready_at = [0.0] * len(trace.owner)
    free = [True] * cores
    events = []  # (time, kind, partition); kind 0: is ready, 1: is done
    for p, count in enumerate(awaited):
        if count == 0:
            heapq.heappush(events, (0.0, 0, p))
    end = 0.0

    def start(core, now):
        if free[core] and ready[core]:
            free[core] = False
            p = heapq.heappop(ready[core])[1]
            heapq.heappush(events, (now + trace.seconds[p] * scale, 1, p))

    while events:
        now, is_done, p = heapq.heappop(events)
        core = trace.owner[p] % cores
        if is_done:
            end = now
            free[core] = True
            for q, vertices in trace.later[p]:
                arrival = now
                if trace.owner[q] != trace.owner[p]:
                    arrival += latency + vertices * BYTES_OF_VERTEX * math.sqrt(scale) / bandwidth
                ready_at[q] = max(ready_at[q], arrival)
                awaited[q] -= 1
                if awaited[q] == 0:
                    heapq.heappush(events, (ready_at[q], 0, q))
        else:
            heapq.heappush(ready[core], (-trace.chain[p], p))
        start(core, now)
    return end


class Costs:
    """The time that one thread needs per point besides triangulation, from a measured run."""

    def __init__(self, run):
        ranks = run["ranks"]
        self.exchange = sum(r["exchange_seconds"] + r["collect_seconds"] for r in ranks) / run["points"]


def whole_run(trace, costs, points, network):
    """Seconds of a run with `points` points, in as many partitions as the trace has."""
    latency, bandwidth = network
    scale = points / trace.points
    # Every rank makes its part of the initial mesh, and computes the whole order. Initial points and conflicts are
    # gathered on one rank and then sent to all.
    exchange = (costs.exchange * points / trace.ranks + latency * trace.ranks
                + (1 - 1 / trace.ranks) * points / trace.ranks * BYTES_OF_POINT / bandwidth)
    gathered = 8 * len(trace.owner) * BYTES_OF_VERTEX + trace.initial_bytes
    initial = trace.initial_seconds + 2 * gathered / bandwidth
    return exchange + initial + simulate(trace, trace.ranks, network, scale)


def alone(trace, costs, points):
    """Seconds of the same run on one rank with one thread."""
    return costs.exchange * points + trace.compute() * points / trace.points


def check(traces, costs, runs):
    print(f"{'ranks':>5} {'points':>10} {'measured s':>10} {'model s':>8}")
    for run in runs:
        ranks = len(run["ranks"])
        trace = next((t for t in traces if t.ranks == ranks and t.points == run["points"]), None)
        if trace is None:
            print(f"{ranks:5} {run['points']:10}: no trace")
            continue
        cores = min(ranks, os.cpu_count())
        # Each rank makes its part and computes the order; ranks on the same core do so one after the other.
        initial = trace.initial_seconds * math.ceil(ranks / cores)
        seconds = (costs.exchange * trace.points / cores + initial
                   + simulate(trace, cores, NETWORKS["within a machine"]))
        print(f"{ranks:5} {run['points']:10} {run['seconds']:10.3f} {seconds:8.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("traces", metavar="TRACE", nargs="+")
    parser.add_argument("--costs", metavar="STATISTICS.json")
    parser.add_argument("--check", metavar="STATISTICS.json", nargs="*", default=[])
    parser.add_argument("--points", type=float, nargs="*", default=[1e9, 1e10])
    arguments = parser.parse_args()
    traces = read_traces(arguments.traces)
    print(f"{'ranks':>5} {'points':>10} {'partitions':>10} {'costs cut':>9} {'efficiency of computing':>23}")
    for trace in traces:
        efficiency = trace.compute() / trace.ranks / simulate(trace, trace.ranks, NOTHING)
        print(f"{trace.ranks:5} {trace.points:10} {len(trace.owner):10} {trace.cut:9} {efficiency:23.3f}")
    if not arguments.costs:
        return
    with open(arguments.costs, encoding="utf-8") as file:
        costs = Costs(json.load(file))
    print()
    check(traces, costs, [json.load(open(path, encoding="utf-8")) for path in arguments.check])
    print(f"\n{'ranks':>5} {'points':>8} {'network':>18} {'seconds':>9} {'efficiency':>10}")
    for trace in traces:
        for points in arguments.points:
            for name, network in NETWORKS.items():
                seconds = whole_run(trace, costs, points, network)
                efficiency = alone(trace, costs, points) / trace.ranks / seconds
                print(f"{trace.ranks:5} {points:8.0e} {name:>18} {seconds:9.3f} {efficiency:10.3f}")


if __name__ == "__main__":
    main()
