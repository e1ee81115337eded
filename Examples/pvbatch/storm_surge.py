# SPDX-License-Identifier: BSD-3-Clause
"""Samples the highest water levels of a storm surge on a grid, and draws them over the depth of the sea.

Usage: [mpirun -np N] pvbatch storm_surge.py MESH FOLDER
MESH needs the arrays depth and maxele; it can be made by:  tipp flatten fort.14 -o MESH --values maxele.63
If TIPP_PLUGIN_DIR is set, loads the plugin TIPPPlugin.so from that folder.
"""
import os
import sys

from paraview.simple import *

MESH, FOLDER = sys.argv[1:3]
RANGE = [-80.0, -70.0, 32.0, 42.0, 0.0, 0.0]  # longitude and latitude: North Carolina to New England


def resampled(mesh):
    """Returns the arrays at 1000 x 1000 samples; cells with a dry corner are left out."""
    image = RangeResample(Input=mesh)
    image.UseInputBounds = 0
    image.SamplingBounds = RANGE
    image.SamplingDimensions = [1000, 1000, 1]
    image.UseNoDataValue = 1
    image.NoDataValue = -99999
    return image


def only_water(image):
    """Returns the samples that are in a cell of the mesh."""
    water = Threshold(Input=image, Scalars=["POINTS", "vtkValidPointMask"])
    water.LowerThreshold = water.UpperThreshold = 1
    return water


def main():
    if "TIPP_PLUGIN_DIR" in os.environ:
        LoadPlugin(os.path.join(os.environ["TIPP_PLUGIN_DIR"], "TIPPPlugin.so"), remote=False, ns=globals())
    mesh = TIPPReader(FileName=MESH)
    image = resampled(mesh)
    SaveData(os.path.join(FOLDER, "surge.pvti"), proxy=image)
    water = only_water(image)
    high_water = Threshold(Input=water, Scalars=["POINTS", "maxele"])
    high_water.LowerThreshold = 0.6
    high_water.UpperThreshold = 100

    view = CreateView("RenderView")
    view.ViewSize = [700, 700]
    view.OrientationAxesVisibility = 0
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.InteractionMode = "2D"
    for source, array, preset, low, high in (
        (water, "depth", "X Ray", 0, 4000),
        (high_water, "maxele", "Viridis (matplotlib)", 0.6, 2.5),
    ):
        display = Show(source, view)
        ColorBy(display, ("POINTS", array))
        colours = GetColorTransferFunction(array)
        colours.ApplyPreset(preset, True)
        colours.RescaleTransferFunction(low, high)
    display.Position = [0, 0, 0.1]  # draw the water levels above the depth
    view.CameraPosition = [-75, 37, 40]
    view.CameraFocalPoint = [-75, 37, 0]
    view.CameraParallelScale = 5
    SaveScreenshot(os.path.join(FOLDER, "surge.png"), view)


main()
