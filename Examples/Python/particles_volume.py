# SPDX-License-Identifier: BSD-3-Clause
"""Samples the temperature of particles in space on a volume, and draws three sections through it.

Usage: particles_volume.py PARTICLES.ex2 PICTURE.png [SAMPLES]      (SAMPLES: along each axis; default 200)
"""
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOExodus import vtkExodusIIReader

import tipp
from pictures import ANOMALY, coloured, save_png


def read_particles(path):
    """Returns the positions and temperatures of all points of an Exodus II file; its cells are not used."""
    reader = vtkExodusIIReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    reader.SetAllArrayStatus(vtkExodusIIReader.NODAL, 1)
    reader.Update()
    block = reader.GetOutput().GetBlock(0).GetBlock(0)
    return vtk_to_numpy(block.GetPoints().GetData()), vtk_to_numpy(block.GetPointData().GetArray("Temp"))


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    samples = int(sys.argv[3]) if len(sys.argv) == 4 else 200
    points, temperature = read_particles(sys.argv[1])

    mesh = tipp.delaunay_3d(points, point_data={"temperature": temperature})
    image = tipp.resample(mesh, dimensions=(samples, samples, samples), null_value=np.nan)
    volume = tipp.as_array(image, "temperature")

    cuts = [volume[samples // 2], volume[:, samples // 2], volume[:, :, samples // 2]]
    low, high = np.nanpercentile(volume, [1, 99])
    save_png(sys.argv[2], coloured(np.hstack(cuts), ANOMALY, low, high))
    print(f"{len(points)} particles, {len(mesh.cells)} tetrahedra, {samples}^3 samples, "
          f"temperatures from {np.nanmin(volume):.1f} to {np.nanmax(volume):.1f}")


if __name__ == "__main__":
    main()
