# SPDX-License-Identifier: BSD-3-Clause
"""Documentation/UserGuide.md must describe every property of each class, in the section of the class.

Usage: TestUserGuide.py USER_GUIDE
"""
import inspect
import re
import sys
import unittest

import tipp

GUIDE = open(sys.argv.pop(1), encoding="utf-8").read()
SECTIONS = dict(re.findall(r"^## (\S+)\n(.*?)(?=^## |\Z)", GUIDE, re.MULTILINE | re.DOTALL))
# Methods that are short forms of others of the same class.
SHORTHAND = re.compile(r"(\w+)(On|Off|ToStages|ToDynamic|ToProducerConsumer|ToOwned|ToOwnedAndBorrowed)$")


def properties_of(cls):
    inherited = {name for base in cls.__mro__[1:] for name in vars(base)}
    own = [name for name in vars(cls) if name not in inherited]
    setters = {name[3:] for name in own if name.startswith("Set") and not SHORTHAND.match(name)}
    selections = {name[3:] for name in own if name.startswith("Get") and name.endswith("ArraySelection")}
    return setters | selections


class UserGuide(unittest.TestCase):
    def test_every_property_has_its_line(self):
        for name in (n for n, thing in vars(tipp).items() if n.startswith("vtk") and inspect.isclass(thing)):
            properties = properties_of(getattr(tipp, name))
            fewest = 4 if name in ("vtkTIPPCutFill", "vtkTIPPRemap") else 6
            self.assertGreater(len(properties), fewest, name)
            missing = [p for p in properties if not re.search(rf"\b{p}\b", SECTIONS[name])]
            self.assertEqual(missing, [], name)


if __name__ == "__main__":
    unittest.main()
