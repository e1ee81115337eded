// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellReader_h
#define tippCellReader_h

#include "Files/InputFile.h"
#include "Flat/FlatMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Reads the cells of a flat mesh in chunks, as 64-bit point indices, and checks these.
class VTKTIPPIO_EXPORT CellReader
{
public:
  /// Reads the cells in [first, last); last = -1 means the end. `threads` = 0 is OpenMP's default.
  /// Throws IOError if the file cannot be opened, std::out_of_range if the range exceeds the mesh.
  explicit CellReader(
    const FlatMesh& mesh, std::int64_t first = 0, std::int64_t last = -1, int threads = 0);

  /// Reads the next chunk of at most `cells` cells (1 or more), CellSize point indices each;
  /// returns false at the end. The chunk's first cell is firstCell(). Throws IOError naming the
  /// first cell with a point index that is out of range.
  bool next(std::int64_t cells, std::vector<std::int64_t>& ids);
  std::int64_t firstCell() const { return this->First; }

  /// Reads cells [first, first + cells) without changing the position of next(). `ids` has room for
  /// cells * CellSize point indices.
  void read(std::int64_t first, std::int64_t cells, std::int64_t* ids) const;

private:
  void readBlock(std::int64_t firstId, std::int64_t count, std::int64_t* ids) const;
  [[noreturn]] void reportBadId(
    std::int64_t firstId, std::int64_t count, const std::int64_t* ids) const;

  RawArray Cells;
  std::int64_t Points;
  int CellSize;
  int Threads;
  InputFile File;
  std::int64_t First = 0;
  std::int64_t Next;
  std::int64_t Last;
};

} // namespace tipp

#endif
