// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSpilledPoints_h
#define tippSpilledPoints_h

#include "Ranks/Spill.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Returns the index of each piece's first row, and at the end the number of rows.
std::vector<std::int64_t> startsOf(const std::vector<std::int64_t>& counts);

/// The spilled points: a row for each finite point, sorted by piece, and in the order of the stream
/// within a piece. The index of a row is the id that the triangulation out of core uses internally.
class VTKTIPPFILTERS_EXPORT SpilledPoints
{
public:
  /// Joins the rows of all parts of the stream, in their order. `words`: 64-bit words per row.
  /// Throws IOError.
  SpilledPoints(const std::string& file, std::size_t words, const std::vector<SpilledRows>& parts);

  /// Opens the file of points that another process has spilled. Throws IOError if it does not have
  /// this number of pieces.
  SpilledPoints(
    const std::string& file, std::size_t words, PartitionIndex pieces, LoadArchive& archive);
  /// Saves what the second constructor needs besides the file.
  void save(SaveArchive& archive) const;

  /// Returns the index of each piece's first row, and at the end the number of rows.
  const std::vector<std::int64_t>& starts() const { return this->Starts; }
  std::int64_t first(PartitionIndex piece) const { return this->Starts[std::size_t(piece)]; }
  std::int64_t count(PartitionIndex piece) const { return this->Rows.rows(std::size_t(piece)); }
  /// Returns the piece of a row, given by its index.
  PartitionIndex pieceOf(std::int64_t index) const;
  /// Reads all rows of a piece; `rows` must have space for count(piece) of them. Throws IOError.
  void read(PartitionIndex piece, double* rows) const
  {
    this->Rows.readAll(std::size_t(piece), rows);
  }
  std::uint64_t bytes() const { return this->Rows.bytes(); }

private:
  Spill Rows;
  std::vector<std::int64_t> Starts;
};

} // namespace tipp

#endif
