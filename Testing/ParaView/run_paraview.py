# SPDX-License-Identifier: BSD-3-Clause
"""Runs programs in ParaView with the plugin, for the tests in this folder."""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

from display import virtual_display

SKIPPED = 77
COMPLAINT = re.compile(r"WARN\||ERR\||FATL\||Warning|Traceback")


def skip(reason):
    print(f"Skipped: {reason}")
    sys.exit(SKIPPED)


class Session:
    def __init__(self, description):
        parser = argparse.ArgumentParser(description=description)
        for name in ("paraview", "source", "tool", "scratch", "data"):
            parser.add_argument("--" + name, type=pathlib.Path, required=True)
        parser.add_argument("--ranks", type=int, default=1)
        for name, value in vars(parser.parse_args()).items():
            setattr(self, name, value)
        found = sorted(self.paraview.glob("lib/paraview-*/plugins/TIPPPlugin/TIPPPlugin.so"))
        if not found:
            skip(f"{self.paraview} has no plugin; build it: sh Utilities/build.sh paraview")
        for program in ("pvbatch", "Xvfb"):
            if not shutil.which(program):
                skip(f"there is no {program}")
        self.plugin = found[-1].parent
        shutil.rmtree(self.scratch, ignore_errors=True)
        self.scratch.mkdir(parents=True)

    def data_file(self, name):
        """The path of a file of the real data; skips the test if the file does not exist."""
        path = self.data / name
        if not path.exists():
            skip(f"there is no {path}")
        return path

    def environment(self):
        folders = [self.paraview / "debian/python3-paraview/usr/lib/python3/dist-packages", self.plugin / "python"]
        return {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, folders)),
                "TIPP_PLUGIN_DIR": str(self.plugin), "OMP_NUM_THREADS": "1", "HOME": str(self.scratch)}

    def run(self, command, timeout=100):
        """The output of a command; the test fails if the command fails."""
        with virtual_display() as display:
            result = subprocess.run([str(c) for c in command], env={**self.environment(), "DISPLAY": display},
                                    text=True, timeout=timeout, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        print(result.stdout, flush=True)
        if result.returncode != 0:
            sys.exit(f"{command[0]} ended with {result.returncode}.")
        return result.stdout

    def pvbatch(self, script, *arguments):
        """Runs a script on the session's ranks and returns its output; other messages are failures."""
        mpirun = ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", self.ranks] if self.ranks > 1 else []
        output = self.run([*mpirun, "pvbatch", script, *arguments])
        expect(not COMPLAINT.search(output), "ParaView warned or failed, see above.")
        return output

    def tipp(self, *arguments):
        subprocess.run([str(a) for a in (self.tool, *arguments)], check=True)


def expect(condition, message):
    if not condition:
        sys.exit(message)


def parallel_image(path):
    """The arrays of an image that several ranks wrote."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPImageDataReader

    reader = vtkXMLPImageDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    data = image.GetPointData()
    return image, {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


def picture(path):
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def expect_picture(path, baseline, threshold=15.0):
    """Fails if a picture differs from its baseline."""
    from vtkmodules.vtkImagingCore import vtkImageDifference

    difference = vtkImageDifference()
    difference.SetInputData(picture(path))
    difference.SetImageData(picture(baseline))
    difference.Update()
    error = difference.GetThresholdedError()
    expect(error < threshold, f"{path} differs from {baseline} by {error}; the bound is {threshold}.")
