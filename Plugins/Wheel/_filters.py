# SPDX-License-Identifier: BSD-3-Clause
"""VTK filters for pipelines, with the names and properties of the C++ classes, for any installed VTK.

They work on one rank only, and lack the properties for several ranks.
"""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from . import _arguments as check
from . import _core, _engine
from ._arguments import array_of, DELAUNAY_2D, DELAUNAY_3D, DELAUNAY_FILE, DEM, MESHING, options_of, QUERY, READ, WRITE
from ._arrays import grid_position
from ._data import Image
from ._dem import lines_of
from ._mesh import angle_of
from ._filter import add_total, Filter
from ._results import in_vtk
from ._vtk import cell_lists, grid_of, image_of, point_arrays, point_cloud, simplices_of, vtk_array, xyz_of
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


class _Triangulation(Filter):
    """A filter whose second output is a vtkTable with statistics as field data."""

    def GetStatistics(self) -> vtkTable:
        return self.GetOutputDataObject(1)

    def GetNumberOfDuplicatePoints(self) -> int:
        return self._statistic("DuplicatePoints")

    def GetNumberOfRejectedPoints(self) -> int:
        return self._statistic("RejectedPoints")

    def _statistic(self, name: str) -> int:
        array = self.GetStatistics().GetFieldData().GetArray(name)
        return int(array.GetValue(0)) if array else 0

    def set_statistics(self, statistics: dict[str, Any], outputs: Any) -> None:
        totals = vtkTable.GetData(outputs, 1).GetFieldData()
        for key, value in statistics.items():
            if key != "seconds":
                add_total(array_of(key), value, totals)


class vtkTIPPDelaunay2D(_Triangulation):
    """Exact Delaunay triangulation of the points of a vtkPointSet in the x-y plane. Lines and polygons of the second
    input, the source, are constraints. The second output is a vtkTable with statistics as field data."""

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
    INPUT_NAMES = {"Source": 1}
    OUTPUTS = ("vtkPolyData", "vtkTable")

    def execute(self, inputs: Any, outputs: Any) -> None:
        for name in ("Alpha", "MaximumEdgeLength", "Tolerance", "Offset"):
            check.number(self.value(name), name)
        options = {
            **options_of(self, DELAUNAY_2D), "edges": None, "polygons": None,
            "edge_source": vtkPolyData.GetData(inputs[1]),
            "merge_source_points": self.value("MergeSourcePoints"),
        }
        points = vtkPointSet.GetData(inputs[0])
        mesh, statistics = _engine.delaunay_2d(points, None, options, self.show_progress)
        output = vtkPolyData.GetData(outputs, 0)
        output.ShallowCopy(mesh)
        for name, clear in (("AlphaTris", output.SetPolys), ("AlphaLines", output.SetLines),
                            ("AlphaVerts", output.SetVerts)):
            if options["alpha"] > 0 and not self.value(name):
                clear(None)
        self.set_statistics(statistics, outputs)


class vtkTIPPDelaunay3D(_Triangulation):
    """Exact Delaunay tetrahedralization of the points of a vtkPointSet. The second output is a vtkTable with statistics
    as field data."""

    PROPERTIES = {
        "Alpha": 0.0, "AlphaTets": True, "AlphaTris": True, "AlphaLines": True, "AlphaVerts": True, "Tolerance": 0.0,
        "Offset": 2.5, "BoundingTriangulation": False, "GenerateRepresentativeIds": True, "GenerateNeighborIds": False,
        "NumberOfPartitions": 0, "NumberOfThreads": 0,
    }
    LIMITS = {"Alpha": (0, None), "Tolerance": (0, 1), "Offset": (2.5, None), "NumberOfPartitions": (0, 512),
              "NumberOfThreads": (0, 4096)}
    INPUTS = ("vtkPointSet",)
    OUTPUTS = ("vtkUnstructuredGrid", "vtkTable")

    def execute(self, inputs: Any, outputs: Any) -> None:
        for name in ("Alpha", "Tolerance", "Offset"):
            check.number(self.value(name), name)
        points = vtkPointSet.GetData(inputs[0])
        mesh, source, statistics = _engine.tetrahedra(
            points, None, options_of(self, DELAUNAY_3D), self.show_progress)
        if self.value("Alpha") > 0:
            is_flat = mesh.cells.shape[1] == 3
            for name, group in (("AlphaTets", "" if is_flat else "cells"),
                                ("AlphaTris", "cells" if is_flat else "triangles"),
                                ("AlphaLines", "lines"), ("AlphaVerts", "vertices")):
                if group and not self.value(name):
                    setattr(mesh, group, getattr(mesh, group)[:0])
        vtkUnstructuredGrid.GetData(outputs, 0).ShallowCopy(grid_of(mesh, source))
        self.set_statistics(statistics, outputs)


class _WithHoles(Filter):
    """A filter that is told points in holes."""

    def prepare(self) -> None:
        self.holes: list[tuple[float, float]] = []

    def AddHole(self, x: float, y: float) -> None:
        self.holes.append((float(x), float(y)))
        self.Modified()

    def ClearHoles(self) -> None:
        self.holes.clear()
        self.Modified()


class vtkTIPPOutOfCoreDelaunay2D(_WithHoles):
    """Exact Delaunay triangulation of points in files into a partitioned mesh, in bounded memory. The output is a
    vtkTable with statistics as field data."""

    PROPERTIES = {
        "FileName": "", "MemoryLimit": 2 * _GIGABYTE, "NumberOfPartitions": (0, 0), "XColumn": "", "YColumn": "",
        "MaximumEdgeLength": 0.0, "GenerateRepresentativeIds": False, "GenerateNeighborIds": False,
        "ConstraintsFileName": "", "BoundaryFileName": "", "SplitCrossings": True, "GenerateConstraintEdges": False,
        "CountOnly": False, "Resume": False, "ScratchFolder": "", "NumberOfThreads": 0,
    }
    LIMITS = {"MemoryLimit": (1, None), "MaximumEdgeLength": (0, None), "NumberOfThreads": (0, 4096)}
    LIST = "InputFileName"
    OUTPUTS = ("vtkTable",)

    def GetStatistics(self) -> vtkTable:
        return self.GetOutputDataObject(0)

    def execute(self, inputs: Any, outputs: Any) -> None:
        options = {**options_of(self, DELAUNAY_FILE), "holes": self.holes,
                   "columns": (self.value("XColumn"), self.value("YColumn"))}
        figures = _engine.delaunay_file(self.texts, self.value("FileName"), options, self.show_progress)
        totals = vtkTable.GetData(outputs, 0).GetFieldData()
        for key, value in figures.items():
            add_total(array_of(key), value, totals)


class vtkTIPPRefine2D(_WithHoles):
    """A mesh of bounded angles and sizes between the lines and polygons of a vtkPolyData. The second input, which is
    optional, is a mesh with the array of the wanted lengths of edges."""

    NOT_OUTSIDE, INPUT_ANGLE, SHORTEST_EDGE, KEPT_SEGMENTS, MOST_POINTS = range(5)
    PROPERTIES = {
        "MinimumAngle": 30.0, "MaximumArea": 0.0, "SizeArrayName": "", "ShortestEdge": 0.0, "KeepBorder": False,
        "KeepSegments": False, "Convex": False, "SplitCrossings": True, "GenerateSegments": False, "MostPoints": 0,
        "SmoothingRounds": 0, "MemoryLimit": 0, "ScratchFolder": "", "NumberOfThreads": 0,
    }
    LIMITS = {"MemoryLimit": (0, (1 << 63) - 1), "NumberOfThreads": (0, 4096)}
    INPUTS = ("vtkPolyData", "vtkPointSet")
    OPTIONAL_INPUTS = (1,)
    INPUT_NAMES = {"Size": 1}
    OUTPUTS = ("vtkPolyData",)

    def prepare(self) -> None:
        super().prepare()
        self.regions: list[tuple[float, float, float]] = []

    def AddRegion(self, x: float, y: float, area: float) -> None:
        self.regions.append((float(x), float(y), float(area)))
        self.Modified()

    def ClearRegions(self) -> None:
        self.regions.clear()
        self.Modified()

    def _lengths(self, data: Any, what: str) -> np.ndarray:
        """Returns the array of sizes of a data set, as doubles."""
        name = self.value("SizeArrayName")
        array = point_arrays(data).get(name)
        if array is None or array.ndim != 1:
            raise RuntimeError(f"{what} has no point array '{name}' of one component, which SizeArrayName names.")
        return np.ascontiguousarray(array, np.float64)

    def execute(self, inputs: Any, outputs: Any) -> None:
        angle_of(self.value("MinimumAngle"), "MinimumAngle")
        for name in ("MaximumArea", "ShortestEdge", "MostPoints", "SmoothingRounds"):
            check.number(self.value(name), name, at_least=0)
        for region in self.regions:
            check.number(region[2], "the area of a region", at_least=0)
        source, sizes = vtkPolyData.GetData(inputs[0]), vtkPointSet.GetData(inputs[1])
        options = {
            **options_of(self, MESHING), "max_area": self.value("MaximumArea") or math.inf, "holes": self.holes,
            "regions": [(x, y, area if area > 0 else math.inf) for x, y, area in self.regions], "lengths": None,
        }
        surface = None
        if sizes is not None:
            surface = simplices_of(sizes)[0]
            surface.point_data = {"size": self._lengths(sizes, "the mesh of sizes")}
        elif self.value("SizeArrayName"):
            options["lengths"] = self._lengths(source, "the input")
        mesh = _engine.mesh(xyz_of(source), point_arrays(source), cell_lists(source.GetLines()),
                            cell_lists(source.GetPolys()), options, surface, self.show_progress)
        vtkPolyData.GetData(outputs, 0).ShallowCopy(in_vtk(mesh))


class vtkTIPPPointsToImage(Filter):
    """Makes a regular grid of elevations (a DEM) from the points of a vtkPointSet, by their exact triangulation. The
    second and third inputs, which are optional, are breaklines and a boundary. The output is a vtkImageData with an
    array for each band."""

    DUPLICATES_FIRST, DUPLICATES_LOWEST, DUPLICATES_HIGHEST, DUPLICATES_MEAN = range(4)
    THIN_LOWEST, THIN_HIGHEST, THIN_NEAREST = range(3)
    PROPERTIES = {
        "BreaklinesFileName": "", "BoundaryFileName": "", "SoftBreaklines": False, "Resolution": 0.0,
        "UseInputBounds": True, "SamplingBounds": (0.0, 1.0, 0.0, 1.0), "StrictBounds": False, "AlignToResolution": True,
        "MaximumEdgeLength": 0.0, "Duplicates": 0, "ThinningSize": 0.0, "ThinningRule": 2, "MemoryLimit": 0, "NumberOfThreads": 0,
    }
    LIMITS = {"Resolution": (0, None), "MaximumEdgeLength": (0, None), "Duplicates": (0, 3), "ThinningSize": (0, None),
              "ThinningRule": (0, 2), "MemoryLimit": (0, None), "NumberOfThreads": (0, 4096)}
    LIST = "Band"
    INPUTS = ("vtkPointSet", "vtkPolyData", "vtkPolyData")
    OPTIONAL_INPUTS = (1, 2)
    INPUT_NAMES = {"Breaklines": 1, "Boundary": 2}
    OUTPUTS = ("vtkImageData",)

    def prepare(self) -> None:
        self.texts = ["elevation"]

    def RequestInformation(self, _request: Any, _inputs: Any, outputs: Any) -> int:
        return self.guarded(lambda: self._describe(outputs.GetInformationObject(0)))

    def _pixels(self) -> tuple[list[float], float]:
        """Returns the bounds and the resolution."""
        bounds, size = list(self.value("SamplingBounds")), self.value("Resolution")
        if not self.value("UseInputBounds") and size > 0:
            return bounds, size
        self.GetInputAlgorithm(0, 0).Update()
        points = self.GetInputDataObject(0, 0)
        if self.value("UseInputBounds"):
            xy = xyz_of(points)[:, :2]
            xy = xy[np.isfinite(xy).all(axis=1)].astype(np.float64)
            if len(xy) == 0:
                raise RuntimeError("There is no point with finite coordinates.")
            bounds = np.column_stack([xy.min(axis=0), xy.max(axis=0)]).ravel().tolist()
        area = (bounds[1] - bounds[0]) * (bounds[3] - bounds[2])
        count = max(points.GetNumberOfPoints(), 1)
        return bounds, size if size > 0 else math.sqrt(area / count) if area > 0 else 1.0

    def _describe(self, information: Any) -> None:
        bounds, size = self._pixels()
        west, south, columns, rows = _core.raster_grid(bounds, size, self.value("AlignToResolution"))
        information.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), (0, columns - 1, 0, rows - 1, 0, 0), 6)
        information.Set(
            vtkDataObject.ORIGIN(), (grid_position(west, size, 1), grid_position(south, size, 1), 0.0), 3)
        information.Set(vtkDataObject.SPACING(), (size, size, 1.0), 3)

    def _lines(self, name: str, data: Any) -> Any:
        return self.value(name + "FileName") or lines_of(data, name, name == "Boundary")

    def execute(self, inputs: Any, outputs: Any) -> None:
        if not self.texts:
            raise RuntimeError("There is no band: add one, as elevation.")
        for name in ("Resolution", "MaximumEdgeLength", "ThinningSize"):
            check.number(self.value(name), name)
        bounds, size = self._pixels()
        lines = [vtkPolyData.GetData(port) for port in inputs[1:]]
        options = {
            **options_of(self, DEM), "resolution": size, "bounds": bounds, "attributes": self.texts,
            "strict_bounds": self.value("StrictBounds"),
            "breaklines": self._lines("Breaklines", lines[0]), "boundary": self._lines("Boundary", lines[1]),
            "classes": None, "returns": 0, "keep": [], "z": "", "layer": "", "crs": "",
        }
        points = vtkPointSet.GetData(inputs[0])
        bands, (west, south, columns, rows), _ = _engine.raster(points, None, options, self.show_progress)
        arrays = {name: band.ravel() for name, band in zip(self.texts, bands)}
        origin = (grid_position(west, size, 1), grid_position(south, size, 1), 0.0)
        image = image_of(Image(origin, (size, size, 1.0), (columns, rows, 1), arrays))
        image.GetPointData().SetActiveScalars(self.texts[0])
        north = grid_position(south, size, 2 * rows)
        image.GetFieldData().AddArray(vtk_array("GeoTransform", [west, size, 0.0, north, 0.0, -size]))
        vtkImageData.GetData(outputs, 0).ShallowCopy(image)


class vtkRangeResampleFilter(Filter):
    """Samples a mesh of triangles or tetrahedra in a range; the output is a vtkImageData."""

    PROPERTIES = {
        "UseInputBounds": True, "StrictBounds": False, "SamplingBounds": (0.0, 1.0, 0.0, 1.0, 0.0, 1.0),
        "SamplingDimensions": (10, 10, 10),
        "Delta": (0.0, 0.0, 0.0), "NullValue": 0.0, "UseNoDataValue": False, "NoDataValue": -99999.0,
        "Method": 0, "PassCoveredShare": False, "DeviceChoice": "auto", "NumberOfThreads": 0,
    }
    METHOD_LINEAR, METHOD_CONSERVATIVE = range(2)
    LIMITS = {"Method": (0, 1), "NumberOfThreads": (0, None)}
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
            "bounds": list(self._bounds()),
            "strict_bounds": self.value("StrictBounds") and not self.value("UseInputBounds"), "spacing": list(self.value("Delta")),
            "dimensions": list(self.value("SamplingDimensions")), "null_value": self.value("NullValue"),
            "no_data": self.value("NoDataValue") if self.value("UseNoDataValue") else None, "arrays": names,
            "conservative": self.value("Method") == 1, "covered_share": self.value("PassCoveredShare"),
            "device": self.value("DeviceChoice"), "threads": self.value("NumberOfThreads"),
        }
        image = _engine.resample(mesh, options, self.show_progress)
        vtkImageData.GetData(outputs, 0).ShallowCopy(in_vtk(image))


class vtkTIPPRemap(Filter):
    """Averages the arrays of a surface, the source, over the cells of the first input, exactly; the output is that input
    with the means and CoveredShare as cell arrays."""

    PROPERTIES = {"NullValue": float("nan"), "NumberOfThreads": 0}
    LIMITS = {"NumberOfThreads": (0, 4096)}
    INPUTS = ("vtkPointSet", "vtkPointSet")
    INPUT_NAMES = {"Source": 1}
    OUTPUTS = ("vtkPointSet",)
    LIST = "Array"

    def RequestDataObject(self, _request: Any, inputs: Any, outputs: Any) -> int:
        kind = vtkPolyData if vtkPolyData.GetData(inputs[0]) else vtkUnstructuredGrid
        information = outputs.GetInformationObject(0)
        if not isinstance(information.Get(vtkDataObject.DATA_OBJECT()), kind):
            information.Set(vtkDataObject.DATA_OBJECT(), kind())
        return 1

    def execute(self, inputs: Any, outputs: Any) -> None:
        target = vtkPointSet.GetData(inputs[0])
        options = {"arrays": self.texts or None, "null_value": self.value("NullValue"),
                   "threads": self.value("NumberOfThreads")}
        mesh = _engine.remap(vtkPointSet.GetData(inputs[1]), target, options, self.show_progress)
        vtkPointSet.GetData(outputs, 0).ShallowCopy(in_vtk(mesh, as_grid=not target.IsA("vtkPolyData")))


class vtkTIPPCutFill(Filter):
    """Computes cut and fill volumes between two surfaces, exactly; the output is a vtkTable of one row with the columns
    Cut, Fill, Net, Area, OnlyBefore and OnlyAfter."""

    PROPERTIES = {"UseBounds": False, "Bounds": (0.0, 1.0, 0.0, 1.0), "NumberOfThreads": 0}
    LIMITS = {"NumberOfThreads": (0, 4096)}
    INPUTS = ("vtkPointSet", "vtkPointSet")
    INPUT_NAMES = {"Source": 1}
    OUTPUTS = ("vtkTable",)

    def execute(self, inputs: Any, outputs: Any) -> None:
        options = {"bounds": list(self.value("Bounds")) if self.value("UseBounds") else None,
                   "threads": self.value("NumberOfThreads")}
        cut, fill, area, *only = _engine.volume(
            vtkPointSet.GetData(inputs[0]), vtkPointSet.GetData(inputs[1]), options, self.show_progress)
        table = vtkTable.GetData(outputs, 0)
        for name, value in zip(("Cut", "Fill", "Net", "Area", "OnlyBefore", "OnlyAfter"), (cut, fill, fill - cut, area, *only)):
            table.AddColumn(vtk_array(name, [value]))


class vtkPartitionedUnstructuredReader(Filter):
    """Reads a partitioned or flat mesh, or the part of it in a range."""

    OWNED, OWNED_AND_BORROWED = range(2)
    PROPERTIES = {
        "FileName": "", "Bounds": (1.0, 0.0, 1.0, 0.0, 1.0, 0.0), "StrictBounds": False, "BorrowerMode": 0,
        "MergePieces": True,
        "Tiling": "grid:4x4", "MemoryLimit": 2 * _GIGABYTE, "Wrap": False,
    }
    LIMITS = {"BorrowerMode": (0, 1), "MemoryLimit": (1, None)}
    LIST = "ValuesFileName"
    OUTPUTS = ("vtkDataObject",)
    SELECTIONS = True

    def _options(self) -> dict[str, Any]:
        return {**options_of(self, READ), "values": self.texts, "wrap": self.value("Wrap")}

    def CanReadFile(self, path: str) -> int:
        try:
            _core.array_names(path, self._options())
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
        known = _core.array_names(self.value("FileName"), self._options())
        for selection, names in zip((self.GetPointDataArraySelection(), self.GetCellDataArraySelection()), known):
            for name in names:
                selection.AddArray(name)

    def execute(self, inputs: Any, outputs: Any) -> None:
        chosen = [[s.GetArrayName(i) for i in range(s.GetNumberOfArrays()) if s.GetArraySetting(i)]
                  for s in (self.GetPointDataArraySelection(), self.GetCellDataArraySelection())]
        options = {
            **self._options(), "bounds": list(self.value("Bounds")), "strict_bounds": self.value("StrictBounds"),
            "borrowed": self.value("BorrowerMode") == 1, "time": None, "point_arrays": chosen[0],
            "cell_arrays": chosen[1],
        }
        meshes = _engine.read(self.value("FileName"), options, self.show_progress)
        vtkDataObject.GetData(outputs, 0).ShallowCopy(in_vtk(meshes, as_grid=True))


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
        _engine.write(mesh, self.value("FileName"), options_of(self, WRITE), self.show_progress)
        self._is_written = True


class vtkPartitionedMeshQuery(Filter):
    """Evaluates a mesh at the points of a data set; the output has the structure of this data set. The mesh is the
    second input (the source, as in vtkProbeFilter), or FileName, a partitioned mesh on disk of any size."""

    PROPERTIES = {
        "FileName": "", "MemoryLimit": _GIGABYTE, "Step": 0, "NullValue": 0.0, "PassPointArrays": False,
        "PassCellArrays": False, "PassFieldArrays": True, "ValidPointMaskArrayName": "vtkValidPointMask",
        "NumberOfThreads": 0,
    }
    LIMITS = {"MemoryLimit": (1, None), "Step": (0, None), "NumberOfThreads": (0, 4096)}
    LIST = "Array"
    INPUTS = ("vtkDataSet", "vtkPointSet")
    OPTIONAL_INPUTS = (1,)
    INPUT_NAMES = {"Source": 1}
    OUTPUTS = ("vtkDataSet",)

    def prepare(self) -> None:
        self._opened: tuple[Any, Any] = (None, None)

    def RequestDataObject(self, _request: Any, inputs: Any, outputs: Any) -> int:
        points, information = vtkDataSet.GetData(inputs[0]), outputs.GetInformationObject(0)
        before = information.Get(vtkDataObject.DATA_OBJECT())
        if points is not None and (before is None or before.GetClassName() != points.GetClassName()):
            information.Set(vtkDataObject.DATA_OBJECT(), points.NewInstance())
        return 1

    def _mesh(self, source: Any) -> Any:
        """Returns the opened mesh. Opens it again only if it has changed."""
        options = options_of(self, QUERY)
        key = (self.value("FileName") or (source, source and source.GetMTime()), options)
        if not self.value("FileName") and source is None:
            raise RuntimeError("there is neither a source nor a FileName; set one.")
        if self._opened[0] != key:
            self._opened = (key, _engine.open_mesh(self.value("FileName") or source, options))
        return self._opened[1]

    def execute(self, inputs: Any, outputs: Any) -> None:
        asked = vtkDataSet.GetData(inputs[0])
        mesh = self._mesh(vtkPointSet.GetData(inputs[1]))
        points = np.zeros((asked.GetNumberOfPoints(), 3))
        if asked.IsA("vtkPointSet"):
            points[:] = xyz_of(asked)
        else:
            for i in range(len(points)):
                points[i] = asked.GetPoint(i)
        cells, values = mesh.sample(points, self.texts or mesh.names())
        output = vtkDataSet.GetData(outputs, 0)
        output.CopyStructure(asked)
        for kind in ("Point", "Cell", "Field"):
            if self.value(f"Pass{kind}Arrays"):
                getattr(output, f"Get{kind}Data")().ShallowCopy(getattr(asked, f"Get{kind}Data")())
        for name, array in values.items():
            if array.dtype.kind == "f":
                array[cells < 0] = self.value("NullValue")
            output.GetPointData().AddArray(vtk_array(name, array))
        output.GetPointData().AddArray(vtk_array("CellId", cells))
        mask = (cells >= 0).astype(np.int8)
        output.GetPointData().AddArray(vtk_array(self.value("ValidPointMaskArrayName"), mask))


class vtkTIPPPointReader(Filter):
    """Reads points from files: .las, .laz, .npy, .csv and .xyz. The output is a vtkPolyData."""

    RETURNS_ALL, RETURNS_FIRST, RETURNS_LAST = range(3)
    PROPERTIES = {"Classes": "", "Returns": 0, "KeepWithheld": False, "KeepSynthetic": False, "KeepOverlap": False,
                  "KeepTruncated": False, "KeepUncounted": False, "Columns": ""}
    LIMITS = {"Returns": (0, 2)}
    LIST = "FileName"
    OUTPUTS = ("vtkPolyData",)

    def execute(self, inputs: Any, outputs: Any) -> None:
        if not self.texts:
            raise RuntimeError("There is no file name; set one.")
        columns = self.value("Columns")
        options = {
            "attributes": columns.split(",") if columns else None,
            "classes": [int(number) for number in self.value("Classes").split(",") if number],
            "returns": self.value("Returns"),
            "keep": [flag for flag in ("withheld", "synthetic", "overlap", "truncated", "uncounted")
                     if self.value("Keep" + flag.capitalize())],
        }
        array, data, crs = _engine.read_points(self.texts, options)
        cloud = point_cloud(array, data)
        if crs:
            text = vtkStringArray()
            text.SetName("CoordinateReferenceSystem")
            text.InsertNextValue(crs)
            cloud.GetFieldData().AddArray(text)
        vtkPolyData.GetData(outputs, 0).ShallowCopy(cloud)


NAMES = tuple(name for name, kind in list(globals().items())
              if name.startswith("vtk") and isinstance(kind, type) and issubclass(kind, Filter))
