# SPDX-License-Identifier: BSD-3-Clause
"""Fails if the libraries or the tool were compiled with a CGAL header under the GPL.

CGAL's kernels and number types are LGPL, but many of its algorithms are GPL; each header states its licence.

Usage: check_licences.py NINJA BUILD_DIR
"""
import pathlib
import re
import subprocess
import sys

SHIPPED = ("Accelerators/", "IO/", "Filters/", "Tools/")
GPL = re.compile(r"SPDX-License-Identifier:.*(?<!L)GPL")


def headers_of_shipped_objects(listing):
    """Pairs of an object and a header, from `ninja -t deps`: lines 'object: ...', followed by indented headers."""
    shipped = None
    for line in listing.splitlines():
        if line.startswith(" "):
            if shipped:
                yield shipped, line.strip()
        elif ": #deps" in line:
            target = line.split(": #deps")[0]
            shipped = target if target.startswith(SHIPPED) else None


def is_gpl(path):
    return bool(GPL.search(pathlib.Path(path).read_text(errors="replace")))


def main():
    ninja, build = sys.argv[1:]
    listing = subprocess.run([ninja, "-C", build, "-t", "deps"], check=True,
                             capture_output=True, text=True).stdout
    users = {}
    for target, header in headers_of_shipped_objects(listing):
        users.setdefault(header, target)
    if not users:
        sys.exit(f"No dependencies of shipped objects in {build}; is it built?")
    bad = [h for h in sorted(users) if "/CGAL/" in h and is_gpl(h)]
    for header in bad:
        print(f"{users[header]} includes {header}, which is under the GPL.")
    print(f"{len(users)} headers of shipped objects, {len(bad)} of them under the GPL.")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
