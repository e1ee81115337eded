// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfMesh.h"

#include "Files/IOError.h"
#include "Parallel/Poll.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tipp
{
namespace
{

/// Whether the values are radians. Without units, those of MPAS are, and those of FESOM's `nodes`
/// if none is larger than a turn.
bool isInRadians(const NetcdfVariable& variable, const std::vector<double>& values)
{
  constexpr double turn = 6.283185307179587;
  const std::string units = variable.text("units");
  const std::string& name = variable.Name;
  const bool isUsually = name == "nodes" || name == "lonVertex" || name == "latVertex" ||
    name == "lonCell" || name == "latCell";
  return units.compare(0, 3, "rad") == 0 ||
    (units.empty() && isUsually &&
      std::all_of(
        values.begin(), values.end(), [](double value) { return std::fabs(value) <= turn; }));
}

void toDegrees(std::vector<double>& radians)
{
  constexpr double degrees = 57.295779513082320877; // of a radian
  std::transform(
    radians.begin(), radians.end(), radians.begin(), [](double value) { return value * degrees; });
}

std::vector<double> readCoordinates(NetcdfFile& file, const NetcdfMesh& mesh)
{
  std::vector<double> x = file.read(*mesh.X);
  std::vector<double> y;
  if (mesh.X == mesh.Y) // a row of each
  {
    const auto half = std::ptrdiff_t(x.size() / 2);
    y.assign(x.begin() + half, x.end());
    x.resize(std::size_t(half));
  }
  else
  {
    y = file.read(*mesh.Y);
  }
  if (x.size() != y.size())
  {
    throw IOError(file.path(),
      "has " + std::to_string(x.size()) + " values of '" + mesh.X->Name + "' and " +
        std::to_string(y.size()) + " of '" + mesh.Y->Name + "'; copy it again.");
  }
  if (isInRadians(*mesh.X, x) && isInRadians(*mesh.Y, y))
  {
    toDegrees(x);
    toDegrees(y);
  }
  std::vector<double> xy(2 * x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    xy[2 * i] = x[i];
    xy[2 * i + 1] = y[i];
  }
  return xy;
}

/// Reads the corners of all cells, and decides with which number nodes begin.
class CornerReader
{
public:
  CornerReader(NetcdfFile& file, const NetcdfMesh& mesh, std::int64_t nodes)
    : File(file)
    , Mesh(mesh)
    , Nodes(nodes)
    , Numbers(file.readIntegers(*mesh.Corners))
    , Cells(std::size_t(file.content().size(mesh.CellDimension)))
    , Width(this->Cells > 0 ? this->Numbers.size() / this->Cells : 0)
    , IsTransposed(
        mesh.Corners->Dimensions.size() == 2 && mesh.Corners->Dimensions[1] == mesh.CellDimension)
    , First(this->findFirst())
  {
    if (mesh.Counts)
    {
      this->Counts = file.readIntegers(*mesh.Counts);
      if (this->Counts.size() != this->Cells)
      {
        throw IOError(file.path(),
          "has '" + mesh.Counts->Name + "' of another size than the cells; copy it again.");
      }
    }
  }

  void read(CellMesh& cells)
  {
    cells.Offsets.push_back(0);
    for (std::size_t cell = 0; cell < this->Cells; ++cell)
    {
      pollAt(std::int64_t(cell));
      this->addCell(cell, cells.Corners);
      this->AreTriangles =
        this->AreTriangles && std::int64_t(cells.Corners.size()) - cells.Offsets.back() == 3;
      cells.Offsets.push_back(std::int64_t(cells.Corners.size()));
    }
    if (this->AreTriangles)
    {
      cells.Offsets.clear();
    }
  }

private:
  std::int64_t findFirst() const
  {
    if (const auto stated = this->Mesh.Corners->number("start_index"))
    {
      return *stated == 1 ? 1 : 0;
    }
    std::int64_t least = this->Nodes;
    std::int64_t most = 0;
    for (const std::int64_t number : this->Numbers)
    {
      if (number >= 0)
      {
        least = std::min(least, number);
        most = std::max(most, number);
      }
    }
    // Without a statement of the file, all numbers must be nodes.
    const bool isFromOne = most == this->Nodes && (least > 0 || this->Mesh.FirstNode == 1);
    return isFromOne ? 1 : least == 0 ? 0 : this->Mesh.FirstNode.value_or(0);
  }

  void addCell(std::size_t cell, std::vector<std::int64_t>& corners)
  {
    const std::size_t before = corners.size();
    std::size_t width = this->Width;
    if (!this->Counts.empty())
    {
      const std::int64_t count = this->Counts[cell];
      if (count < 3 || count > std::int64_t(this->Width))
      {
        this->fail(cell,
          "has " + std::to_string(std::max<std::int64_t>(count, -1)) + " corners by '" +
            this->Mesh.Counts->Name + "'; copy the file again.");
      }
      width = std::size_t(count);
    }
    bool hasEnded = false;
    for (std::size_t corner = 0; corner < width; ++corner)
    {
      const std::int64_t number = this->IsTransposed ? this->Numbers[corner * this->Cells + cell]
                                                     : this->Numbers[cell * this->Width + corner];
      const bool isMissing = number < this->First;
      if (isMissing)
      {
        hasEnded = true;
        continue;
      }
      if ((hasEnded && !this->Mesh.SkipsIncomplete) || number - this->First >= this->Nodes)
      {
        this->fail(cell,
          hasEnded ? "has a corner after a missing one; copy the file again."
                   : "names node " + std::to_string(number) + ", but there are " +
              std::to_string(this->Nodes) + " nodes, counted from " + std::to_string(this->First) +
              "; copy the file again.");
      }
      corners.push_back(number - this->First);
    }
    if (this->Mesh.SkipsIncomplete && (hasEnded || corners.size() < before + 3))
    {
      corners.resize(before);
    }
    else if (corners.size() < before + 3)
    {
      this->fail(cell, "has fewer than three corners; copy the file again.");
    }
  }

  [[noreturn]] void fail(std::size_t cell, const std::string& problem) const
  {
    throw IOError(this->File.path(), "cell " + std::to_string(cell) + " (from 0) " + problem);
  }

  NetcdfFile& File;
  const NetcdfMesh& Mesh;
  const std::int64_t Nodes;
  const std::vector<std::int64_t> Numbers;
  const std::size_t Cells;
  const std::size_t Width; ///< the most corners of a cell
  const bool IsTransposed; ///< the first corners of all cells come first
  const std::int64_t First;
  std::vector<std::int64_t> Counts;
  bool AreTriangles = true;
};

} // namespace

void setMeshDimensions(const std::string& path, const NetcdfContent& content, NetcdfMesh& mesh,
  const std::string& cellDimension)
{
  const auto fail = [&](const NetcdfVariable& variable, const std::string& problem)
  { throw IOError(path, "'" + variable.Name + "' " + problem + "; copy the file again."); };
  if (mesh.Corners->Dimensions.size() != 2)
  {
    fail(*mesh.Corners, "should have two dimensions: cells and corners");
  }
  if (!mesh.Corners->Type || !mesh.X->Type || !mesh.Y->Type || (mesh.Counts && !mesh.Counts->Type))
  {
    fail(!mesh.X->Type ? *mesh.X : !mesh.Y->Type ? *mesh.Y : *mesh.Corners, "should be numbers");
  }
  const bool hasBoth = mesh.X == mesh.Y;
  if (mesh.X->Dimensions.size() != (hasBoth ? 2 : 1) || mesh.X->Dimensions != mesh.Y->Dimensions ||
    (hasBoth && content.size(mesh.X->Dimensions[0]) != 2))
  {
    fail(*mesh.X, "should have one dimension, the nodes, and '" + mesh.Y->Name + "' the same");
  }
  mesh.NodeDimension = mesh.X->Dimensions.back();
  const std::vector<std::int64_t> shape = content.shape(*mesh.Corners);
  const int stated = content.findDimension(cellDimension);
  const bool isSecond = stated >= 0 ? stated == mesh.Corners->Dimensions[1]
                                    : (shape[0] == 3 || shape[0] == 4) && shape[1] > 4;
  mesh.CellDimension = mesh.Corners->Dimensions[isSecond ? 1 : 0];
  if (shape[isSecond ? 0 : 1] < 3)
  {
    fail(*mesh.Corners, "should have at least three corners per cell");
  }
  for (const NetcdfVariable* part : { mesh.X, mesh.Y, mesh.Corners })
  {
    mesh.Parts.insert(part->Name);
  }
}

bool isInDegrees(const NetcdfMesh& mesh)
{
  const std::string units = mesh.X->text("units");
  return units.compare(0, 6, "degree") == 0 || units.compare(0, 3, "rad") == 0 ||
    mesh.X->text("standard_name") == "longitude" || mesh.X->Name == "nodes" ||
    mesh.X->Name == "lonVertex" || mesh.X->Name == "lonCell";
}

CellMesh readNetcdfMesh(NetcdfFile& file, const NetcdfMesh& mesh)
{
  CellMesh cells;
  cells.XY = readCoordinates(file, mesh);
  if (cells.XY.empty() || file.content().size(mesh.CellDimension) == 0)
  {
    throw IOError(file.path(), "has no nodes or no cells; copy it again.");
  }
  cells.IsInDegrees = isInDegrees(mesh);
  CornerReader(file, mesh, std::int64_t(cells.XY.size() / 2)).read(cells);
  return cells;
}

} // namespace tipp
