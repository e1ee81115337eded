# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's window loads the plugin by itself, and shows the filters without a warning.

Its picture stays in the scratch folder; Documentation/Pictures/paraview.png was made so.
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
rows, text = photograph(session.plugin, session.environment(), session.scratch, session.scratch / "surge", array,
                        colours=colours)
print(text)
save_png(rows, session.scratch / "window.png")
expect("information: (0, 1023," in text, "the filter made no image")
expect(not COMPLAINT.search(text), "the client warned or failed, see above")
# The view in the middle shows more colours than a window without a picture has.
view = rows[200:700, 500:1200].reshape(-1, 3)
expect(len(np.unique(view, axis=0)) > 100, "the view is empty")
