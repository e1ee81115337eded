# SPDX-License-Identifier: BSD-3-Clause
"""Triangulates points, writes a partitioned mesh, reads a range of it, and makes an image and a picture, on any ranks.

Usage: [mpirun -np N] pvbatch made_terrain.py FOLDER [POINTS]
If TIPP_PLUGIN_DIR is set, loads the plugin TIPPPlugin.so from that folder.
"""
import os
import sys

from paraview.simple import *
from paraview.servermanager import vtkProcessModule

FOLDER = sys.argv[1]
COUNT = int(sys.argv[2]) if len(sys.argv) > 2 else 20000

# Rank r makes the points r, r + size, r + 2 size and so on.
POINTS = f"""
import numpy as np
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.vtkCommonCore import vtkPoints
from paraview.servermanager import vtkProcessModule
module = vtkProcessModule.GetProcessModule()
rank, size = module.GetPartitionId(), module.GetNumberOfLocalPartitions()
xy = np.random.default_rng(3).random(({COUNT}, 2))[rank::size]
height = np.sin(9 * xy[:, 0]) * np.cos(7 * xy[:, 1]) + 0.3 * np.sin(40 * xy[:, 0] * xy[:, 1])
points = vtkPoints()
points.SetData(dataset_adapter.numpyTovtkDataArray(np.column_stack([xy, 0 * height])))
output.SetPoints(points)
output.PointData.append(height, "height")
"""


def main():
    if "TIPP_PLUGIN_DIR" in os.environ:
        LoadPlugin(os.path.join(os.environ["TIPP_PLUGIN_DIR"], "TIPPPlugin.so"), remote=False, ns=globals())
    first = vtkProcessModule.GetProcessModule().GetPartitionId() == 0

    points = ProgrammableSource(OutputDataSetType="vtkPolyData", Script=POINTS)
    triangles = TIPPDelaunay2D(Input=points)
    SaveData(os.path.join(FOLDER, "terrain.tipp"), proxy=triangles, Tiling="grid:4x4")

    part = TIPPReader(FileName=os.path.join(FOLDER, "terrain.tipp"))
    part.UseRange = 1
    part.RangePosition = [0.2, 0.2, 0]
    part.RangeScale = [0.6, 0.4, 0]
    image = RangeResample(Input=part)
    image.UseInputBounds = 0
    image.SamplingBounds = [0.2, 0.8, 0.2, 0.6, 0, 0]
    image.SamplingDimensions = [301, 201, 1]
    SaveData(os.path.join(FOLDER, "terrain.pvti"), proxy=image)

    view = CreateView("RenderView")
    view.ViewSize = [600, 400]
    view.OrientationAxesVisibility = 0
    view.InteractionMode = "2D"
    display = Show(image, view)
    display.SetRepresentationType("Slice")
    ColorBy(display, ("POINTS", "height"))
    colours = GetColorTransferFunction("height")
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(-1.3, 1.3)
    display.SetScalarBarVisibility(view, False)
    view.CameraPosition = [0.5, 0.4, 2]
    view.CameraFocalPoint = [0.5, 0.4, 0]
    view.CameraParallelScale = 0.2
    SaveScreenshot(os.path.join(FOLDER, "terrain.png"), view)

    cells = triangles.GetDataInformation().GetNumberOfCells()
    read = part.GetDataInformation().GetNumberOfCells()
    if first:
        print(f"{cells} triangles, {read} of them in the range")


main()
