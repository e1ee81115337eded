# SPDX-License-Identifier: BSD-3-Clause
"""VTK filters for pipelines, with the names and properties of the C++ classes, for any VTK that is installed.

What these lack: runs on several ranks, and what the classes have for them.
"""
from __future__ import annotations

from typing import Any

from . import _arguments as check
from . import _core, _native_dem, _native_engine
from ._filter import Filter, add_total
from ._vtk import point_cloud
from ._vtkmodules import (
    vtkDataObject,
    vtkDataSet,
    vtkImageData,
    vtkPartitionedDataSet,
    vtkPointSet,
    vtkPolyData,
    vtkStreamingDemandDrivenPipeline,
    vtkStringArray,
    vtkTable,
    vtkUnstructuredGrid,
)

_GIGABYTE = 1 << 30


class vtkTIPPDelaunay2D(Filter):
    """Exact Delaunay triangulation of the points of a vtkPointSet in the x-y plane; of a source the lines and polygons
    are constraints. The second output is a vtkTable with statistics as field data."""

    STAGES, DYNAMIC, PRODUCER_CONSUMER = range(3)
    NO_MARKS, LINES, EDGE_FLAGS = range(3)
    PROPERTIES = {
        "Alpha": 0.0, "AlphaTris": True, "AlphaLines": True, "AlphaVerts": True, "MaximumEdgeLength": 0.0,
        "Tolerance": 0.0, "Offset": 1.0, "BoundingTriangulation": False, "GenerateRepresentativeIds": True,
        "GenerateNeighborIds": False, "MergeSourcePoints": False, "SplitCrossings": True, "ConstraintMarks": 0,
        "NumberOfPartitions": (0, 0), "Schedule": 1, "NumberOfThreads": 0,
    }
    LIMITS = {"Alpha": (0, None), "MaximumEdgeLength": (0, None), "Tolerance": (0, 1), "Offset": (0.75, None),
              "ConstraintMarks": (0, 2), "Schedule": (0, 2), "NumberOfThreads": (0, 4096)}
    INPUTS = ("vtkPointSet", "vtkPolyData")
    OPTIONAL_INPUTS = (1,)
    OUTPUTS = ("vtkPolyData", "vtkTable")

    def SetSourceData(self, source: vtkPolyData) -> None:
        self.SetInputDataObject(1, source)

    def SetSourceConnection(self, port: Any) -> None:
        self.SetInputConnection(1, port)

    def GetSource(self) -> Any:
        return self.GetInputDataObject(1, 0) if self.GetNumberOfInputConnections(1) else None

    def GetStatistics(self) -> vtkTable:
        return self.GetOutputDataObject(1)

    def GetNumberOfDuplicatePoints(self) -> int:
        return self._counted("DuplicatePoints")

    def GetNumberOfRejectedPoints(self) -> int:
        return self._counted("RejectedPoints")

    def _counted(self, name: str) -> int:
        array = self.GetStatistics().GetFieldData().GetArray(name)
        return int(array.GetValue(0)) if array else 0

    def execute(self, inputs: Any, outputs: Any) -> None:
        for name in ("Alpha", "MaximumEdgeLength", "Tolerance", "Offset"):
            check.number(self.value(name), name)
        has_source = inputs[1].GetNumberOfInformationObjects() > 0
        options = {
            "tolerance": self.value("Tolerance"), "max_edge": self.value("MaximumEdgeLength"),
            "partitions": self.value("NumberOfPartitions"), "schedule": self.value("Schedule"),
            "threads": self.value("NumberOfThreads"), "alpha": self.value("Alpha"), "offset": self.value("Offset"),
            "bound": self.value("BoundingTriangulation"), "edges": None, "polygons": None,
            "edge_source": vtkPolyData.GetData(inputs[1]) if has_source else None,
            "merge_source_points": self.value("MergeSourcePoints"), "crossings": int(self.value("SplitCrossings")),
            "marks": self.value("ConstraintMarks"), "map_duplicates": self.value("GenerateRepresentativeIds"),
            "neighbors": self.value("GenerateNeighborIds"),
        }
        points = vtkPointSet.GetData(inputs[0])
        mesh, statistics = _native_engine.delaunay_2d(points, None, options, self.progress)
        output = vtkPolyData.GetData(outputs, 0)
        output.ShallowCopy(mesh)
        for name, clear in (("AlphaTris", output.SetPolys), ("AlphaLines", output.SetLines),
                            ("AlphaVerts", output.SetVerts)):
            if options["alpha"] > 0 and not self.value(name):
                clear(None)
        totals = vtkTable.GetData(outputs, 1).GetFieldData()
        names = {"duplicates": "DuplicatePoints", "rejected": "RejectedPoints"}
        for key, value in statistics.items():
            if key != "seconds":
                add_total(names.get(key, key.title().replace("_", "")), value, totals)


class vtkTIPPOutOfCoreDelaunay2D(Filter):
    """Exact Delaunay triangulation of points in files into a partitioned mesh, in bounded memory. The output is a
    vtkTable with numbers as field data."""

    PROPERTIES = {
        "FileName": "", "MemoryLimit": 2 * _GIGABYTE, "NumberOfPartitions": (0, 0), "XColumn": "", "YColumn": "",
        "MaximumEdgeLength": 0.0, "GenerateRepresentativeIds": False, "GenerateNeighborIds": False,
        "CountOnly": False, "Resume": False, "ScratchFolder": "", "NumberOfThreads": 0,
    }
    LIMITS = {"MemoryLimit": (1, None), "MaximumEdgeLength": (0, None), "NumberOfThreads": (0, 4096)}
    FILES = "InputFileName"
    OUTPUTS = ("vtkTable",)

    def GetStatistics(self) -> vtkTable:
        return self.GetOutputDataObject(0)

    def execute(self, inputs: Any, outputs: Any) -> None:
        options = {
            "memory": self.value("MemoryLimit"), "partitions": self.value("NumberOfPartitions"),
            "columns": (self.value("XColumn"), self.value("YColumn")), "max_edge": self.value("MaximumEdgeLength"),
            "map_duplicates": self.value("GenerateRepresentativeIds"), "neighbors": self.value("GenerateNeighborIds"),
            "count_only": self.value("CountOnly"), "resume": self.value("Resume"),
            "scratch": self.value("ScratchFolder"), "threads": self.value("NumberOfThreads"),
        }
        figures = _native_engine.delaunay_file(self.files, self.value("FileName"), options, self.progress)
        totals = vtkTable.GetData(outputs, 0).GetFieldData()
        names = {"duplicates": "DuplicatePoints", "rejected": "RejectedPoints"}
        for key, value in figures.items():
            add_total(names.get(key, key.title().replace("_", "")), value, totals)


class vtkRangeResampleFilter(Filter):
    """Samples a mesh of triangles or tetrahedra in a range; the output is a vtkImageData."""

    PROPERTIES = {
        "UseInputBounds": True, "SamplingBounds": (0.0, 1.0, 0.0, 1.0, 0.0, 1.0), "SamplingDimensions": (10, 10, 10),
        "Delta": (0.0, 0.0, 0.0), "NullValue": 0.0, "UseNoDataValue": False, "NoDataValue": -99999.0,
        "DeviceChoice": "auto", "NumberOfThreads": 0,
    }
    LIMITS = {"NumberOfThreads": (0, None)}
    INPUTS = ("vtkPointSet",)
    OUTPUTS = ("vtkImageData",)
    SELECTIONS = True

    def RequestInformation(self, _request: Any, inputs: Any, outputs: Any) -> int:
        return self.guarded(lambda: self._describe(outputs.GetInformationObject(0)))

    def _bounds(self) -> tuple[float, ...]:
        if not self.value("UseInputBounds"):
            return self.value("SamplingBounds")
        self.GetInputAlgorithm(0, 0).Update()
        bounds = self.GetInputDataObject(0, 0).GetBounds()
        return bounds if bounds[0] <= bounds[1] else (0.0,) * 6

    def _describe(self, information: Any) -> None:
        origin, spacing, counts = _core.range_lattice(
            self._bounds(), self.value("SamplingDimensions"), self.value("Delta"))
        extent = [limit for count in counts for limit in (0, count - 1)]
        information.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), extent, 6)
        information.Set(vtkDataObject.ORIGIN(), origin, 3)
        information.Set(vtkDataObject.SPACING(), spacing, 3)

    def execute(self, inputs: Any, outputs: Any) -> None:
        mesh = vtkDataSet.GetData(inputs[0])
        names = [name for kind in ("Point", "Cell") for name in self.chosen(kind, mesh)]
        options = {
            "bounds": list(self._bounds()), "spacing": list(self.value("Delta")),
            "dimensions": list(self.value("SamplingDimensions")), "null_value": self.value("NullValue"),
            "no_data": self.value("NoDataValue") if self.value("UseNoDataValue") else None, "arrays": names,
            "device": self.value("DeviceChoice"), "threads": self.value("NumberOfThreads"),
        }
        vtkImageData.GetData(outputs, 0).ShallowCopy(_native_engine.resample(mesh, options, self.progress))


class vtkPartitionedUnstructuredReader(Filter):
    """Reads a partitioned or flat mesh, or the part of it in a range."""

    OWNED, OWNED_AND_BORROWED = range(2)
    PROPERTIES = {
        "FileName": "", "Bounds": (1.0, 0.0, 1.0, 0.0, 1.0, 0.0), "BorrowerMode": 0, "MergePieces": True,
        "Tiling": "grid:4x4", "MemoryLimit": 2 * _GIGABYTE,
    }
    LIMITS = {"BorrowerMode": (0, 1), "MemoryLimit": (1, None)}
    OUTPUTS = ("vtkDataObject",)
    SELECTIONS = True

    def CanReadFile(self, path: str) -> int:
        try:
            _core.array_names(path, self.value("Tiling"), self.value("MemoryLimit"))
        except RuntimeError:
            return 0
        return 1

    def RequestDataObject(self, _request: Any, _inputs: Any, outputs: Any) -> int:
        kind = vtkUnstructuredGrid if self.value("MergePieces") else vtkPartitionedDataSet
        information = outputs.GetInformationObject(0)
        if not isinstance(information.Get(vtkDataObject.DATA_OBJECT()), kind):
            information.Set(vtkDataObject.DATA_OBJECT(), kind())
        return 1

    def RequestInformation(self, _request: Any, _inputs: Any, outputs: Any) -> int:
        return self.guarded(self._find_arrays)

    def _find_arrays(self) -> None:
        known = _core.array_names(self.value("FileName"), self.value("Tiling"), self.value("MemoryLimit"))
        for selection, names in zip((self.GetPointDataArraySelection(), self.GetCellDataArraySelection()), known):
            for name in names:
                selection.AddArray(name)

    def execute(self, inputs: Any, outputs: Any) -> None:
        chosen = [[s.GetArrayName(i) for i in range(s.GetNumberOfArrays()) if s.GetArraySetting(i)]
                  for s in (self.GetPointDataArraySelection(), self.GetCellDataArraySelection())]
        options = {
            "bounds": list(self.value("Bounds")), "borrowed": self.value("BorrowerMode") == 1,
            "merge": self.value("MergePieces"), "tiling": self.value("Tiling"),
            "memory_limit": self.value("MemoryLimit"), "time": None, "point_arrays": chosen[0],
            "cell_arrays": chosen[1],
        }
        mesh = _native_engine.read(self.value("FileName"), options, self.progress)
        vtkDataObject.GetData(outputs, 0).ShallowCopy(mesh)


class vtkPartitionedUnstructuredWriter(Filter):
    """Stores a data set, or a file of any size, as a partitioned mesh."""

    PROPERTIES = {"FileName": "", "InputFileName": "", "Tiling": "grid:4x4", "DuplicateBorrowers": False,
                  "MemoryLimit": 2 * _GIGABYTE, "NumberOfThreads": 0}
    LIMITS = {"MemoryLimit": (1, None), "NumberOfThreads": (0, 4096)}
    INPUTS = ("vtkDataObject",)
    OPTIONAL_INPUTS = (0,)
    OUTPUTS = ("vtkTable",)

    def Write(self) -> int:
        self._is_written = False
        self.Modified()
        self.Update()
        return int(self._is_written)

    def execute(self, inputs: Any, outputs: Any) -> None:
        has_input = inputs[0].GetNumberOfInformationObjects() > 0
        mesh = vtkDataObject.GetData(inputs[0]) if has_input else self.value("InputFileName")
        if not has_input and not mesh:
            raise RuntimeError("there is neither an input nor an InputFileName; set one.")
        options = {"tiling": self.value("Tiling"), "duplicate_borrowers": self.value("DuplicateBorrowers"),
                   "memory_limit": self.value("MemoryLimit"), "threads": self.value("NumberOfThreads")}
        _native_engine.write(mesh, self.value("FileName"), options, self.progress)
        self._is_written = True


class vtkTIPPPointReader(Filter):
    """Reads points from files: .las, .npy, .csv, .xyz; of .laz files where this build has LASzip or laspy is
    installed. The output is a vtkPolyData."""

    RETURNS_ALL, RETURNS_FIRST, RETURNS_LAST = range(3)
    PROPERTIES = {"Classes": "", "Returns": 0, "KeepWithheld": False, "KeepSynthetic": False, "KeepOverlap": False,
                  "Columns": ""}
    LIMITS = {"Returns": (0, 2)}
    FILES = "FileName"
    OUTPUTS = ("vtkPolyData",)

    def execute(self, inputs: Any, outputs: Any) -> None:
        if not self.files:
            raise RuntimeError("There is no file name; set one.")
        columns = self.value("Columns")
        options = {
            "attributes": columns.split(",") if columns else None,
            "classes": [int(number) for number in self.value("Classes").split(",") if number],
            "returns": self.value("Returns"),
            "keep": [flag for flag in ("withheld", "synthetic", "overlap") if self.value("Keep" + flag.capitalize())],
        }
        array, data, crs = _native_dem.read_points(self.files, options)
        cloud = point_cloud(array, data)
        if crs:
            text = vtkStringArray()
            text.SetName("CoordinateReferenceSystem")
            text.InsertNextValue(crs)
            cloud.GetFieldData().AddArray(text)
        vtkPolyData.GetData(outputs, 0).ShallowCopy(cloud)
