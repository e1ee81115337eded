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

/// Reads the cells of a flat mesh in chunks, as 64-bit vertex ids that are checked.
class VTKTIPPIO_EXPORT CellReader
{
public:
  /// Cells from `first` up to, but without, `last`; -1: up to the end. `threads`: 0 is OpenMP's
  /// choice. Throws IOError if the file cannot be opened, std::out_of_range for cells beyond the
  /// mesh.
  explicit CellReader(
    const FlatMesh& mesh, std::int64_t first = 0, std::int64_t last = -1, int threads = 0);

  /// The next chunk of at most `cells` cells (1 or more), CellSize ids each; false at the end. Its
  /// first cell is firstCell(). Throws IOError that names the first cell with an id that is
  /// negative or not that of a point.
  bool next(std::int64_t cells, std::vector<std::int64_t>& ids);
  std::int64_t firstCell() const { return this->First; }

  /// Any cells, without moving on; `ids` has room for CellSize ids each.
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
