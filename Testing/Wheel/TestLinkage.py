# SPDX-License-Identifier: BSD-3-Clause
"""What the wheel's extension module needs of a system: no more than its tag says."""
import re
import shutil
import subprocess
import sys
import unittest

from tipp import _core


def readelf(*options):
    return subprocess.run(["readelf", "--wide", *options, _core.__file__], check=True, capture_output=True, text=True).stdout


def needed_symbols():
    """Pairs of a symbol that other libraries must have, and its version or None."""
    found = re.findall(r"\sGLOBAL\s+DEFAULT\s+UND\s+(\S+?)(?:@(\S+))?(?:\s|$)", readelf("--dyn-syms"))
    return [(name, version or None) for name, version in found]


@unittest.skipUnless(sys.platform == "linux" and shutil.which("readelf"), "readelf is not installed")
class Linkage(unittest.TestCase):
    def test_it_needs_no_library_beside_those_of_every_system(self):
        libraries = set(re.findall(r"\(NEEDED\).*\[(\S+?)\.so", readelf("--dynamic")))
        # The wheel brings libdeflate along where there was no static one.
        libraries = {name for name in libraries if not name.startswith("libdeflate")}
        self.assertLessEqual(libraries, {"libc", "libm", "libpthread", "libdl", "libgcc_s", "libstdc++", "ld-linux-x86-64",
                                         "ld-linux-aarch64"})

    def test_it_needs_no_later_c_library_than_its_tag_says(self):
        versions = {version for _, version in needed_symbols() if version and version.startswith("GLIBC_")}
        numbers = {tuple(map(int, version.split("_")[1].split("."))) for version in versions}
        self.assertGreater(len(numbers), 0)
        self.assertLessEqual(max(numbers), (2, 28))

    def test_all_symbols_without_a_version_are_of_python(self):
        names = [name for name, version in needed_symbols() if version is None]
        self.assertEqual([], [name for name in names if not re.match(r"_?Py|libdeflate_", name)])
        self.assertGreater(len(names), 0)


if __name__ == "__main__":
    unittest.main()
