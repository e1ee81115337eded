// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadPiece_h
#define tippReadPiece_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFile.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace tipp
{

/// Uninitialised memory from malloc that a VTK array can take ownership of (VTK_DATA_ARRAY_FREE).
class RawBuffer
{
public:
  RawBuffer() = default;
  explicit RawBuffer(std::size_t bytes)
    // malloc(0) may return null, which VTK does not accept as an array.
    : Memory(std::malloc(bytes == 0 ? 1 : bytes))
    , Bytes(bytes)
  {
    if (!this->Memory)
    {
      throw std::bad_alloc();
    }
  }

  char* data() const { return static_cast<char*>(this->Memory.get()); }
  template <typename Value>
  Value* as() const
  {
    return static_cast<Value*>(this->Memory.get());
  }
  std::size_t size() const { return this->Bytes; }

  /// Releases ownership; the caller must free() the memory.
  void* release() { return this->Memory.release(); }

private:
  struct Free
  {
    void operator()(void* memory) const { std::free(memory); }
  };
  std::unique_ptr<void, Free> Memory;
  std::size_t Bytes = 0;
};

struct PieceOptions
{
  bool Borrowed = true; ///< also read the borrowed cells, as ghosts
  /// For each of PartitionedMesh::Arrays whether to read it; empty: all.
  std::vector<bool> Wanted;
  int Step = 0; ///< the step to read of arrays that vary in time

  /// Whether the mesh's array with this index is to be read.
  bool wants(const PartitionedMesh& mesh, std::size_t attribute) const;
};

/// A piece in memory. Within each of a piece's parts, points and cells are in ascending order of
/// their global ids; borrowed cells, and the points that only these use, come last.
struct Piece
{
  struct Attribute
  {
    StoredArray Description;
    RawBuffer Values;
  };

  int CellSize = 3;
  Scalar PointType = Scalar::Float64;
  /// connectivity: std::int64_t if true, else std::int32_t; indices within the piece
  bool WideIds = false;
  std::int64_t Points = 0;
  std::int64_t OwnedPoints = 0; ///< the points before those of borrowed cells alone
  std::int64_t Cells = 0;
  std::int64_t OwnedCells = 0;
  RawBuffer Coordinates; ///< 3 per point
  RawBuffer PointIds;    ///< global ids, std::int64_t
  RawBuffer PointGhosts; ///< std::uint8_t; 1: another piece owns the point
  RawBuffer Connectivity;
  RawBuffer CellIds; ///< global ids, std::int64_t; cells from OwnedCells on are ghosts
  std::vector<Attribute> Attributes;
  ReadCounters Counters;

  /// Returns the index within the piece of a cell's corner; `number` is the corner's.
  std::int64_t corner(std::int64_t cell, int number) const
  {
    const auto at = std::size_t(cell * this->CellSize + number);
    return this->WideIds ? this->Connectivity.as<std::int64_t>()[at]
                         : this->Connectivity.as<std::int32_t>()[at];
  }
};

/// Reads a piece, each requested array with one read. Borrowed cells that are stored by reference
/// are read from their owners' files, where they and their points are contiguous; the result is the
/// same as with duplicated ones. Throws IOError. Threads may read pieces of a mesh concurrently.
VTKTIPPIO_EXPORT Piece readPiece(
  const PartitionedMesh& mesh, std::size_t number, const PieceOptions& options = {});

} // namespace tipp

#endif
