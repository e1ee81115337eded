# SPDX-License-Identifier: BSD-3-Clause
"""Starts ParaView's window on a virtual display, where the plugin is loaded automatically, and takes a picture."""
import os
import struct
import subprocess
import time

import numpy as np

from display import virtual_display

# Runs in the client: shows the filters, and then writes a file that says so.
SCRIPT = """
from paraview.simple import *
mesh = TIPPReader(FileName={mesh!r})
view = GetActiveViewOrCreate("RenderView")
image = RangeResample(Input=mesh, SamplingDimensions=[1024, 0, 0], UseNoDataValue=1, registrationName="Range Resample")
display = Show(image, view)
display.SetRepresentationType("Slice")
ColorBy(display, ("POINTS", {array!r}))
display.SetScalarBarVisibility(view, True)
GetColorTransferFunction({array!r}).ApplyPreset({preset!r}, True)
GetColorTransferFunction({array!r}).RescaleTransferFunction(*{colours!r})
Hide(mesh, view)
view.InteractionMode = "2D"
view.OrientationAxesVisibility = 0
ResetCamera(view)
view.CameraParallelScale *= 0.65
SetActiveSource(image)
{more}
Render(view)
print("information:", image.GetDataInformation().GetExtent(), flush=True)
open({mark!r}, "w").close()
"""


def screen(path):
    """The pixels of a virtual display as RGB rows, from the file in which Xvfb keeps them (format XWD)."""
    data = path.read_bytes()
    header = struct.unpack(">25I", data[:100])
    size, width, height, row, colours = header[0], header[4], header[5], header[12], header[19]
    pixels = np.frombuffer(data, np.uint8, height * row, size + 12 * colours).reshape(height, row)
    return pixels[:, :4 * width].reshape(height, width, 4)[:, :, 2::-1]


def wait_for(condition, seconds, process):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end or process.poll() is not None:
            return False
        time.sleep(0.2)
    return True


def photograph(plugin, environment, scratch, mesh, array, preset="Viridis (matplotlib)", colours=(0, 1),
               more="", size=(1280, 800)):
    """The window's pixels as RGB rows, after the Python lines `more` have run, and the client's output."""
    scratch.mkdir()
    frames, mark = scratch / "frames", scratch / "shown"
    frames.mkdir()
    plugins = scratch / "plugins.xml"
    plugins.write_text(f'<?xml version="1.0"?>\n<Plugins><Plugin name="TIPPPlugin" '
                       f'filename="{plugin}/TIPPPlugin.so" auto_load="1"/></Plugins>\n')
    script = scratch / "window-script.py"
    script.write_text(SCRIPT.format(mesh=str(mesh), array=array, preset=preset, colours=colours, more=more,
                                    mark=str(mark)))
    log = scratch / "window.log"
    with virtual_display(size, frames) as display, open(log, "w", encoding="utf-8") as output:
        client = subprocess.Popen(
            ["paraview", "--dr", f"--script={script}", "-geometry", f"{size[0]}x{size[1]}+0+0"], stdout=output,
            stderr=subprocess.STDOUT, env={**environment, "DISPLAY": display, "PV_PLUGIN_CONFIG_FILE": str(plugins)})
        try:
            shown = wait_for(mark.exists, 80, client)
            time.sleep(4)  # panels are drawn later than the script runs
            picture = screen(frames / "Xvfb_screen0")
            text = log.read_text(encoding="utf-8")
        finally:
            client.terminate()
            try:
                client.wait(20)
            except subprocess.TimeoutExpired:
                client.kill()
                client.wait()
    if not shown:
        raise RuntimeError("ParaView's window did not show the filters; it said:\n" + text)
    return picture, text


def save_png(rows, path):
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOImage import vtkPNGWriter

    image = vtkImageData()
    image.SetDimensions(rows.shape[1], rows.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(rows[::-1]).reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(os.fspath(path))
    writer.SetInputData(image)
    writer.Write()
