# SPDX-License-Identifier: BSD-3-Clause
"""The plugin must contain every icon that its proxies name as an SVG, and no others."""
import re
import xml.etree.ElementTree as ElementTree

from run_paraview import Session, expect

# Icons are Qt resources, so the test queries Qt.
PROGRAM = """
import ctypes, os, pathlib
from paraview.simple import *
PLUGIN = os.path.join(os.environ["TIPP_PLUGIN_DIR"], "TIPPPlugin.so")
IS_QT6 = b"libQt6Core.so.6" in pathlib.Path(PLUGIN).read_bytes()
qt = ctypes.CDLL("libQt6Core.so.6" if IS_QT6 else "libQt5Core.so.5")

def is_there(path):
    string = (ctypes.c_void_p * 3)()
    if IS_QT6:  # QString::fromLatin1(QByteArrayView), a length and a pointer
        qt._ZN7QString10fromLatin1E14QByteArrayView(ctypes.byref(string), ctypes.c_ssize_t(len(path)), path.encode())
    else:
        qt._ZN7QString15fromUtf8_helperEPKci(ctypes.byref(string), path.encode(), len(path))
    exists = qt._ZN5QFile6existsERK7QString
    exists.restype = ctypes.c_bool
    return exists(ctypes.byref(string))

NAMES = %r
print("before:", [name for name in NAMES if is_there(name)])
LoadPlugin(PLUGIN, remote=False, ns=globals())
print("missing:", [name for name in NAMES if not is_there(name)])
"""


def named_icons(folder):
    names = set()
    for file in folder.glob("*.xml"):
        root = ElementTree.parse(file).getroot()
        names |= {hint.get("icon") for hint in root.iter("ShowInMenu")}
        names |= {hint.get("name") for hint in root.iter("PipelineIcon")}
    return names


session = Session(__doc__)
folder = session.source / "Plugins/TIPPPlugin"
names = named_icons(folder)
drawn = {":/TIPP/Icons/" + file.name for file in (folder / "Icons").iterdir()}
expect(names == drawn, f"named are {sorted(names)}, drawn {sorted(drawn)}")
for file in (folder / "Icons").iterdir():
    expect(re.search(r"}svg$", ElementTree.parse(file).getroot().tag), f"{file} is no SVG")
script = session.scratch / "icons.py"
script.write_text(PROGRAM % sorted(names))
lines = session.pvbatch(script).splitlines()
expect("before: []" in lines, "the icons are there without the plugin")
expect("missing: []" in lines, "icons are missing in the plugin, see above")
