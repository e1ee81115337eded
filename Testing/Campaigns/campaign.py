# SPDX-License-Identifier: BSD-3-Clause
"""Shared by all campaigns: the loop over random trials, and running the tool under limits.

A campaign is a script in this folder that calls main() with a function trial(random, folder, tools). The function
raises Failure if the tool breaks a promise of Documentation/Reliability.md. Each trial has its own seed, so that a
failed trial can be repeated alone: --seed SEED --trials 1.
"""
import argparse
import dataclasses
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

GIGABYTE = 1 << 30

# Messages for users must not contain these: positions in source files, and addresses of objects.
INTERNAL = re.compile(r"\.(cxx|cpp|h|hxx|py)[:,] ?(line )?\d+|0x[0-9a-f]{6,}|Traceback|terminate called|what\(\):")


class Failure(Exception):
    """The tool broke a promise; the text says which one."""


@dataclasses.dataclass
class Tools:
    """The programs under test."""
    tipp: str
    mpiexec: str = "mpiexec"


@dataclasses.dataclass
class Result:
    """How a command ended. `code` is its exit code, or minus a signal's number, as in subprocess."""
    command: list
    code: int
    output: str
    error: str
    seconds: float

    def __str__(self):
        return f"{' '.join(map(str, self.command))}\n  exit code {self.code} after {self.seconds:.1f} s\n  {self.error}"


def run(command, *, timeout=120, memory=4 * GIGABYTE, cwd=None, env=None):
    """Runs a command to its end. Raises Failure on a timeout."""
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    begin = time.monotonic()
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, errors="replace",
                              timeout=timeout, cwd=cwd, env=env, preexec_fn=limit if memory else None,
                              restore_signals=False)  # a file that grows too large is an error, not a signal
    except subprocess.TimeoutExpired as expired:
        raise Failure(f"{' '.join(map(str, command))}: still running after {timeout} s") from expired
    return Result(command, done.returncode, done.stdout, done.stderr, time.monotonic() - begin)


def require_clear_end(result, allowed=(0, 1, 2)):
    """Fails unless the command succeeded, or failed with a message for its user: no signal, no internals."""
    if result.code not in allowed:
        raise Failure(f"{result}")
    if result.code != 0 and not result.error.strip():
        raise Failure(f"{result}\n  failed without a message")
    if INTERNAL.search(result.error) or INTERNAL.search(result.output):
        raise Failure(f"{result}\n  its message shows internals")


def contents(folder):
    """The contents of all files in a folder and its subfolders, by relative path."""
    folder = pathlib.Path(folder)
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def write_points_in_space(rng, path, count):
    """A file of points with x, y, z and a column of data."""
    kind = rng.choice(("uniform", "clustered", "lattice"))
    with open(path, "w", encoding="ascii") as file:
        file.write("x,y,z,weight\n")
        for i in range(count):
            p = [rng.random() for _ in range(3)]
            if kind == "clustered":
                p = [4 * (i % 7 * (k + 1) % 7) + x ** 3 for k, x in enumerate(p)]
            elif kind == "lattice":  # with duplicates
                p = [int(30 * x) for x in p]
            file.write(f"{p[0]},{p[1]},{p[2]},{i % 100}\n")


def main(name, trial, description):
    """Runs trials until the time or the number is reached, prints the results, and returns the exit code."""
    parser = argparse.ArgumentParser(prog=f"campaign.sh {name}", description=description)
    parser.add_argument("--tipp", required=True, help="the program under test")
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--minutes", type=float, help="how long to go on; default 1 if --trials is not given")
    parser.add_argument("--trials", type=int, help="at most this many trials")
    parser.add_argument("--seed", type=int, default=1, help="of the first trial; the others count up from it")
    parser.add_argument("--folder", help="where trials write; default a temporary folder")
    arguments = parser.parse_args()
    minutes = arguments.minutes if arguments.minutes or arguments.trials else 1
    end = time.monotonic() + 60 * minutes if minutes else float("inf")
    most = arguments.trials or sys.maxsize
    base = pathlib.Path(tempfile.mkdtemp(prefix=f"tipp-{name}-", dir=arguments.folder))
    tools = Tools(arguments.tipp, arguments.mpiexec)
    begin = time.monotonic()
    trials, checks, failed = 0, 0, []
    while trials < most and time.monotonic() < end:
        seed = arguments.seed + trials
        folder = base / str(seed)
        folder.mkdir()
        try:
            checks += trial(random.Random(seed), folder, tools) or 1
        except Failure as failure:
            failed.append(seed)
            print(f"{name}: seed {seed} FAILED: {failure}", flush=True)
        shutil.rmtree(folder, ignore_errors=True)
        trials += 1
    shutil.rmtree(base, ignore_errors=True)
    print(f"{name}: {trials} trials, {checks} checks, {len(failed)} failures in {(time.monotonic() - begin) / 60:.1f} "
          f"minutes, seeds {arguments.seed} to {arguments.seed + trials - 1}" +
          (f"; failed: {' '.join(map(str, failed))}" if failed else ""))
    return 1 if failed else 0
