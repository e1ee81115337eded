// SPDX-License-Identifier: BSD-3-Clause
#include "Series/VtkHdfSeries.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"
#include "Hdf/VtkHdfFile.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/VirtualHdf.h"
#include "Series/CellSeries.h"
#include "Series/CheckTimes.h"
#include "Series/ModelSeries.h"
#include "Series/VariableNames.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

namespace tipp
{
namespace
{

/// The types of cells (vtkCellType.h) that are read, and others that are known.
enum CellType : unsigned char
{
  LastOfLines = 4, ///< vertices and lines are up to this
  Triangle = 5,
  Polygon = 7,
  Pixel = 8, ///< a quadrilateral whose last two corners are exchanged
  Quad = 9
};

constexpr const char* ghosts = "vtkGhostType";

/// Whether an array has the ids that pieces have in common, which are no values.
bool isIds(const std::string& name)
{
  return name == "GlobalPointIds" || name == "GlobalCellIds";
}

std::vector<double> componentOf(const HdfValues& values, std::int64_t component)
{
  std::vector<double> result(std::size_t(values.Tuples));
  withScalar(values.Type,
    [&](auto type)
    {
      using T = decltype(type);
      const char* from = values.Bytes.data() + std::size_t(component) * sizeof(T);
      for (double& value : result)
      {
        value = double(valueAt<T>(from));
        from += std::size_t(values.Components) * sizeof(T);
      }
    });
  return result;
}

class VtkHdfSeries : public CellSeries
{
public:
  VtkHdfSeries(const std::string& path, const SeriesOptions& options)
    : CellSeries(options.Wrap)
    , File(path)
  {
    this->Path = path;
    this->Kind = "VTKHDF";
    this->Times = this->File.times();
    checkTimes(path, this->Times);
    this->Known.insert(0);
    for (std::size_t step = 1; step < this->File.steps(); ++step)
    {
      if (this->File.points(step) != this->File.points(0) ||
        this->File.cells(step) != this->File.cells(0))
      {
        this->failAt(step);
      }
    }
    this->addVariables();
    this->setSize(this->File.points(0), this->File.cells(0));
  }

protected:
  std::unique_ptr<CellBlocks> openCells() override
  {
    const HdfValues points = this->File.readPoints(0);
    CellMesh mesh;
    mesh.XY = interleaved(componentOf(points, 0), componentOf(points, 1));
    HdfCells cells = this->readCells(0);
    mesh.Offsets.push_back(0);
    const std::vector<double> ghost = this->ghostTypes();
    for (std::size_t cell = 0; cell + 1 < cells.Offsets.size(); ++cell)
    {
      if (ghost.empty() || ghost[cell] == 0) // other parts have those that are ghosts
      {
        this->addCell(cells, cell, mesh.Corners);
      }
      mesh.Offsets.push_back(std::int64_t(mesh.Corners.size()));
    }
    if (mesh.Corners.empty())
    {
      throw IOError(this->Path, "has no triangles or polygons; choose a file that has some.");
    }
    return sourceOf(std::move(mesh));
  }

  void readStored(std::size_t variable, std::size_t step, std::vector<double>& values) override
  {
    this->requireSameMesh(step);
    const Source& source = this->Sources.at(variable);
    values =
      componentOf(source.Array ? this->File.read(*source.Array, step) : this->File.readPoints(step),
        source.Component);
  }

private:
  /// Where a variable is: a component of an array or, without one, of the points.
  struct Source
  {
    std::optional<HdfArray> Array;
    std::int64_t Component;
  };

  [[noreturn]] void failAt(std::size_t step) const
  {
    throw IOError(this->Path,
      "has other points or cells at step " + std::to_string(step) +
        " (from 0) than at step 0, and a mesh that moves is not resampled; extract single steps in "
        "ParaView.");
  }

  void addVariables()
  {
    for (const HdfArray& array : this->File.arrays())
    {
      if (array.Name == ghosts || isIds(array.Name))
      {
        continue;
      }
      const bool varies = this->File.varies(array);
      for (std::int64_t i = 0; i < array.Components; ++i)
      {
        const std::string name =
          array.Components == 1 ? array.Name : array.Name + "_" + std::to_string(i);
        SeriesVariable variable{ freeName(this->Variables, name), "", "", array.Type, array.OnCells,
          varies };
        variable.Vector = array.Components == 1 ? "" : array.Name;
        this->Variables.push_back(std::move(variable));
        this->Sources.push_back({ array, i });
      }
    }
    this->Variables.push_back(
      { heightName(this->Variables), "", "", Scalar::Float64, false, false });
    this->Sources.push_back({ std::nullopt, 2 });
  }

  std::vector<double> ghostTypes()
  {
    for (const HdfArray& array : this->File.arrays())
    {
      if (array.Name == ghosts && array.OnCells)
      {
        return componentOf(this->File.read(array, 0), 0);
      }
    }
    return {};
  }

  /// The cells of a step, with types also of poly data.
  HdfCells readCells(std::size_t step)
  {
    if (!this->File.isPolyData())
    {
      return this->File.readCells(step);
    }
    for (const std::string& group : VtkHdfFile::cellGroups())
    {
      if (group != "Polygons" && this->File.readCells(step, group).Offsets.size() > 1)
      {
        throw IOError(this->Path, "has points, lines or strips besides polygons; remove them.");
      }
    }
    HdfCells cells = this->File.readCells(step, "Polygons");
    cells.Types.assign(cells.Offsets.size() - 1, Polygon);
    return cells;
  }

  void addCell(const HdfCells& cells, std::size_t cell, std::vector<std::int64_t>& corners) const
  {
    const unsigned char type = cells.Types[cell];
    requireCellType(this->Path, type);
    if (type <= LastOfLines)
    {
      return; // no area
    }
    const std::int64_t first = cells.Offsets[cell];
    const std::int64_t count = cells.Offsets[cell + 1] - first;
    const bool isRight = type == Polygon ? count >= 3
      : type == Triangle                 ? count == 3
                                         : (type == Pixel || type == Quad) && count == 4;
    if (!isRight)
    {
      throw IOError(this->Path,
        "cell " + std::to_string(cell) + " (from 0) has VTK's type " + std::to_string(type) +
          " and " + std::to_string(count) +
          " points, and triangles, quadrilaterals and polygons are resampled; extract the surface, "
          "or single steps, in ParaView.");
    }
    corners.insert(corners.end(), cells.Ids.begin() + first, cells.Ids.begin() + first + count);
    if (type == Pixel)
    {
      std::swap(corners[corners.size() - 1], corners[corners.size() - 2]);
    }
  }

  /// Throws IOError unless a step has the points and cells of step 0.
  void requireSameMesh(std::size_t step)
  {
    if (this->Known.count(step) == 0 && !this->File.haveEqualMesh(step, 0))
    {
      this->failAt(step);
    }
    this->Known.insert(step);
  }

  VtkHdfFile File;
  std::vector<Source> Sources; ///< by variable
  std::set<std::size_t> Known; ///< steps with the mesh of step 0
};

} // namespace

std::unique_ptr<MeshSeries> openVtkHdfSeries(const std::string& path, const SeriesOptions& options)
{
  refuseValues(path, options);
  requirePiecesOf(path);
  return std::make_unique<VtkHdfSeries>(path, options);
}

bool isVtkHdfSeries(const std::string& path)
{
  return extensionOf(path) == ".vtkhdf" && !isPartitionedMesh(path) && VtkHdfFile(path).steps() > 1;
}

} // namespace tipp
