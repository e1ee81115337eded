// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlattenImage.h"

#include "Arrays/Scalar.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/VtkXml.h"
#include "Parallel/Poll.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <unistd.h>

namespace tipp
{

std::vector<double> imagePoints(const RawVtkFile& file)
{
  std::vector<double> points;
  points.reserve(3 * std::size_t(file.PointCount));
  const auto at = [&file](int axis, std::int64_t index)
  { return double(index) * file.Spacing[std::size_t(axis)] + file.Origin[std::size_t(axis)]; };
  const auto& extent = file.Extent;
  for (std::int64_t z = extent[4]; z <= extent[5]; ++z)
  {
    for (std::int64_t y = extent[2]; y <= extent[3]; ++y)
    {
      for (std::int64_t x = extent[0]; x <= extent[1]; ++x)
      {
        points.insert(points.end(), { at(0, x), at(1, y), at(2, z) });
      }
    }
  }
  return points;
}

namespace
{

using Ids = std::vector<std::int64_t>;
using Bytes = std::vector<unsigned char>;

constexpr const char* ghosts = "vtkGhostType";

/// Of VTK's cell types and bits of vtkGhostType.
///@{
constexpr int pixel = 8;
constexpr int voxel = 11;
constexpr unsigned duplicateCell = 1;
constexpr unsigned hiddenCell = 32;
///@}

/// The triangles of a pixel, as VTK cuts it, and the tetrahedra of a voxel as flattenDataSet()
/// does: its first corner, which has the lowest id, is joined to halves of the faces without that
/// corner.
///@{
constexpr std::array<std::array<std::size_t, 3>, 2> trianglesOfPixel = { { { 0, 1, 3 },
  { 0, 3, 2 } } };
constexpr std::array<std::array<std::size_t, 4>, 6> tetrahedraOfVoxel = { { { 1, 3, 7, 0 },
  { 1, 7, 5, 0 }, { 2, 6, 7, 0 }, { 2, 7, 3, 0 }, { 4, 5, 7, 0 }, { 4, 7, 6, 0 } } };
///@}

/// Reads an array whole.
FlatArray readArray(const RawArray& array)
{
  const auto bytes = std::make_shared<std::vector<char>>(std::size_t(array.bytes()));
  if (!bytes->empty())
  {
    InputFile(array.Path).read(array.Offset, bytes->data(), bytes->size());
  }
  FlatArray result;
  result.Name = array.Name;
  result.Type = array.Type;
  result.Components = array.Components;
  result.Tuples = array.Tuples;
  result.Values = bytes->data();
  result.Owner = bytes;
  return result;
}

/// The marks of an array vtkGhostType; none if there is no such array.
Bytes ghostsIn(const std::vector<RawArray>& arrays)
{
  for (const RawArray& array : arrays)
  {
    if (array.Name == ghosts && array.Type == Scalar::UInt8 && array.Components == 1)
    {
      Bytes marks(std::size_t(array.Tuples));
      InputFile(array.Path).read(array.Offset, marks.data(), marks.size());
      return marks;
    }
  }
  return {};
}

/// Cuts the cells of an image into triangles or tetrahedra.
class ImageCutter
{
public:
  ImageCutter(const RawVtkFile& file, const std::vector<double>& points, Flattened& result)
    : Points(points)
    , CellGhosts(ghostsIn(file.CellData))
    , Result(result)
  {
    std::int64_t stride = 1;
    this->Corners = { 0 };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::int64_t size = file.Extent[2 * axis + 1] - file.Extent[2 * axis] + 1;
      this->Cells[axis] = std::max<std::int64_t>(size - 1, 1);
      this->Strides[axis] = stride;
      if (size > 1)
      {
        for (std::size_t i = 0, count = this->Corners.size(); i < count; ++i)
        {
          this->Corners.push_back(this->Corners[i] + stride);
        }
      }
      stride *= size;
    }
  }

  /// Sets the result's cells and counts. Returns the id of each simplex's cell in the image.
  Ids cut()
  {
    const bool isFlat = this->Corners.size() == 4;
    this->Result.Content.CellSize = isFlat ? 3 : 4;
    Ids parents;
    std::int64_t cell = 0;
    for (std::int64_t z = 0; z < this->Cells[2]; ++z)
    {
      for (std::int64_t y = 0; y < this->Cells[1]; ++y)
      {
        for (std::int64_t x = 0; x < this->Cells[0]; ++x, ++cell)
        {
          pollAt(cell);
          const std::int64_t first =
            x * this->Strides[0] + y * this->Strides[1] + z * this->Strides[2];
          const std::size_t simplices = this->cutCell(cell, first);
          parents.insert(parents.end(), simplices, cell);
        }
      }
    }
    return parents;
  }

private:
  /// Returns the number of simplices.
  std::size_t cutCell(std::int64_t cell, std::int64_t first)
  {
    const unsigned marks = this->CellGhosts.empty() ? 0 : this->CellGhosts[std::size_t(cell)];
    if ((marks & (duplicateCell | hiddenCell)) != 0)
    {
      ++this->Result.GhostCells;
      return 0;
    }
    if (this->Corners.size() == 4)
    {
      ++this->Result.Cut[cellTypeName(pixel)];
      return this->append(trianglesOfPixel, first);
    }
    ++this->Result.Cut[cellTypeName(voxel)];
    return this->append(tetrahedraOfVoxel, first);
  }

  template <typename Simplices>
  std::size_t append(const Simplices& simplices, std::int64_t first)
  {
    for (auto simplex : simplices)
    {
      if (simplex.size() == 4 && this->volume(simplex, first) < 0)
      {
        std::swap(simplex[0], simplex[1]);
      }
      for (const std::size_t corner : simplex)
      {
        this->Result.Content.Cells.push_back(first + this->Corners[corner]);
      }
    }
    return simplices.size();
  }

  template <typename Simplex>
  double volume(const Simplex& tetrahedron, std::int64_t first) const
  {
    Point3 p[4] = {};
    for (std::size_t i = 0; i < tetrahedron.size(); ++i)
    {
      const auto at = 3 * std::size_t(first + this->Corners[tetrahedron[i]]);
      p[i] = { this->Points[at], this->Points[at + 1], this->Points[at + 2] };
    }
    const Point3 u = p[1] - p[0];
    const Point3 v = p[2] - p[0];
    const Point3 w = p[3] - p[0];
    return u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) +
      u.z * (v.x * w.y - v.y * w.x);
  }

  const std::vector<double>& Points;
  const Bytes CellGhosts;
  Flattened& Result;
  std::array<std::int64_t, 3> Cells = {};   ///< number along each axis
  std::array<std::int64_t, 3> Strides = {}; ///< of points
  Ids Corners;                              ///< of a cell, from its first one
};

/// Returns the arrays, except for marks of ghosts. Those without a name get one.
std::vector<FlatArray> arraysOf(const std::vector<RawArray>& arrays)
{
  std::vector<FlatArray> result;
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    if (arrays[i].Name != ghosts)
    {
      result.push_back(readArray(arrays[i]));
      std::string& name = result.back().Name;
      name = name.empty() ? "array_" + std::to_string(i) : name;
    }
  }
  return result;
}

/// The number of axes along which the image has cells.
int dimensionOf(const RawVtkFile& file)
{
  int dimension = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    dimension += file.Extent[2 * axis + 1] > file.Extent[2 * axis] ? 1 : 0;
  }
  return file.PointCount > 0 ? dimension : 0;
}

/// The extent of an image without arrays is a number that nothing else in the file confirms.
void requireMemory(const RawVtkFile& file, int dimension, const std::string& path)
{
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  const double simplices = dimension == 2 ? 2 : 6;
  const double each = 3 * sizeof(double) + simplices * (dimension + 2) * sizeof(std::int64_t);
  if (double(file.PointCount) * each > memory)
  {
    throw IOError(path,
      "holds an image of " + std::to_string(file.PointCount) +
        " points, whose cells are more than the memory of this machine holds; give a part of it.");
  }
}

} // namespace

Flattened flattenImage(const RawVtkFile& file, const std::string& path)
{
  const int dimension = dimensionOf(file);
  if (dimension < 2)
  {
    throw IOError(path, "holds no cells with an area or a volume; triangulate its points first.");
  }
  requireMemory(file, dimension, path);
  std::vector<double> points = imagePoints(file);
  Flattened flattened;
  FlatContent& content = flattened.Content;
  Ids parents = ImageCutter(file, points, flattened).cut();
  const auto kept = std::make_shared<std::vector<double>>(std::move(points));
  content.Points = { "", Scalar::Float64, 3, file.PointCount, 0, kept->data(), kept };
  content.PointData = arraysOf(file.PointData);
  setCellData(flattened, arraysOf(file.CellData), std::move(parents));
  return flattened;
}

} // namespace tipp
