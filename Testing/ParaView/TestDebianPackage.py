# SPDX-License-Identifier: BSD-3-Clause
"""Unpacks the plugin's Debian package anywhere, and loads the plugin by the list of plugins in the package."""
import os
import shutil
import subprocess

from run_paraview import Session, expect, skip

PROGRAM = """
from paraview.simple import *
import tipp
mesh = TIPPDelaunay2D(Input=Plane())
mesh.UpdatePipeline()
print("loaded:", mesh.GetDataInformation().GetNumberOfCells(), tipp.__file__)
"""

session = Session(__doc__)
for program in ("cpack", "dpkg-deb", "dpkg-shlibdeps"):
    if not shutil.which(program):
        skip(f"there is no {program}")
folder = session.scratch / "packages"
subprocess.run(["cpack", "--config", session.paraview / "CPackConfig.cmake", "-B", folder], check=True)
packages = list(folder.glob("*.deb"))
expect(len(packages) == 1 and packages[0].name.startswith("paraview-tipp_"), f"the packages are {packages}")
root = session.scratch / "root"
subprocess.run(["dpkg-deb", "--extract", packages[0], root], check=True)
lists = list(root.rglob("tipp.plugins.xml"))
expect(len(lists) == 1, f"the lists of plugins are {lists}")

session.plugin = lists[0].parent / "TIPPPlugin"
os.environ["PV_PLUGIN_CONFIG_FILE"] = str(lists[0])
script = session.scratch / "package.py"
script.write_text(PROGRAM)
output = session.pvbatch(script)
expect(f"loaded: 2 {session.plugin}" in output, "the plugin or its Python package is not the package's")
