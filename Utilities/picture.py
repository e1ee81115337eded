# SPDX-License-Identifier: BSD-3-Clause
"""Draws a triangulation: all of it, and beside it a close-up.

Usage: picture.py MESH.vtp PICTURE.png      (needs a display; xvfb-run -a gives one)
"""
import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers the renderer)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

SIZE = 560  # pixels of one square view
CLOSE_UP_POINTS = 4000
DARK = (0.03, 0.05, 0.12)


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    if mesh.GetNumberOfPolys() == 0:
        sys.exit(f"{path} holds no triangles, so there is nothing to draw.")
    return mesh


def longest_edges(xy, triangles):
    corners = xy[triangles]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)


def colours(half):
    """Returns colours by edge length: dark blue for a third of a view, over green, to pale yellow for a pixel or two."""
    stops = np.array([(1.0, 0.98, 0.75), (0.55, 0.85, 0.35), (0.05, 0.55, 0.50),
                      (0.07, 0.28, 0.48), (0.06, 0.12, 0.28)])
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetTableRange(np.log10(2 * half / SIZE), np.log10(2 * half / 3))
    for i, place in enumerate(np.linspace(0, len(stops) - 1, 256)):
        rgb = [np.interp(place, range(len(stops)), stops[:, k]) for k in range(3)]
        table.SetTableValue(i, *rgb, 1.0)
    return table


def view(mesh, centre, half, left, edges):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.SetLookupTable(colours(half))
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    if edges:
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(0.35, 0.62, 0.62)
    renderer = vtkRenderer()
    renderer.SetViewport(left, 0.0, left + 0.5, 1.0)
    renderer.SetBackground(*DARK)
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*centre, 0.0)
    camera.SetPosition(*centre, 1.0)
    camera.SetParallelScale(half)
    renderer.ResetCameraClippingRange()
    return renderer


def close_up(xy):
    """Returns the centre and half width of a square with about CLOSE_UP_POINTS points where they are dense."""
    counts, x, y = np.histogram2d(xy[:, 0], xy[:, 1], bins=48)
    i, j = np.unravel_index(np.argmax(counts), counts.shape)
    middle = np.array([x[i] + x[i + 1], y[j] + y[j + 1]]) / 2
    centre = xy[np.argmin(np.abs(xy - middle).max(axis=1))]
    nearness = np.abs(xy - centre).max(axis=1)
    rank = min(CLOSE_UP_POINTS, len(xy)) - 1
    return centre, np.partition(nearness, rank)[rank]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    mesh = read(sys.argv[1])
    xy = vtk_to_numpy(mesh.GetPoints().GetData())[:, :2].astype(float)
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    lengths = np.log10(longest_edges(xy, triangles))
    mesh.GetCellData().SetScalars(numpy_to_vtk(lengths, deep=True))

    low, high = xy.min(axis=0), xy.max(axis=0)
    centre, half = close_up(xy)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(2 * SIZE, SIZE)
    window.SetMultiSamples(8)
    window.AddRenderer(view(mesh, (low + high) / 2, 0.52 * (high - low).max(), 0.0, False))
    window.AddRenderer(view(mesh, centre, half, 0.5, True))
    window.Render()

    image = vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(sys.argv[2])
    writer.Write()
    if writer.GetErrorCode():
        sys.exit(f"The picture could not be written to {sys.argv[2]}; is the folder there and writable?")


if __name__ == "__main__":
    main()
