# SPDX-License-Identifier: BSD-3-Clause
"""A running simulation passes its values to ParaView's filters after each step, without files.

Usage: pvbatch time_loop.py FOLDER [STEPS]
If TIPP_PLUGIN_DIR is set, loads the plugin TIPPPlugin.so from that folder. The plugin's Python
package must be on PYTHONPATH.
"""
import os
import sys

import numpy as np
from paraview.simple import *

import tipp

FOLDER = sys.argv[1]
STEPS = int(sys.argv[2]) if len(sys.argv) > 2 else 3


def simulate(points, step):
    """Returns the heights of circular waves on water at a step."""
    distance = np.hypot(points[:, 0] - 0.5, points[:, 1] - 0.5)
    return np.sin(40 * distance - step) / (1 + 9 * distance)


def main():
    if "TIPP_PLUGIN_DIR" in os.environ:
        LoadPlugin(os.path.join(os.environ["TIPP_PLUGIN_DIR"], "TIPPPlugin.so"), remote=False, ns=globals())
    points = np.random.default_rng(1).random((20000, 3))
    points[:, 2] = 0
    level = np.zeros(len(points))  # memory of the simulation, which the mesh shares
    mesh = tipp.delaunay_2d(points, point_data={"level": level}, return_type="vtk")

    producer = TrivialProducer()
    producer.GetClientSideObject().SetOutput(mesh)
    image = RangeResample(Input=producer, SamplingDimensions=[200, 200, 1])
    view = CreateView("RenderView")
    view.ViewSize = [300, 300]
    display = Show(image, view)
    display.SetRepresentationType("Slice")
    ColorBy(display, ("POINTS", "level"))
    GetColorTransferFunction("level").RescaleTransferFunction(-0.5, 0.5)

    for step in range(STEPS):
        level[:] = simulate(points, step)
        mesh.GetPointData().GetArray("level").Modified()
        mesh.Modified()
        producer.MarkModified(producer.SMProxy)
        image.UpdatePipeline(step)
        low, high = image.PointData["level"].GetRange()
        print(f"step {step}: levels from {low:.3f} to {high:.3f}")
        SaveScreenshot(os.path.join(FOLDER, f"level-{step}.png"), view)


main()
