# SPDX-License-Identifier: BSD-3-Clause
"""Kills random runs at random moments, several times each, and then finishes them.

The finished mesh must equal that of an uninterrupted run byte for byte, and no other file may be left. A trial
returns the number of kills.
"""
import os
import pathlib
import random
import signal
import subprocess
import sys
import time

from campaign import Failure, Tools, contents, main, require_clear_end, run, write_points_in_space

SIGNALS = (signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
DISTRIBUTIONS = ("uniform", "clustered", "kuzmin", "lattice", "coast", "circle")


def kill_at_call(tools: Tools):
    """The library that kills a process before a system call, or None if it is not built."""
    build = pathlib.Path(tools.tipp).resolve().parent.parent
    return next(iter(sorted(build.glob("Testing/Cxx/Tools/*TIPPKillAtCall.so")) +
                     sorted(build.glob("lib/**/*TIPPKillAtCall.so"))), None)


def processes_of(session):
    """The living processes of a session: all that a command has started."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            if int(fields[3]) == session and fields[0] != "Z":
                found.append((int(entry.name), int(fields[1])))
    return found


class Killed:
    """A command in its own session, so that all its processes can be killed."""
    def __init__(self, command, folder, env=None):
        self.command = [str(word) for word in command]
        self.errors = folder / "errors.txt"
        with open(self.errors, "wb") as errors:
            self.process = subprocess.Popen(self.command, stdout=subprocess.DEVNULL, stderr=errors, cwd=folder,
                                            env=dict(os.environ, **(env or {})), start_new_session=True)

    def wait(self, seconds):
        """Waits for this time, and returns whether the command has ended."""
        try:
            self.process.wait(seconds)
            return True
        except subprocess.TimeoutExpired:
            return False

    def signal(self, number, rng):
        """Sends the signal to the command. SIGKILL may also go to any process that the command has started."""
        targets = [self.process.pid]
        if number == signal.SIGKILL:
            targets += [pid for pid, _ in processes_of(self.process.pid)]
        try:
            os.kill(rng.choice(targets), number)
        except ProcessLookupError:
            pass

    def end(self):
        """Waits until all processes have ended. Returns the exit code, and what the command wrote to stderr.

        Sometimes Open MPI's mpirun does not notice that all its ranks have ended. Then it is killed, and a line is
        printed: no process of the tool is alive any more.
        """
        lonely = 0
        for _ in range(60):
            if self.wait(1):
                break
            lonely = lonely + 1 if [pid for pid, _ in processes_of(self.process.pid)] == [self.process.pid] else 0
            if lonely == 5 and self.command[0].endswith(("mpiexec", "mpirun")):
                print("kill: mpirun outlived its ranks and was ended", flush=True)
                self.process.kill()
        else:
            for pid, _ in processes_of(self.process.pid):
                os.kill(pid, signal.SIGKILL)
            self.process.wait()
            raise Failure(f"{' '.join(self.command)}: still running 60 s after a signal")
        limit = time.monotonic() + 30
        while processes_of(self.process.pid):
            if time.monotonic() > limit:
                for pid, _ in processes_of(self.process.pid):
                    os.kill(pid, signal.SIGKILL)
                raise Failure(f"{' '.join(self.command)}: a process of it lives on after it has ended")
            time.sleep(0.005)
        error = self.errors.read_text(errors="replace")
        self.errors.unlink()
        return self.process.returncode, error


def write_segments(rng, path, count):
    """Writes segments in the unit square, most of them short. Some cross others."""
    with open(path, "w", encoding="ascii") as file:
        file.write("x1,y1,x2,y2\n")
        for _ in range(count):
            x, y = rng.random(), rng.random()
            length = 1 if rng.random() < 0.02 else 0.02
            file.write(f"{x!r},{y!r},{x + length * (rng.random() - 0.5)!r},{y + length * (rng.random() - 0.5)!r}\n")


def delaunay(rng, folder, tools):
    """A command that can be resumed, and the same command without other processes that share the work."""
    distribution = rng.choice(DISTRIBUTIONS)
    count = rng.randint(20, 40 if distribution == "circle" else 200) * 1000
    require_clear_end(run([tools.tipp, "points", "--distribution", distribution, "--count", count, "--seed",
                           rng.randint(1, 1000), "-o", "points.npy"], cwd=folder), (0,))
    options = ["--memory", f"{rng.randint(2, 16)}M"]
    options += ["--neighbors"] if rng.random() < 0.4 else []
    options += ["--map-duplicates"] if rng.random() < 0.2 else []
    if rng.random() < 0.4:
        write_segments(rng, folder / "segments.csv", rng.randint(1, 400))
        options += ["--constraints", "segments.csv"]
        options += ["--mark-constraints"] if rng.random() < 0.5 else []
    plain = [tools.tipp, "delaunay", "points.npy", "-o", "mesh.tipp", *options, "--threads", "2"]
    command = plain[:-1] + [rng.randint(1, 3)]
    if tools.mpiexec and rng.random() < 0.15:
        command = [tools.mpiexec, "--oversubscribe", "--bind-to", "none", "-np", "2", *command]
    return plain, command, [*command, "--resume"]


def delaunay3d(rng, folder, tools):
    """The same of points in space, resumed with any number of threads."""
    write_points_in_space(rng, folder / "points.csv", rng.randint(5, 40) * 1000)
    options = ["--memory", f"{rng.randint(1, 4)}M"]
    options += ["--neighbors"] if rng.random() < 0.4 else []
    options += ["--map-duplicates"] if rng.random() < 0.2 else []
    options += ["--scratch", "scratch"] if rng.random() < 0.2 else []
    plain = [tools.tipp, "delaunay3d", "points.csv", "-o", "mesh.tipp", *options, "--threads", "2"]
    return plain, [*plain[:-1], rng.randint(1, 3)], [*plain[:-1], rng.randint(1, 3), "--resume"]


def partition(rng, folder, tools):
    """A command that starts from the beginning each time."""
    require_clear_end(run([tools.tipp, "points", "--distribution", "clustered", "--count", rng.randint(20, 60) * 1000,
                           "-o", "points.npy"], cwd=folder), (0,))
    require_clear_end(run([tools.tipp, "delaunay", "points.npy", "-o", "mesh.vtu"], cwd=folder), (0,))
    command = [tools.tipp, "partition", "mesh.vtu", "-o", "mesh.tipp",
               "--tiling", rng.choice(("grid:5x4", "quadtree:4000")),
               "--borrowers", rng.choice(("reference", "duplicate")), "--threads", rng.randint(1, 3)]
    return command, command, command


def trial(rng: random.Random, folder: pathlib.Path, tools: Tools):
    """Kills one command several times, finishes it and compares its output."""
    kind = rng.choices((delaunay, delaunay3d, partition), (5, 3, 2))[0]
    plain, command, resume = kind(rng, folder, tools)
    undisturbed = run(plain, cwd=folder)
    require_clear_end(undisturbed, (0,))
    expected = contents(folder)
    mesh = folder / "mesh.tipp"
    library = kill_at_call(tools) if command[0] == tools.tipp else None
    mesh.rename(folder / "older.tipp")
    kills, wanted = 0, rng.randint(4, 8)
    for attempt in range(100):
        env = {}
        if library and rng.random() < 0.4:
            env = {"LD_PRELOAD": str(library), "TIPP_KILL_AT": str(rng.randint(1, 25))}
        killed = Killed(command if kills == 0 else resume, folder, env)
        if not killed.wait(60 if env else rng.uniform(0, 1.1 * undisturbed.seconds)):
            killed.signal(rng.choice(SIGNALS), rng)
        code, error = killed.end()
        if code == 0:
            finished = contents(mesh)
            if finished != contents(folder / "older.tipp"):
                raise Failure(f"{killed.command}: another mesh after {kills} kills")
            if kills >= wanted or attempt >= 3 * wanted:
                break
            if rng.random() < 0.7:  # otherwise it replaces the one before
                run(["rm", "-r", mesh])
            continue
        if code > 0 and code not in (130, 143) and command[0] == tools.tipp:
            raise Failure(f"{killed.command}: exit code {code} after {kills} kills\n  {error}")
        kills += 1
        if kills >= wanted:
            result = run(resume, cwd=folder)
            require_clear_end(result, (0,))
            break
    run(["rm", "-r", folder / "older.tipp"])
    left = contents(folder)
    if left != expected:
        changed = sorted(name for name in left.keys() | expected.keys() if left.get(name) != expected.get(name))
        raise Failure(f"{' '.join(map(str, resume))}: after {kills} kills these differ from an undisturbed run, or "
                      f"are left over or missing: {', '.join(changed[:9])}")
    known = {name.split("/")[0] for name in expected} | {"scratch"}
    others = sorted(path.name for path in [*folder.iterdir(), *(folder / "scratch").glob("*")]
                    if path.name not in known)
    if others:
        raise Failure(f"{' '.join(map(str, resume))}: leaves {', '.join(others)}")
    return kills


if __name__ == "__main__":
    sys.exit(main("kill", trial, __doc__))
