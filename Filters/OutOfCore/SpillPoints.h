// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSpillPoints_h
#define tippSpillPoints_h

#include "OutOfCore/PiecePlan.h"
#include "Partitioned/PointRows.h"
#include "Partitioning/Spill.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

class SaveArchive;
class LoadArchive;

/// Describes a spilled part of the stream.
struct SpilledPart
{
  std::int64_t Points = 0;
  std::vector<std::uint64_t> Rows;    ///< of Spill::close()
  std::vector<std::int64_t> Counts;   ///< of finite points, of each piece
  std::vector<std::int64_t> InPieces; ///< indices of the part's initial points in their pieces
};

/// Spills the part of the stream that `points` is limited to, to part number `part` of the file.
/// Coordinates are scaled by `factor` to find their pieces; rows hold them as they are.
VTKTIPPFILTERS_EXPORT SpilledPart spillPart(PointStream& points, double factor,
  const PiecePlan& plan, const PointRowLayout& rows, const std::string& file, int part,
  std::size_t blockPoints, int threads, const std::function<void(std::int64_t)>& progress);

/// The finite points as rows, piece by piece, in the order of the stream within each.
class VTKTIPPFILTERS_EXPORT SpilledPoints
{
public:
  /// Joins all parts of the stream, in their order, and sets the indices of the plan's initial
  /// points.
  SpilledPoints(const std::vector<SpilledPart>& parts, const InputSurvey& survey, PiecePlan& plan,
    const PointRowLayout& rows, const std::string& file);

  /// Restores the points that another process has spilled to the file. Throws IOError.
  SpilledPoints(const std::string& file, const PiecePlan& plan, const PointRowLayout& rows,
    LoadArchive& archive);
  void save(SaveArchive& archive) const;

  /// The index of each piece's first point among all, and, at the end, the number of points.
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
