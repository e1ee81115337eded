# SPDX-License-Identifier: BSD-3-Clause
"""Times ParaView's vtkRedistributeDataSetFilter with duplicated boundary cells: pvbatch redistribute.py MESH.vtu PIECES

Reading the mesh is not timed.
"""
import resource
import sys
import time

from paraview.modules.vtkPVVTKExtensionsFiltersGeneral import *  # noqa: F401,F403  (loads VTK's own)
from vtkmodules.vtkFiltersParallelDIY2 import vtkRedistributeDataSetFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

path, pieces = sys.argv[1], int(sys.argv[2])
reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(path)
reader.Update()

redistribute = vtkRedistributeDataSetFilter()
redistribute.SetInputData(reader.GetOutput())
redistribute.SetNumberOfPartitions(pieces)
redistribute.SetBoundaryMode(vtkRedistributeDataSetFilter.ASSIGN_TO_ALL_INTERSECTING_REGIONS)
redistribute.PreservePartitionsInOutputOn()
start, cpu = time.perf_counter(), time.process_time()
redistribute.Update()
output = redistribute.GetOutputDataObject(0)
print(f"vtkRedistributeDataSetFilter: {time.perf_counter() - start:.1f} s, "
      f"{time.process_time() - cpu:.1f} CPU s, {output.GetNumberOfCells()} cells, peak memory "
      f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e6:.0f} MB, the mesh included")
