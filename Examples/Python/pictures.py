# SPDX-License-Identifier: BSD-3-Clause
"""Makes pictures of grids for the examples, without a display."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

TERRAIN = [(0.16, 0.36, 0.30), (0.45, 0.60, 0.36), (0.85, 0.80, 0.58), (0.66, 0.48, 0.33), (0.98, 0.98, 0.97)]
ANOMALY = [(0.10, 0.20, 0.50), (0.30, 0.60, 0.85), (0.95, 0.95, 0.90), (0.95, 0.60, 0.30), (0.60, 0.05, 0.15)]


def coloured(grid, stops, low, high):
    """Returns RGB values from 0 to 1; white where the grid is NaN."""
    place = np.clip((np.nan_to_num(grid) - low) / (high - low), 0, 1) * (len(stops) - 1)
    rgb = np.stack([np.interp(place, range(len(stops)), channel) for channel in zip(*stops)], axis=-1)
    return np.where(np.isnan(grid)[..., None], 1.0, rgb)


def lit(rgb, grid, steepness):
    """Shades the colours as if light from the north-west fell on the grid's surface."""
    dy, dx = np.gradient(np.nan_to_num(grid, nan=np.nanmean(grid)) * steepness)
    brightness = (1 - dx + dy) / np.sqrt(3 * (1 + dx * dx + dy * dy))
    return np.clip(rgb * (0.35 + 1.1 * np.clip(brightness, 0, 1)[..., None]), 0, 1)


def save_png(path, rgb):
    """Writes a PNG file. Rows are from south to north, as in VTK."""
    image = vtkImageData()
    image.SetDimensions(rgb.shape[1], rgb.shape[0], 1)
    pixels = np.ascontiguousarray((255 * rgb).astype(np.uint8)).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels))
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    writer.Write()
    if writer.GetErrorCode():
        raise OSError(f"{path} could not be written; is the folder there?")
