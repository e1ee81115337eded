# SPDX-License-Identifier: BSD-3-Clause
"""A rank is killed, terminated, interrupted, stopped for a while, or reads another input than the others.

Each trial disturbs one command under mpirun at a random moment. The command must end in time: with success and the
correct output, or with a failure and no output. The next run must make the output of an undisturbed run and leave no
other file.
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import campaign

LIMIT = 60  # seconds, far more than any of these runs takes

ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_mpi_yield_when_idle="1")

# Name -> arguments, in which {input} and {output} are paths, and the options of the next run.
COMMANDS = {
    "delaunay": (["delaunay", "{input}", "-o", "{output}"], "points.npy", "out.npy", []),
    "out of core": (["delaunay", "{input}", "-o", "{output}", "--memory", "1M"], "points.npy", "out.tipp", ["--resume"]),
    "partition": (["partition", "{input}", "-o", "{output}", "--tiling", "quadtree:5000"], "flat", "out.tipp", []),
    "resample": (["resample", "{input}", "-o", "{output}", "--dims", "400", "400", "1"], "mesh.tipp", "out.vti", []),
}


class Scene:
    """The inputs, and for each command the output of an undisturbed run and its duration."""

    def __init__(self, base, tools):
        self.base = base
        self.tools = tools
        self.expected = {}
        base.mkdir()
        for command in (["points", "--distribution", "uniform", "--count", "60000", "-o", "points.npy"],
                        ["delaunay", "points.npy", "-o", "mesh.vtu"], ["flatten", "mesh.vtu", "-o", "flat"],
                        ["partition", "flat", "-o", "mesh.tipp"]):
            result = campaign.run([tools.tipp, *command], cwd=base, env=ENVIRONMENT)
            if result.code != 0:
                raise campaign.Failure(str(result))

    def of(self, name, ranks):
        """The output's bytes and the duration of an undisturbed run."""
        if (name, ranks) not in self.expected:
            folder = self.base / f"{name} {ranks}"
            folder.mkdir()
            begin = time.monotonic()
            result = campaign.run(command_line(self, name, ranks, folder), env=ENVIRONMENT, memory=0)
            if result.code != 0:
                raise campaign.Failure(str(result))
            self.expected[name, ranks] = output_of(folder / COMMANDS[name][2]), time.monotonic() - begin
        return self.expected[name, ranks]


def output_of(path):
    return campaign.contents(path) if path.is_dir() else path.read_bytes() if path.exists() else None


def command_line(scene, name, ranks, folder, more=(), other=None):
    """Starts the command. If `other` is given, the last rank reads that input."""
    words, data, output, _ = COMMANDS[name]

    def tipp(path):
        return [scene.tools.tipp, *(word.format(input=path, output=folder / output) for word in words), *more]
    launcher = [scene.tools.mpiexec, "--oversubscribe", "--bind-to", "none"]
    data = scene.base / data
    if other is None:
        return [*launcher, "-n", str(ranks), *tipp(data)]
    return [*launcher, "-n", str(ranks - 1), *tipp(data), ":", "-n", "1", *tipp(other)]


def ranks_of(mpirun, tipp):
    """The processes of tipp that mpirun has started."""
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            is_child = int((entry / "stat").read_text().rpartition(")")[2].split()[1]) == mpirun
            if is_child and os.path.samefile(entry / "exe", tipp):  # otherwise it is still a copy of mpirun
                found.append(int(entry.name))
        except (OSError, IndexError, ValueError):
            pass
    return sorted(found)


def send(number, pid):
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


def disturb(random, run, ranks, seconds, tipp):
    """Disturbs a rank of the run, and returns the signal."""
    while run.poll() is None and len(ranks_of(run.pid, tipp)) < ranks:
        time.sleep(0.005)
    time.sleep(random.uniform(0, seconds))
    processes = ranks_of(run.pid, tipp)
    number = random.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGSTOP])
    if not processes:
        return number
    rank = random.choice(processes)
    send(number, rank)
    if number == signal.SIGSTOP:
        time.sleep(random.uniform(0, 0.5))
        send(signal.SIGCONT, rank)
    return number


def finish(run, what, tipp):
    """Waits for the end. Sometimes Open MPI's mpirun does not notice that all its ranks have ended. Then it is killed,
    and this does not count as a failure of the tool."""
    end = time.monotonic() + LIMIT
    lonely = 0
    while True:
        try:
            output, error = run.communicate(timeout=1)
            return campaign.Result([what], run.returncode, output, error, 0)
        except subprocess.TimeoutExpired as expired:
            living = ranks_of(run.pid, tipp)
            lonely = 0 if living else lonely + 1
            if lonely == 5:
                run.kill()
            elif time.monotonic() > end:
                for rank in living:
                    send(signal.SIGKILL, rank)
                run.kill()
                run.communicate()
                raise campaign.Failure(f"{what}: still running after {LIMIT} s") from expired


def worse_input(random, scene, data, folder):
    """The input for one rank: missing, or truncated."""
    path = folder / "other" / data
    path.parent.mkdir()
    source = scene.base / data
    if random.random() < 0.5:
        return path
    shutil.copytree(source, path) if source.is_dir() else shutil.copy(source, path)
    files = [path] if path.is_file() else [file for file in path.rglob("*") if file.is_file()]
    victim = random.choice(files)
    os.truncate(victim, random.randrange(victim.stat().st_size or 1))
    return path


def leftovers(folder, output):
    return sorted(entry.name for entry in folder.iterdir() if entry.name not in (output, "other"))


def check_end(result, made, expected, is_only_stopped, what):
    if result.code == 0 and made != expected:
        raise campaign.Failure(f"{what}: success, but the output is another one\n  {result.error}")
    if result.code != 0 and made is not None and made != expected:
        raise campaign.Failure(f"{what}: a partial output\n  {result.error}")
    if result.code != 0 and is_only_stopped:
        raise campaign.Failure(f"{what}: {result}")
    if campaign.INTERNAL.search("\n".join(line for line in result.error.splitlines() if line.startswith("tipp:"))):
        raise campaign.Failure(f"{what}: {result}\n  its message shows internals")


def trial(random, folder, tools):
    base = folder.parent / "scene"
    if not hasattr(trial, "scene"):
        trial.scene = Scene(base, tools)
    scene = trial.scene
    name = random.choice(list(COMMANDS))
    ranks = random.choice([2, 2, 3, 4])
    _, data, output, resume = COMMANDS[name]
    expected, seconds = scene.of(name, ranks)
    if random.random() < 0.2:
        what = f"{name} on {ranks} ranks, another input on one"
        command = command_line(scene, name, ranks, folder, other=worse_input(random, scene, data, folder))
        run = subprocess.Popen(command, env=ENVIRONMENT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        number = None
    else:
        command = command_line(scene, name, ranks, folder)
        run = subprocess.Popen(command, env=ENVIRONMENT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        number = disturb(random, run, ranks, seconds, tools.tipp)
        what = f"{name} on {ranks} ranks, {number.name}"
    result = finish(run, what, tools.tipp)
    made = output_of(folder / output)
    check_end(result, made, expected, number == signal.SIGSTOP, what)
    again = campaign.run(command_line(scene, name, ranks, folder, more=resume), env=ENVIRONMENT, memory=0,
                         timeout=LIMIT)
    if again.code != 0:
        raise campaign.Failure(f"{what}: the next run fails: {again}")
    if output_of(folder / output) != expected:
        raise campaign.Failure(f"{what}: the next run's output is another one")
    if leftovers(folder, output):
        raise campaign.Failure(f"{what}: the next run leaves {leftovers(folder, output)}")
    return 2


if __name__ == "__main__":
    sys.exit(campaign.main("ranks", trial, __doc__))
