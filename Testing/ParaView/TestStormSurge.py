# SPDX-License-Identifier: BSD-3-Clause
"""Examples/pvbatch/storm_surge.py on the EC95d grid must give the expected samples and the picture of the baseline."""
import numpy as np

from run_paraview import Session, expect, expect_picture, parallel_image

session = Session(__doc__)
grid, values = (session.data_file("adcirc/ec95d/" + name) for name in ("ec95d.grd", "maxele.63"))
session.tipp("flatten", grid, "-o", session.scratch / "surge", "--values", values)
session.pvbatch(session.source / "Examples/pvbatch/storm_surge.py", session.scratch / "surge", session.scratch)
_, arrays = parallel_image(session.scratch / "surge.pvti")

import tipp

expected = tipp.resample(tipp.read(session.scratch / "surge"), (-80, -70, 32, 42, 0, 0), (1000, 1000, 1),
                         no_data=-99999)
for name in ("vtkValidPointMask", "depth", "maxele"):
    np.testing.assert_array_equal(arrays[name], tipp.as_array(expected, name).ravel())
expect(200_000 < np.count_nonzero(arrays["vtkValidPointMask"]) < 900_000, "there is no coast")
expect_picture(session.scratch / "surge.png", session.source / "Data/Baselines/PvbatchSurge.png")
