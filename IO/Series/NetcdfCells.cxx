// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Parallel/Poll.h"
#include "Series/NetcdfMesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tipp
{
namespace
{

/// The most values that are read at once: enough to keep the disk busy, and 24 MB as 64 bits.
constexpr std::int64_t mostValues = std::int64_t(3) << 20;

/// Whether the variable's values may be radians: by its unit or, without one, if it is one of those
/// of MPAS, or FESOM's `nodes`, which are so if none is larger than a turn.
class RadiansTest
{
public:
  explicit RadiansTest(const NetcdfVariable& variable)
  {
    const std::string units = variable.text("units");
    const std::string& name = variable.Name;
    const bool isUsually = name == "nodes" || name == "lonVertex" || name == "latVertex" ||
      name == "lonCell" || name == "latCell";
    this->IsStated = units.compare(0, 3, "rad") == 0;
    this->MayBe = this->IsStated || (units.empty() && isUsually);
  }

  void add(double value)
  {
    constexpr double turn = 6.283185307179587;
    this->MayBe = this->MayBe && (this->IsStated || std::fabs(value) <= turn);
  }

  bool result() const { return this->MayBe; }

private:
  bool IsStated;
  bool MayBe;
};

/// Reads the nodes block by block.
class NodeReader
{
public:
  NodeReader(NetcdfFile& file, const NetcdfMesh& mesh)
    : File(file)
    , Mesh(mesh)
    , Count(file.content().size(mesh.NodeDimension))
  {
  }

  SeriesNodes read()
  {
    constexpr double degrees = 57.295779513082320877; // of a radian
    const double scale = this->areRadians() ? degrees : 1;
    SeriesNodes nodes;
    std::vector<double> xy;
    for (std::int64_t begin = 0; begin < this->Count; begin += block)
    {
      const std::int64_t count = std::min(block, this->Count - begin);
      this->readBlock(begin, count);
      xy.resize(2 * std::size_t(count));
      for (std::size_t i = 0; i < std::size_t(count); ++i)
      {
        xy[2 * i] = this->X[i] * scale;
        xy[2 * i + 1] = this->Y[i] * scale;
      }
      nodes.add(xy, this->Count - begin - count);
    }
    return nodes;
  }

private:
  static constexpr std::int64_t block = std::int64_t(1) << 20;

  bool areRadians()
  {
    RadiansTest x(*this->Mesh.X);
    RadiansTest y(*this->Mesh.Y);
    for (std::int64_t begin = 0; begin < this->Count && x.result() && y.result(); begin += block)
    {
      const std::int64_t count = std::min(block, this->Count - begin);
      this->readBlock(begin, count);
      for (std::size_t i = 0; i < std::size_t(count); ++i)
      {
        x.add(this->X[i]);
        y.add(this->Y[i]);
      }
    }
    return x.result() && y.result();
  }

  void readBlock(std::int64_t begin, std::int64_t count)
  {
    const bool hasBoth = this->Mesh.X == this->Mesh.Y; // a row of each
    this->readRow(*this->Mesh.X, hasBoth, 0, begin, count, this->X);
    this->readRow(*this->Mesh.Y, hasBoth, 1, begin, count, this->Y);
  }

  void readRow(const NetcdfVariable& variable, bool hasRows, std::int64_t row, std::int64_t begin,
    std::int64_t count, std::vector<double>& values)
  {
    using Indices = std::vector<std::int64_t>;
    hasRows ? this->File.read(variable, Indices{ row, begin }, Indices{ 1, count }, values)
            : this->File.read(variable, Indices{ begin }, Indices{ count }, values);
  }

  NetcdfFile& File;
  const NetcdfMesh& Mesh;
  const std::int64_t Count;
  std::vector<double> X;
  std::vector<double> Y;
};

/// Reads the corners of the cells block by block, and decides with which number nodes begin.
class NetcdfCells : public CellBlocks
{
public:
  NetcdfCells(NetcdfFile& file, const NetcdfMesh& mesh)
    : File(file)
    , Mesh(mesh)
    , Nodes(file.content().size(mesh.NodeDimension))
    , IsTransposed(mesh.Corners->Dimensions[1] == mesh.CellDimension)
    , Width(file.content().size(mesh.Corners->Dimensions[this->IsTransposed ? 0 : 1]))
  {
    this->Cells = file.content().size(mesh.CellDimension);
    this->IsInDegrees = isInDegrees(mesh);
    if (this->Nodes == 0 || this->Cells == 0)
    {
      throw IOError(file.path(), "has no nodes or no cells; copy it again.");
    }
    if (mesh.Counts && mesh.Counts->Dimensions != std::vector<int>{ mesh.CellDimension })
    {
      throw IOError(file.path(),
        "has '" + mesh.Counts->Name + "' of another size than the cells; copy it again.");
    }
  }

  SeriesNodes readNodes() override { return NodeReader(this->File, this->Mesh).read(); }

  bool next(CellBlock& block) override
  {
    if (this->Begin == 0)
    {
      this->First = this->findFirst();
    }
    if (this->Begin >= this->Cells)
    {
      this->File.rest(); // the work that follows needs much memory
      return false;
    }
    this->readBlock();
    block = {};
    block.First = this->Begin;
    block.Corners.reserve(this->Numbers.size());
    block.Offsets.push_back(0);
    bool areTriangles = true;
    for (std::int64_t cell = 0; cell < this->Count; ++cell)
    {
      pollAt(cell);
      this->addCell(std::size_t(cell), block.Corners);
      areTriangles = areTriangles && std::int64_t(block.Corners.size()) - block.Offsets.back() == 3;
      block.Offsets.push_back(std::int64_t(block.Corners.size()));
    }
    if (areTriangles)
    {
      block.Offsets.clear();
    }
    this->Begin += this->Count;
    return true;
  }

private:
  using Indices = std::vector<std::int64_t>;

  std::int64_t blockSize() const { return std::max<std::int64_t>(1, mostValues / this->Width); }

  Indices readCorners(std::int64_t begin, std::int64_t count)
  {
    return this->IsTransposed ? this->File.readIntegers(*this->Mesh.Corners, Indices{ 0, begin },
                                  Indices{ this->Width, count })
                              : this->File.readIntegers(*this->Mesh.Corners, Indices{ begin, 0 },
                                  Indices{ count, this->Width });
  }

  void readBlock()
  {
    this->Count = std::min(this->blockSize(), this->Cells - this->Begin);
    this->Numbers = this->readCorners(this->Begin, this->Count);
    if (this->Mesh.Counts)
    {
      this->Counts =
        this->File.readIntegers(*this->Mesh.Counts, Indices{ this->Begin }, Indices{ this->Count });
    }
  }

  /// Without a statement of the file, all numbers must be nodes.
  std::int64_t findFirst()
  {
    const auto stated = this->Mesh.Corners->number("start_index");
    if (!stated && this->Mesh.Corners->find("start_index"))
    {
      throw IOError(this->File.path(),
        "has the start_index '" + shownText(this->Mesh.Corners->text("start_index")) +
          "', which is no number; correct the attribute.");
    }
    if (stated)
    {
      if (*stated != 0 && *stated != 1)
      {
        throw IOError(this->File.path(),
          "states that its nodes are counted from " + shortText(*stated) +
            " (start_index); only 0 and 1 are read.");
      }
      return std::int64_t(*stated);
    }
    std::int64_t least = this->Nodes;
    std::int64_t most = 0;
    for (std::int64_t begin = 0; begin < this->Cells; begin += this->blockSize())
    {
      const std::int64_t count = std::min(this->blockSize(), this->Cells - begin);
      for (const std::int64_t number : this->readCorners(begin, count))
      {
        least = number >= 0 ? std::min(least, number) : least;
        most = std::max(most, number);
      }
    }
    const bool isFromOne = most == this->Nodes && (least > 0 || this->Mesh.FirstNode == 1);
    return isFromOne ? 1 : least == 0 ? 0 : this->Mesh.FirstNode.value_or(0);
  }

  std::size_t widthOf(std::size_t cell) const
  {
    if (this->Counts.empty())
    {
      return std::size_t(this->Width);
    }
    const std::int64_t count = this->Counts[cell];
    if (count < 3 || count > this->Width)
    {
      this->fail(cell,
        "has " + std::to_string(std::max<std::int64_t>(count, -1)) + " corners by '" +
          this->Mesh.Counts->Name + "'; copy the file again.");
    }
    return std::size_t(count);
  }

  void addCell(std::size_t cell, Indices& corners) const
  {
    const std::size_t before = corners.size();
    const std::size_t width = this->widthOf(cell);
    bool hasEnded = false;
    for (std::size_t corner = 0; corner < width; ++corner)
    {
      const std::int64_t number = this->IsTransposed
        ? this->Numbers[corner * std::size_t(this->Count) + cell]
        : this->Numbers[cell * std::size_t(this->Width) + corner];
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
    throw IOError(this->File.path(),
      "cell " + std::to_string(this->Begin + std::int64_t(cell)) + " (from 0) " + problem);
  }

  NetcdfFile& File;
  const NetcdfMesh& Mesh;
  const std::int64_t Nodes;
  const bool IsTransposed;  ///< the first corners of all cells come first
  const std::int64_t Width; ///< the most corners of a cell
  std::int64_t First = 0;   ///< the number of the first node
  ///@{ The block that is read.
  std::int64_t Begin = 0;
  std::int64_t Count = 0;
  Indices Numbers;
  Indices Counts;
  ///@}
};

} // namespace

std::unique_ptr<CellBlocks> openNetcdfCells(NetcdfFile& file, const NetcdfMesh& mesh)
{
  return std::make_unique<NetcdfCells>(file, mesh);
}

} // namespace tipp
