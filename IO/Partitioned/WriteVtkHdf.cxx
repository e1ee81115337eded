// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/WriteVtkHdf.h"

#include "Arrays/Buffer.h"
#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/PiecesHdf.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Converts ids of 32 bits to 64 bits.
Buffer<char> widened(const Buffer<char>& narrow)
{
  const std::size_t count = narrow.size() / sizeof(std::int32_t);
  Buffer<char> wide(count * sizeof(std::int64_t));
  const auto* const from = reinterpret_cast<const std::int32_t*>(narrow.data());
  std::copy(from, from + count, reinterpret_cast<std::int64_t*>(wide.data()));
  return wide;
}

/// Writes the values behind all objects, piece by piece.
class VtkHdfWriter : public PiecesHdf
{
public:
  explicit VtkHdfWriter(const PartitionedMesh& mesh)
    : PiecesHdf(mesh)
  {
  }

  bool write(const std::string& path, const PathState& before, const std::function<bool()>& aborted)
  {
    // Where the values begin is known after the objects, whose size does not depend on it.
    this->addAll();
    const HdfAddress begin = this->Objects.end();
    this->Objects = HdfObjects();
    this->Targets.clear();
    this->Root.clear();
    this->End = begin;
    const HdfAddress root = this->addAll();
    std::string objects = this->Objects.take();
    const std::string superblock = HdfObjects::superblock(0, this->End, root);
    objects.replace(0, superblock.size(), superblock);

    const std::string folder = std::filesystem::absolute(path).parent_path().string();
    requireFreeSpace(path, folder, this->End);
    PendingFile output(path, before);
    output.file().write(0, objects.data(), objects.size());
    for (std::size_t piece = 0; piece < this->Mesh.Pieces.size(); ++piece)
    {
      if (aborted())
      {
        return false;
      }
      this->writePiece(output.file(), piece);
    }
    this->writeEnd(output.file());
    output.commit();
    return true;
  }

protected:
  HdfAddress addColumn(const HdfColumn& column) override
  {
    this->requireAllSteps(column);
    const HdfAddress begin = this->End;
    const std::uint64_t bytes = this->stepTuples(column) * this->tupleBytes(column);
    constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
    if (bytes > (most - begin) / (column.Steps.size() + 1))
    {
      throw IOError(this->Mesh.indexPath(), "has too many values; copy or make the mesh again.");
    }
    Target target{ column, {} };
    for (std::size_t step = 0; step < column.Steps.size(); ++step)
    {
      target.Next.push_back(begin + step * bytes);
    }
    this->Targets.push_back(std::move(target));
    this->End = (begin + column.Steps.size() * bytes + 7) / 8 * 8;
    return this->Objects.addArray(this->shapeOf(column), begin);
  }

private:
  /// A column, and where its next values go, by step.
  struct Target
  {
    HdfColumn Column;
    std::vector<std::uint64_t> Next;
  };

  static std::size_t tupleBytes(const HdfColumn& column)
  {
    const std::size_t bytes = column.Array.tupleBytes();
    return column.Array.Role == PieceRole::Connectivity
      ? bytes / std::size_t(column.Array.Components)
      : bytes;
  }

  /// Throws IOError unless an array that varies is stored once for each step, in their order.
  void requireAllSteps(const HdfColumn& column) const
  {
    const std::vector<PieceArray> arrays = pieceArrays(this->Mesh, PieceSummary());
    const std::int64_t first = arrays[column.Steps.front()].Attribute;
    if (first < 0 || this->Mesh.Arrays[std::size_t(first)].Step < 0)
    {
      return;
    }
    bool isRight = column.Steps.size() == this->Mesh.Times.size();
    for (std::size_t step = 0; step < column.Steps.size() && isRight; ++step)
    {
      const auto attribute = std::size_t(arrays[column.Steps[step]].Attribute);
      const StoredArray& array = this->Mesh.Arrays[attribute];
      isRight = array.Step == int(step) && array.Type == column.Array.Type &&
        array.Components == column.Array.Components;
    }
    if (!isRight)
    {
      throw IOError(this->Mesh.indexPath(),
        "does not have the array '" + column.Name +
          "' at each step, of one type; copy or make the mesh again.");
    }
  }

  void writePiece(const OutputFile& output, std::size_t number)
  {
    const PieceFile file(this->Mesh, number);
    for (Target& target : this->Targets)
    {
      for (std::size_t step = 0; step < target.Next.size(); ++step)
      {
        const Buffer<char> values = this->read(file, target.Column, target.Column.Steps[step]);
        std::uint64_t& next = target.Next[step];
        this->writeLead(output, target.Column, next);
        output.write(next, values.data(), values.size());
        next += values.size();
      }
    }
  }

  /// Reads an array of a piece, given by its index, in the column's type.
  Buffer<char> read(const PieceFile& file, const HdfColumn& column, std::size_t index) const
  {
    const PieceArray& array = file.arrays()[index];
    const std::int64_t tuples = storedTuples(this->Mesh, file.summary(), array.ofPoints());
    Buffer<char> values(std::size_t(tuples) * array.tupleBytes());
    file.read(index, 0, file.partStarts(array.ofPoints()).size() - 1, values.data());
    if (array.Role == PieceRole::Connectivity)
    {
      array.Type == Scalar::Int64 ? this->requireIds<std::int64_t>(file, values)
                                  : this->requireIds<std::int32_t>(file, values);
    }
    else if (array.Role == PieceRole::Offsets || array.Role == PieceRole::Types)
    {
      // What they must be, whatever the file says.
      fillShapes(array, this->Mesh.CellSize, 0, tuples, values.data());
    }
    return array.Type == column.Array.Type ? std::move(values) : widened(values);
  }

  /// Throws IOError unless all corners are points of the piece.
  template <typename Id>
  void requireIds(const PieceFile& file, const Buffer<char>& corners) const
  {
    const auto* const ids = reinterpret_cast<const Id*>(corners.data());
    const std::int64_t points = storedTuples(this->Mesh, file.summary(), true);
    const bool areRight = std::all_of(ids, ids + corners.size() / sizeof(Id),
      [points](Id id) { return id >= 0 && std::int64_t(id) < points; });
    if (!areRight)
    {
      file.fail("has a cell at a point that it does not have");
    }
  }

  void writeLead(const OutputFile& output, const HdfColumn& column, std::uint64_t& next) const
  {
    const std::int64_t zero = 0;
    const std::size_t bytes = std::size_t(leadOf(column)) * this->tupleBytes(column);
    output.write(next, &zero, bytes);
    next += bytes;
  }

  /// Makes the file as long as its superblock says.
  void writeEnd(const OutputFile& output) const
  {
    const std::uint64_t padding = 0;
    std::uint64_t last = 0;
    for (const Target& target : this->Targets)
    {
      last = std::max(last, target.Next.back());
    }
    if (last < this->End)
    {
      output.write(last, &padding, std::size_t(this->End - last));
    }
  }

  std::vector<Target> Targets;
  std::uint64_t End = 0; ///< of the values
};

} // namespace

bool writeVtkHdf(const PartitionedMesh& mesh, const std::string& path, const PathState& before,
  const std::function<bool()>& aborted)
{
  bool isWritten = false;
  readUnchanged(mesh, [&] { isWritten = VtkHdfWriter(mesh).write(path, before, aborted); });
  return isWritten;
}

} // namespace tipp
