# SPDX-License-Identifier: BSD-3-Clause
"""Full disks: outputs must be complete or absent, old outputs stay, and no file of the user is removed.

A disk is a small tmpfs of random size. If none can be mounted, which takes root, a limit on the size of files is used
instead; the last line says so.
"""
import os
import pathlib
import resource
import shlex
import subprocess
import sys
import tempfile

import campaign
from campaign import Failure, contents, require_clear_end

MOUNTS = None  # whether a tmpfs can be mounted; None before the first try
KEPT = (".part",)  # work files that the message tells how to resume


def mount(folder, size):
    return subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)],
                          capture_output=True).returncode == 0


def prepare(tools):
    """Points and meshes that all trials read. They are made once per process."""
    global MOUNTS
    if prepare.folder is None:
        prepare.keeper = tempfile.TemporaryDirectory(prefix="tipp-disk-inputs-")
        prepare.folder = pathlib.Path(prepare.keeper.name)
        for count in (300, 3000, 12000):
            points = prepare.folder / f"points{count}.npy"
            mesh = prepare.folder / f"mesh{count}.vtu"
            for command in (["points", "--distribution", "clustered", "--count", count, "-o", points],
                            ["delaunay", points, "-o", mesh], ["flatten", mesh, "-o", prepare.folder / f"flat{count}"]):
                done = campaign.run([tools.tipp, *command])
                if done.code != 0:
                    raise Failure(str(done))
        disk = prepare.folder / "disk"
        disk.mkdir()
        MOUNTS = mount(disk, "64k")
        if MOUNTS:
            subprocess.run(["umount", str(disk)], check=True)
        else:
            print("disk: no tmpfs can be mounted here, so a limit on the size of files stands for a full disk")
    return prepare.folder


prepare.folder = None


def choose(random, inputs, disk, other):
    """A command, its output, the command that checks the output, and its approximate size in bytes."""
    count = random.choice((300, 3000, 12000))
    points, mesh, flat = (inputs / f"{name}" for name in (f"points{count}.npy", f"mesh{count}.vtu", f"flat{count}"))
    kind = random.choice(("npy", "vtp", "vtu", "tipp", "tipp", "space", "scratch", "vti", "partition", "partition-vtu",
                          "flatten", "points", "stats"))
    output = disk / {"scratch": "out.tipp", "space": "out.tipp", "partition": "out.tipp", "partition-vtu": "out.tipp",
                     "flatten": "out", "points": "out.npy", "stats": "out.json"}.get(kind, f"out.{kind}")
    if kind in ("npy", "vtp", "vtu"):
        return ["delaunay", points, "-o", output], output, ["check", points, output], 90 * count
    if kind == "tipp":
        return ["delaunay", points, "-o", output, "--memory", "2M"], output, ["check", points, output], 200 * count
    if kind == "space":
        points = f"uniform:{count}"
        return ["delaunay3d", points, "-o", output, "--memory", "1M"], output, ["check", points, output], 400 * count
    if kind == "scratch":
        output = other / "out.tipp"
        command = ["delaunay", points, "-o", output, "--memory", "2M", "--scratch", disk]
        return command, output, ["check", points, output], 40 * count
    if kind == "vti":
        return (["resample", mesh, "--dims", 70, 70, 1, "-o", output], output,
                ["delaunay", output, "-o", other / "read.npy"], 70 * 70 * 4)
    if kind == "partition":
        return (["partition", flat, "-o", output, "--tiling", "grid:2x2"], output, ["check", points, output],
                200 * count)
    if kind == "partition-vtu":
        return (["partition", mesh, "-o", output, "--tiling", "grid:2x2"], output, ["check", points, output],
                300 * count)
    if kind == "flatten":
        return (["flatten", mesh, "-o", output], output,
                ["resample", output, "--dims", 5, 5, 1, "-o", other / "read.vti"], 60 * count)
    if kind == "points":
        return (["points", "--distribution", "uniform", "--count", count, "-o", output], output,
                ["delaunay", output, "-o", other / "read.npy"], 16 * count)
    return (["delaunay", points, "-o", other / "ids.npy", "--stats", output], output, None, 2000)


def run_limited(command, size):
    """Runs with files of at most `size` bytes instead of on a small disk."""
    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    words = [str(word) for word in command]
    done = subprocess.run(["/bin/sh", "-c", "trap '' XFSZ; exec " + shlex.join(words)], capture_output=True,
                          text=True, timeout=120, preexec_fn=limit)
    return campaign.Result(words, done.returncode, done.stdout, done.stderr, 0)


def make_old(random, tools, inputs, output):
    """Sometimes makes an output that the tool may replace, and sometimes puts a file of the user into it."""
    if random.random() < 0.5:
        return
    if output.suffix == ".tipp":
        command = ["partition", inputs / "flat300", "-o", output, "--tiling", "grid:1x2"]
        campaign.run([tools.tipp, *command])
        if random.random() < 0.2 and output.exists():
            (output / "notes.txt").write_text("mine")
    elif output.suffix:
        try:
            output.write_text("old")
        except OSError:
            pass


def require_whole_or_absent(result, before, disk, other, output, check, tools):
    after = {**{("disk", k): v for k, v in contents(disk).items()}, **{("other", k): v for k, v in contents(other).items()}}
    where = "disk" if output.is_relative_to(disk) else "other"
    name = output.name

    def is_output(key):
        return key[0] == where and (key[1] == name or key[1].startswith(name + "/"))
    if result.code == 0:
        if check is not None:
            checked = campaign.run([tools.tipp, *check])
            if checked.code != 0:
                raise Failure(f"{result}\n  but its output is refused: {checked}")
        elif not after.get((where, name), b"").rstrip().endswith(b"}"):
            raise Failure(f"{result}\n  but its output is cut")
    elif {k: v for k, v in before.items() if is_output(k)} != {k: v for k, v in after.items() if is_output(k)}:
        raise Failure(f"{result}\n  but the old output is changed")
    gone = [k for k, v in before.items() if not is_output(k) and after.get(k) != v]
    if gone:
        raise Failure(f"{result}\n  but other files are changed: {gone}")
    new = [k for k in after if k not in before and not is_output(k) and k != ("other", "ids.npy")]
    kept = result.code != 0 and "--memory" in map(str, result.command)
    left = [k for k in new if not (kept and k[1].split("/")[0].endswith(KEPT))]
    if left:
        raise Failure(f"{result}\n  but it left {left}")


def trial(random, folder, tools):
    inputs = prepare(tools)
    disk, other = folder / "disk", folder / "other"
    disk.mkdir()
    other.mkdir()
    command, output, check, needed = choose(random, inputs, disk, other)
    size = 4096 * max(1, int(needed * random.uniform(0, 2)) // 4096)
    if MOUNTS and not mount(disk, size):
        raise Failure("the disk cannot be mounted")
    try:
        (other / "user.txt").write_text("mine")
        make_old(random, tools, inputs, output)
        before = {**{("disk", k): v for k, v in contents(disk).items()},
                  **{("other", k): v for k, v in contents(other).items()}}
        ranks = 2 if tools.mpiexec and command[0] in ("delaunay", "partition") and random.random() < 0.15 else 1
        words = [tools.tipp, *command]
        if ranks > 1:
            words = [tools.mpiexec, "--oversubscribe", "--bind-to", "none", "-np", ranks, *words]
        result = campaign.run(words, memory=None) if MOUNTS else run_limited(words, size)
        require_clear_end(result, (0, 1))
        require_whole_or_absent(result, before, disk, other, output, check, tools)
    finally:
        if MOUNTS:
            subprocess.run(["umount", "-l", str(disk)], check=False)
    return 1


if __name__ == "__main__":
    os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
    os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
    sys.exit(campaign.main("disk", trial, __doc__.splitlines()[0]))
