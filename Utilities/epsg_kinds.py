# SPDX-License-Identifier: BSD-3-Clause
"""Writes IO/Crs/EpsgRanges.h, the kinds of EPSG's codes, from the database of pyproj: epsg_kinds.py > IO/Crs/EpsgRanges.h"""
import os
import sqlite3
import textwrap

import pyproj

QUERIES = {
    "projected": "SELECT code FROM projected_crs WHERE auth_name = 'EPSG'",
    "geographic": "SELECT code FROM geodetic_crs WHERE auth_name = 'EPSG' AND type LIKE 'geographic%'",
    "vertical": "SELECT code FROM vertical_crs WHERE auth_name = 'EPSG'",
}


def ranges_of(codes):
    """Returns the first and the last of each range of successive codes."""
    ranges = []
    for code in sorted(code for code in codes if code < 1 << 15):
        if ranges and code == ranges[-1][1] + 1:
            ranges[-1][1] = code
        else:
            ranges.append([code, code])
    return ranges


def main():
    database = sqlite3.connect(os.path.join(pyproj.datadir.get_data_dir(), "proj.db"))
    (version,) = database.execute("SELECT value FROM metadata WHERE key = 'EPSG.VERSION'").fetchone()
    print("// SPDX-License-Identifier: BSD-3-Clause")
    print(f"// Made by Utilities/epsg_kinds.py from EPSG's data set {version}, https://epsg.org.")
    print("#ifndef tippEpsgRanges_h\n#define tippEpsgRanges_h\n")
    print("#include <cstdint>\n\nnamespace tipp\n{\n")
    print("/// Successive EPSG codes of systems of one kind.\nstruct EpsgRange\n{\n  std::int16_t First;\n  std::int16_t Last;\n};\n")
    print(f'constexpr const char* epsgVersion = "{version}";\n\n// clang-format off')
    for name, query in QUERIES.items():
        ranges = ranges_of(int(code) for (code,) in database.execute(query))
        text = ", ".join(f"{{{first},{last}}}" for first, last in ranges)
        print(f"constexpr EpsgRange {name}Codes[] = {{")
        print(textwrap.fill(text, 98, initial_indent="  ", subsequent_indent="  ") + " };")
    print("// clang-format on\n\n} // namespace tipp\n\n#endif")


main()
