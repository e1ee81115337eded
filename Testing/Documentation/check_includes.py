# SPDX-License-Identifier: BSD-3-Clause
"""Checks that includes run one way, between folders and between files, and that Architecture.md's graph shows those of
folders: check_includes.py SOURCE

A file is a header with its source. Arrows that go back are listed, each with a reason, in back_includes.txt."""
import pathlib
import re
import sys

LAYERS = ("Accelerators", "IO", "Filters", "Tools")  # each may include those before it


def read_includes(source):
    """Returns pairs of files: one includes the other."""
    files = {
        path.relative_to(source).as_posix(): path
        for layer in LAYERS
        for path in (source / layer).rglob("*")
        if path.suffix in (".h", ".cxx", ".cl")
    }
    pairs = []
    for name, path in files.items():
        for included in re.findall(r'^\s*#\s*include\s+"([^"]+)"', path.read_text(encoding="utf-8"), re.M):
            found = [f"{layer}/{included}" for layer in reversed(LAYERS) if f"{layer}/{included}" in files]
            beside = (pathlib.PurePosixPath(name).parent / included).as_posix()
            found = [beside] if beside in files else found
            pairs += [(name, found[0])] if found else []
    return pairs


def arrows_between(pairs, group_of):
    """Returns for each group, such as a folder, the groups that its files include."""
    arrows = {}
    for including, included in pairs:
        a, b = group_of(including), group_of(included)
        arrows.setdefault(a, set())
        if a != b:
            arrows[a].add(b)
    return arrows


def find_cycle(arrows):
    """Returns the groups of a cycle, or an empty list."""
    done, path = set(), []

    def follow(group):
        if group in path:
            return path[path.index(group) :]
        if group not in done:
            path.append(group)
            for other in sorted(arrows.get(group, ())):
                cycle = follow(other)
                if cycle:
                    return cycle
            done.add(path.pop())
        return []

    for group in sorted(arrows):
        cycle = follow(group)
        if cycle:
            return cycle
    return []


def reaches(arrows, start, goal):
    seen, front = set(), [start]
    while front:
        group = front.pop()
        if group == goal:
            return True
        if group not in seen:
            seen.add(group)
            front += arrows.get(group, ())
    return False


def problems(pairs, listed):
    """Returns a sentence for each cycle, and for each listed arrow that closes none."""
    found = []
    for including, included in pairs:
        if LAYERS.index(including.split("/")[0]) < LAYERS.index(included.split("/")[0]):
            found.append(f"{including} includes {included}, which is in a higher layer.")
    unused = set(listed)
    for what, group_of in (
        ("folders", lambda file: file.rsplit("/", 1)[0]),
        ("files", lambda file: file.rsplit(".", 1)[0]),
    ):
        arrows = arrows_between(pairs, group_of)
        back = [arrow for arrow in listed if arrow[1] in arrows.get(arrow[0], ())]
        for a, b in back:
            arrows[a].remove(b)
        unused -= {(a, b) for a, b in back if reaches(arrows, b, a)}
        cycle = find_cycle(arrows)
        if cycle:
            found.append(f"These {what} include each other in a circle: {' -> '.join(cycle + cycle[:1])}.")
    return found + [f"back_includes.txt lists {a} -> {b}, which closes no circle; remove it." for a, b in sorted(unused)]


def read_list(path):
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    entries = [re.fullmatch(r"(\S+) -> (\S+): \S.*", line) for line in lines]
    if not all(entries):
        sys.exit("A line of back_includes.txt is not 'A -> B: reason'.")
    return [(entry[1], entry[2]) for entry in entries]


def read_graph(page):
    """Returns from the graph in Architecture.md which folders include which, without those reached through others."""
    graph, layer = {}, ""
    for line in page.partition("## The graph")[2].partition("\n## ")[0].splitlines():
        if re.fullmatch(r"    [A-Z]\w+", line):
            layer = line.strip()
        row = re.fullmatch(r"      (\w+) +(?:<- ([\w, ]*?)  +)?\S.*", line)
        if row:
            graph[f"{layer}/{row[1]}"] = {f"{layer}/{folder}" for folder in (row[2] or "").split(", ") if folder}
    return graph


def graph_problems(pairs, listed, page):
    """Compares the graph in Architecture.md with the includes between folders of a layer."""
    folders = lambda file: "/".join(file.split("/")[:2]) if file.count("/") > 1 else ""
    arrows = arrows_between(pairs, folders)
    arrows = {
        folder: {b for b in others if b and b.split("/")[0] == folder.split("/")[0]}
        for folder, others in arrows.items()
        if folder
    }
    for a, b in listed:
        arrows.get(a, set()).discard(b)
    direct = {
        folder: {b for b in others if not any(reaches(arrows, c, b) for c in others - {b})}
        for folder, others in arrows.items()
    }
    graph = read_graph(page)
    return [
        f"Architecture.md's graph says '{folder} <- {', '.join(sorted(graph.get(folder, ['nothing'])))}', "
        f"but it includes {', '.join(sorted(direct.get(folder, ['nothing']))) or 'no other'}."
        for folder in sorted(graph.keys() | direct.keys())
        if graph.get(folder) != direct.get(folder)
    ]


def main(source):
    pairs = read_includes(source)
    listed = read_list(pathlib.Path(__file__).with_name("back_includes.txt"))
    page = (source / "Documentation/Architecture.md").read_text(encoding="utf-8")
    found = problems(pairs, listed) + graph_problems(pairs, listed, page)
    if found or len(pairs) < 1000:
        sys.exit("\n".join(found) or "Too few includes were found.")
    # The check itself: a circle of two files, one of two folders, and a higher layer are found.
    for extra in (
        ("Filters/Engine/PartitionIndex.h", "Filters/Engine/Inbox.h"),
        ("Filters/Engine/PartitionIndex.h", "Filters/Triangulation/Tiling.h"),
        ("IO/Files/IOError.h", "Filters/Engine/PartitionIndex.h"),
    ):
        if not problems(pairs + [extra], listed):
            sys.exit(f"check_includes.py does not find that {extra[0]} must not include {extra[1]}.")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
