# SPDX-License-Identifier: BSD-3-Clause
"""VTK filters for pipelines, with the names and properties of the C++ classes, for any VTK that is installed.

They lack runs on several ranks, and the properties for them.
"""
from __future__ import annotations

import warnings
from typing import Any, Callable

from . import _arguments as check
from . import _core, _native_engine
from ._arguments import STOPPED
from ._vtk import point_cloud
from ._vtkmodules import (
    VTKPythonAlgorithmBase,
    vtkAlgorithm,
    vtkDataArraySelection,
    vtkDataObject,
    vtkDataSet,
    vtkDoubleArray,
    vtkIdTypeArray,
    vtkImageData,
    vtkOutputWindow,
    vtkPartitionedDataSet,
    vtkPointSet,
    vtkPolyData,
    vtkStreamingDemandDrivenPipeline,
    vtkStringArray,
    vtkTable,
    vtkUnstructuredGrid,
)


class Filter(VTKPythonAlgorithmBase):
    """A filter with Set..., Get..., and of flags ...On and ...Off, for each of its PROPERTIES."""

    PROPERTIES: dict[str, Any] = {}
    """Names and defaults."""
    LIMITS: dict[str, tuple[Any, Any]] = {}
    """Values beyond these are set to them, as VTK does."""
    INPUTS: tuple[str, ...] = ()
    OPTIONAL_INPUTS: tuple[int, ...] = ()
    OUTPUTS: tuple[str, ...] = ()
    FILES = ""
    """What a file is called in the methods for a list of files."""
    SELECTIONS = False
    """Whether there are selections of arrays."""

    def __init_subclass__(cls) -> None:
        for name, default in cls.PROPERTIES.items():
            _add_property(cls, name, default)
        if cls.FILES:
            _add_files(cls, cls.FILES)
        if cls.SELECTIONS:
            cls.GetPointDataArraySelection = lambda self: self._selections["Point"]
            cls.GetCellDataArraySelection = lambda self: self._selections["Cell"]

    def __init__(self) -> None:
        super().__init__(nInputPorts=len(self.INPUTS), nOutputPorts=len(self.OUTPUTS),
                         outputType=self.OUTPUTS[0])
        self._values = dict(self.PROPERTIES)
        self.files: list[str] = []
        self._selections = {kind: vtkDataArraySelection() for kind in ("Point", "Cell")}
        for selection in self._selections.values():
            selection.AddObserver("ModifiedEvent", lambda *_: self.Modified())

    def FillInputPortInformation(self, port: int, info: Any) -> int:
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), self.INPUTS[port])
        if port in self.OPTIONAL_INPUTS:
            info.Set(vtkAlgorithm.INPUT_IS_OPTIONAL(), 1)
        return 1

    def FillOutputPortInformation(self, port: int, info: Any) -> int:
        info.Set(vtkDataObject.DATA_TYPE_NAME(), self.OUTPUTS[port])
        return 1

    def SetInputData(self, *port_and_data: Any) -> None:
        """Of a port, or of the first one."""
        *port, data = port_and_data
        self.SetInputDataObject(port[0] if port else 0, data)

    def GetOutput(self, port: int = 0) -> Any:
        return self.GetOutputDataObject(port)

    def RequestData(self, _request: Any, inputs: Any, outputs: Any) -> int:
        return self.guarded(lambda: self.execute(inputs, outputs))

    def execute(self, inputs: Any, outputs: Any) -> None:
        raise NotImplementedError

    def value(self, name: str) -> Any:
        return self._values[name]

    def chosen(self, kind: str, mesh: Any) -> list[str]:
        """The names of a mesh's arrays that are not disabled."""
        data = mesh.GetPointData() if kind == "Point" else mesh.GetCellData()
        arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
        names = [array.GetName() for array in arrays if array is not None]
        selection = self._selections[kind]
        return [name for name in names
                if name and name != "vtkGhostType" and (not selection.ArrayExists(name) or selection.ArrayIsEnabled(name))]

    def progress(self, fraction: float) -> bool:
        self.UpdateProgress(fraction)
        return not self.GetAbortExecute()

    def guarded(self, work: Callable[[], None]) -> int:
        """1 if it is done. Exceptions and warnings become VTK's errors and warnings, for VTK does not know Python's."""
        try:
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                work()
        except Exception as error:  # pylint: disable=broad-except
            if str(error) == STOPPED and self.GetAbortExecute():
                return 1
            self._tell("ErrorEvent", str(error.args[0]) if error.args else type(error).__name__)
            return 0
        for warning in caught:
            self._tell("WarningEvent", str(warning.message))
        return 1

    def _tell(self, event: str, sentence: str) -> None:
        if self.HasObserver(event):
            self.InvokeEvent(event, sentence)
            return
        window = vtkOutputWindow.GetInstance()
        if event == "ErrorEvent":
            window.DisplayErrorText(f"ERROR: {type(self).__name__}: {sentence}\n")
        else:
            window.DisplayWarningText(f"Warning: {type(self).__name__}: {sentence}\n")


def _add_property(cls: type, name: str, default: Any) -> None:
    kind = type(default)
    low, high = cls.LIMITS.get(name, (None, None))

    def converted(values: tuple[Any, ...]) -> Any:
        if kind is tuple:
            values = tuple(values[0]) if len(values) == 1 else values
            if len(values) != len(default):
                raise TypeError(f"{name} has {len(values)} values; give {len(default)}.")
            return tuple(type(d)(v) for d, v in zip(default, values))
        if len(values) != 1:
            raise TypeError(f"{name} has {len(values)} values; give one.")
        value = "" if kind is str and values[0] is None else kind(values[0])
        if low is not None and value < low:
            return kind(low)
        return kind(high) if high is not None and value > high else value

    def set_value(self: Any, *values: Any) -> None:
        value = converted(values)
        if value != self._values[name]:
            self._values[name] = value
            self.Modified()

    def get_value(self: Any) -> Any:
        return self._values[name]

    set_value.__name__, get_value.__name__ = f"Set{name}", f"Get{name}"
    set_value.__doc__ = f"Sets {name}; at first it is {default!r}."
    get_value.__doc__ = f"Returns {name}."
    setattr(cls, f"Set{name}", set_value)
    setattr(cls, f"Get{name}", get_value)
    if kind is bool:
        setattr(cls, f"{name}On", lambda self: set_value(self, True))
        setattr(cls, f"{name}Off", lambda self: set_value(self, False))


def _add_files(cls: type, name: str) -> None:
    def add(self: Any, path: str) -> None:
        if path:
            self.files.append(str(path))
            self.Modified()

    def clear(self: Any) -> None:
        if self.files:
            self.files.clear()
            self.Modified()

    def set_one(self: Any, path: str) -> None:
        if self.files != [path]:
            clear(self)
            add(self, path)

    def get(self: Any, index: int) -> Any:
        return self.files[index] if 0 <= index < len(self.files) else None

    for method, function in ((f"Add{name}", add), (f"Clear{name}s", clear), (f"Set{name}", set_one),
                             (f"Get{name}", get), (f"GetNumberOf{name}s", lambda self: len(self.files))):
        setattr(cls, method, function)


def add_total(name: str, value: float, totals: Any) -> None:
    """An array of one value as field data."""
    array = vtkIdTypeArray() if isinstance(value, int) else vtkDoubleArray()
    array.SetName(name)
    array.InsertNextValue(value)
    totals.AddArray(array)


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
        "ConstraintsFileName": "", "BoundaryFileName": "", "SplitCrossings": True, "GenerateConstraintEdges": False,
        "CountOnly": False, "Resume": False, "ScratchFolder": "", "NumberOfThreads": 0,
    }
    LIMITS = {"MemoryLimit": (1, None), "MaximumEdgeLength": (0, None), "NumberOfThreads": (0, 4096)}
    FILES = "InputFileName"
    OUTPUTS = ("vtkTable",)

    def __init__(self) -> None:
        super().__init__()
        self.holes: list[tuple[float, float]] = []

    def AddHole(self, x: float, y: float) -> None:
        self.holes.append((float(x), float(y)))
        self.Modified()

    def ClearHoles(self) -> None:
        self.holes.clear()
        self.Modified()

    def GetStatistics(self) -> vtkTable:
        return self.GetOutputDataObject(0)

    def execute(self, inputs: Any, outputs: Any) -> None:
        options = {
            "memory": self.value("MemoryLimit"), "partitions": self.value("NumberOfPartitions"),
            "columns": (self.value("XColumn"), self.value("YColumn")), "max_edge": self.value("MaximumEdgeLength"),
            "map_duplicates": self.value("GenerateRepresentativeIds"), "neighbors": self.value("GenerateNeighborIds"),
            "constraints": self.value("ConstraintsFileName"), "boundary": self.value("BoundaryFileName"),
            "holes": self.holes, "crossings": self.value("SplitCrossings"),
            "mark_constraints": self.value("GenerateConstraintEdges"),
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
        array, data, crs = _native_engine.read_points(self.files, options)
        cloud = point_cloud(array, data)
        if crs:
            text = vtkStringArray()
            text.SetName("CoordinateReferenceSystem")
            text.InsertNextValue(crs)
            cloud.GetFieldData().AddArray(text)
        vtkPolyData.GetData(outputs, 0).ShallowCopy(cloud)
