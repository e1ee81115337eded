# SPDX-License-Identifier: BSD-3-Clause
"""The out-of-core triangulation of files in ParaView: all ranks make the mesh and read it."""
import numpy as np

from run_paraview import Session, expect

PROGRAM = """
import os, sys
import tipp  # whose classes client-side objects are then seen as
from paraview.simple import *
LoadPlugin(os.path.join(os.environ["TIPP_PLUGIN_DIR"], "TIPPPlugin.so"), remote=False, ns=globals())
first, second, folder = sys.argv[1:]

run = TIPPOutOfCoreDelaunay2D()
print("defaults:", run.MemoryLimit, run.Resume, list(run.NumberOfPartitions), len(run.InputFileNames or []))
run.InputFileNames = [first, second]
run.FileName = folder
run.MemoryLimit = 5000000000
run.NumberOfPartitions = [3, 2]
run.NumberOfThreads = 1
run.UpdatePipeline()
print("limit set:", run.GetClientSideObject().GetMemoryLimit())
print("output:", run.GetDataInformation().GetDataClassName())
totals = servermanager.Fetch(run).GetFieldData()
for name in ("Points", "Pieces", "Resumed"):
    print(name + ":", int(totals.GetArray(name).GetTuple1(0)))
triangles = int(totals.GetArray("Triangles").GetTuple1(0))

mesh = TIPPReader(FileName=folder)
mesh.UpdatePipeline()
owned = RemoveGhostInformation(Input=mesh)
owned.UpdatePipeline()
read = owned.GetDataInformation().GetNumberOfCells()
print("all triangles read:", read == triangles and read > 9900)

# Another choice makes it anew, and takes the folder's place.
run.Resume = 1
run.NumberOfPartitions = [1, 1]
run.UpdatePipeline()
print("pieces now:", int(servermanager.Fetch(run).GetFieldData().GetArray("Pieces").GetTuple1(0)))
"""
EXPECTED = [
    "defaults: 2147483648.0 0 [0, 0] 0",
    "limit set: 5000000000",
    "output: vtkTable",
    "Points: 5000",
    "Pieces: 6",
    "Resumed: 0",
    "all triangles read: True",
    "pieces now: 1",
]

session = Session(__doc__)
files = [session.scratch / name for name in ("first.npy", "second.csv")]
points = np.random.default_rng(1).random((5000, 2))
np.save(files[0], points[:3000])
np.savetxt(files[1], points[3000:], delimiter=",", header="x,y", comments="")
script = session.scratch / "out_of_core.py"
script.write_text(PROGRAM)
lines = session.pvbatch(script, *files, session.scratch / "mesh.tipp").splitlines()
for line in EXPECTED:
    expect(line in lines, f"not printed: {line}")
