// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSpillPoints_h
#define tippSpillPoints_h

#include "OutOfCore/PiecePlan.h"
#include "Partitioned/GrowingPiece.h"
#include "Partitioning/Spill.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

class SaveArchive;
class LoadArchive;

/// The finite points as rows, piece by piece, in the order of the stream within each. Tells the
/// plan's initial points their places.
class VTKTIPPFILTERS_EXPORT SpilledPoints
{
public:
  /// One pass over the stream. `file`: where to put them.
  SpilledPoints(PointStream& points, const InputSurvey& survey, PiecePlan& plan,
    const PointRowLayout& rows, const std::string& file, std::size_t blockPoints, int threads,
    const std::function<void(std::int64_t)>& progress);

  /// Those that another process has spilled to the file.
  SpilledPoints(const std::string& file, const PiecePlan& plan, const PointRowLayout& rows,
    LoadArchive& archive);
  void save(SaveArchive& archive) const;

  /// The place of a piece's first point among all, and, at the end, the number of points.
  const std::vector<std::int64_t>& starts() const { return this->Starts; }
  std::int64_t count(PartitionIndex piece) const
  {
    return this->Starts[std::size_t(piece) + 1] - this->Starts[std::size_t(piece)];
  }
  void read(PartitionIndex piece, double* rows) const
  {
    this->Rows.readAll(std::size_t(piece), rows);
  }
  std::uint64_t bytes() const { return this->Rows.bytes(); }

private:
  std::vector<std::int64_t> Starts;
  Spill Rows;
};

} // namespace tipp

#endif
