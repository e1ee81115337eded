# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's window must load the plugin automatically, and show the filters without a warning.

The pictures stay in the scratch folder. Documentation/Pictures/paraview.png and range.png were made by this test.
"""
import shutil

import numpy as np

from run_paraview import COMPLAINT, Session, expect, skip
from window import photograph, save_png

session = Session(__doc__)
if not shutil.which("paraview"):
    skip("there is no paraview")
surge = session.data / "adcirc/ec95d"
if surge.exists():
    session.tipp("flatten", surge / "ec95d.grd", "-o", session.scratch / "surge", "--values", surge / "maxele.63")
    array, colours = "maxele", (0, 2.5)
else:
    points = session.scratch / "points.npy"
    session.tipp("points", "--distribution", "clustered", "--count", "20000", "--seed", "7", "-o", points)
    session.tipp("delaunay", points, "-o", session.scratch / "mesh.vtu")
    session.tipp("partition", session.scratch / "mesh.vtu", "-o", session.scratch / "surge")
    array, colours = "vtkValidPointMask", (0, 1)
# The reader with a range. The window shows the range as a box.
RANGE = """
mesh.UseRange = 1
mesh.RangePosition = [-80, 25, 0]
mesh.RangeScale = [15, 15, 0.1]
mesh.UpdatePipeline()
print("in the range:", mesh.GetDataInformation().GetNumberOfCells())
SetActiveSource(mesh)
Hide(image, view)
Show(mesh, view)
"""
for name, more in (("paraview", ""), ("range", RANGE if surge.exists() else "")):
    rows, text = photograph(session.plugin, session.environment(), session.scratch / name,
                            session.scratch / "surge", array, colours=colours, more=more)
    print(text)
    save_png(rows, session.scratch / f"{name}.png")
    expect("information: (0, 1023," in text, "the filter made no image")
    expect(not COMPLAINT.search(text), "the client warned or failed, see above")
    # The view in the middle must have more colours than an empty view.
    view = rows[200:700, 500:1200].reshape(-1, 3)
    expect(len(np.unique(view, axis=0)) > 50, "the view is empty")
