# SPDX-License-Identifier: BSD-3-Clause
"""Damages files of work folders, partitioned meshes and flat meshes, and then uses them.

A resumed run must make the same files as an uninterrupted one, byte for byte, or name the damaged file and keep all
work. `tipp check` must report any damage of a partitioned mesh. A reader must refuse the mesh, or return what it
returns for the undamaged one. Flat meshes have no checksums: there, a reader must only end clearly. A trial returns the
number of damaged folders.
"""
import pathlib
import random
import re
import shutil
import signal
import sys

from campaign import Failure, Tools, contents, main, require_clear_end, run, write_points_in_space
from kill import Killed, kill_at_call

FOLDERS = 8  # folders that a trial damages


def flip(rng, data):
    """Flips a random bit."""
    at = rng.randrange(len(data))
    return data[:at] + bytes([data[at] ^ (1 << rng.randrange(8))]) + data[at + 1:]


def cut(rng, data):
    """Cuts off the end."""
    return data[:-min(len(data), rng.choice((1, 8, 100, rng.randint(1, len(data)))))]


def append(rng, data):
    """Appends bytes."""
    return data + bytes(rng.randrange(256) for _ in range(rng.choice((1, 8, 100))))


def swap(rng, data):
    """Exchanges two blocks."""
    size = min(rng.choice((8, 64, 512, 4096)), len(data) // 2)
    first = rng.randint(0, len(data) - 2 * size)
    second = rng.randint(first + size, len(data) - size)
    return (data[:first] + data[second:second + size] + data[first + size:second] + data[first:first + size] +
            data[second + size:])


def empty(_rng, _data):
    """Leaves an empty file."""
    return b""


def remove(_rng, _data):
    """Removes the file."""
    return None


DAMAGES = (flip, flip, cut, append, swap, empty, remove)


def damage(rng, folder):
    """Damages one file. Returns its path in the folder and a description, or None if nothing has changed."""
    kinds = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            kinds.setdefault(re.sub(r"\d+", "", path.name), []).append(path)
    path = rng.choice(kinds[rng.choice(sorted(kinds))])
    data = path.read_bytes()
    how = rng.choice(DAMAGES if data else (append, remove))
    changed = how(rng, data)
    if changed == data:
        return None
    if changed is None:
        path.unlink()
    else:
        path.write_bytes(changed)
    name = str(path.relative_to(folder))
    return name, f"{how.__name__} of {name} ({len(data)} bytes)"


def make_points(rng, folder, tools, least, most):
    """Makes points.npy."""
    distribution = rng.choice(("uniform", "clustered", "coast", "lattice"))
    require_clear_end(run([tools.tipp, "points", "--distribution", distribution, "--count",
                           rng.randint(least, most) * 1000, "--seed", rng.randint(1, 1000), "-o", "points.npy"],
                          cwd=folder), (0,))


def count_of(folder):
    """The number of files in a folder, which a run may remove at any time."""
    try:
        return len(list(folder.iterdir()))
    except OSError:
        return 0


def make_work(rng, folder, tools, command):
    """Kills a run and leaves its work folder. Returns False if no run left one."""
    library = kill_at_call(tools)
    for _ in range(20):
        env = {}
        if library and rng.random() < 0.4:
            env = {"LD_PRELOAD": str(library), "TIPP_KILL_AT": str(rng.randint(3, 30))}
        killed = Killed(command, folder, env)
        pieces = folder / ".mesh.tipp.part/mesh.tipp/pieces"
        enough = rng.randint(1, 12)
        while not killed.wait(0.004):
            if not env and count_of(pieces) >= enough:
                killed.signal(signal.SIGKILL, rng)
        killed.end()
        if (folder / ".mesh.tipp.part/.plan").exists() and not (folder / "mesh.tipp").exists():
            return True
        for name in "mesh.tipp", ".mesh.tipp.part":
            shutil.rmtree(folder / name, ignore_errors=True)
    return False


def require_kept(before, after, result, what):
    """Fails if a failed run has lost something that the next run needs."""
    made_again = re.compile(r"^\.piece\.|\.next$")
    lost = [name for name in before if name not in after and not made_again.search(name)]
    lost += [name for name in before if name.startswith((".plan", ".points")) and before[name] != after.get(name)]
    if lost:
        raise Failure(f"{what}: {result}\n  lost or changed {', '.join(lost)}")


def work_trial(rng, folder, tools):
    """Damages work folders of killed runs."""
    if rng.random() < 0.4:
        write_points_in_space(rng, folder / "points.csv", rng.randint(15, 40) * 1000)
        command = [tools.tipp, "delaunay3d", "points.csv"]
    else:
        make_points(rng, folder, tools, 20, 60)
        command = [tools.tipp, "delaunay", "points.npy"]
    command += ["-o", "mesh.tipp", "--memory", f"{rng.randint(1, 3)}M", "--threads", rng.randint(1, 2)]
    command += ["--neighbors"] if rng.random() < 0.3 else []
    require_clear_end(run(command, cwd=folder), (0,))
    expected = contents(folder / "mesh.tipp")
    shutil.rmtree(folder / "mesh.tipp")
    if not make_work(rng, folder, tools, command):
        return 1
    work, good = folder / ".mesh.tipp.part", folder / "good"
    work.rename(good)
    for _ in range(FOLDERS):
        shutil.copytree(good, work)
        damaged = damage(rng, work)
        if not damaged:
            shutil.rmtree(work)
            continue
        name, what = damaged
        before = contents(work)
        result = run([*command, "--resume"], cwd=folder)
        require_clear_end(result, (0, 1))
        mesh = folder / "mesh.tipp"
        if result.code == 0:
            if contents(mesh) != expected:
                raise Failure(f"{what}: {result}\n  another mesh")
            if work.exists():
                raise Failure(f"{what}: {result}\n  leaves {work.name}")
            shutil.rmtree(mesh)
            continue
        if mesh.exists():
            raise Failure(f"{what}: {result}\n  has published a mesh")
        if name not in result.error:
            raise Failure(f"{what}: {result}\n  does not name the file")
        require_kept(before, contents(work), result, what)
        shutil.rmtree(work)
    return FOLDERS


def resample(tools, folder, mesh, bounds):
    """What a reader outputs for the mesh, and how it ended."""
    image = folder / "image.vti"
    image.unlink(missing_ok=True)
    result = run([tools.tipp, "resample", mesh, "-o", "image.vti", "--dims", 64, 64, 1, "--device", "openmp", *bounds],
                 cwd=folder)
    require_clear_end(result, (0, 1))
    return result, image.read_bytes() if image.exists() else None


def make_partitioned(rng, folder, tools):
    """Makes mesh.tipp with either command."""
    if rng.random() < 0.5:
        options = ["--neighbors"] if rng.random() < 0.5 else []
        options += ["--map-duplicates"] if rng.random() < 0.5 else []
        command = ["delaunay", "points.npy", "-o", "mesh.tipp", "--memory", "1M", *options]
    else:
        require_clear_end(run([tools.tipp, "delaunay", "points.npy", "-o", "mesh.vtu"], cwd=folder), (0,))
        command = ["partition", "mesh.vtu", "-o", "mesh.tipp", "--tiling", "grid:3x3", "--borrowers",
                   rng.choice(("reference", "duplicate"))]
    require_clear_end(run([tools.tipp, *command], cwd=folder), (0,))


def mesh_trial(rng, folder, tools):
    """Damages partitioned meshes."""
    make_points(rng, folder, tools, 5, 20)
    make_partitioned(rng, folder, tools)
    bounds = ["--bounds", 0.1, 0.4, 0.1, 0.5, 0, 0] if rng.random() < 0.4 else []
    _, expected = resample(tools, folder, "mesh.tipp", bounds)
    mesh, good = folder / "mesh.tipp", folder / "good"
    mesh.rename(good)
    for _ in range(FOLDERS):
        shutil.copytree(good, mesh)
        damaged = damage(rng, mesh)
        if damaged:
            name, what = damaged
            result = run([tools.tipp, "check", "points.npy", "mesh.tipp"], cwd=folder)
            require_clear_end(result, (1,))
            if name not in result.error:
                raise Failure(f"{what}: {result}\n  does not name the file")
            result, image = resample(tools, folder, "mesh.tipp", bounds)
            if result.code == 0 and image != expected:
                raise Failure(f"{what}: {result}\n  another image")
        shutil.rmtree(mesh)
    return FOLDERS


def flat_trial(rng, folder, tools):
    """Damages flat meshes."""
    make_points(rng, folder, tools, 5, 20)
    require_clear_end(run([tools.tipp, "delaunay", "points.npy", "-o", "mesh.vtu"], cwd=folder), (0,))
    require_clear_end(run([tools.tipp, "flatten", "mesh.vtu", "-o", "good"], cwd=folder), (0,))
    for _ in range(FOLDERS):
        shutil.copytree(folder / "good", folder / "flat")
        if damage(rng, folder / "flat"):
            if rng.random() < 0.5:
                resample(tools, folder, "flat", [])
            else:
                command = [tools.tipp, "partition", "flat", "-o", "mesh.tipp", "--threads", 2]
                require_clear_end(run(command, cwd=folder), (0, 1))
        shutil.rmtree(folder / "flat")
    return FOLDERS


def trial(rng: random.Random, folder: pathlib.Path, tools: Tools):
    """Makes a folder, and damages several copies of it in different ways."""
    return rng.choice((work_trial, work_trial, mesh_trial, mesh_trial, flat_trial))(rng, folder, tools)


if __name__ == "__main__":
    sys.exit(main("damage", trial, __doc__))
