// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputPasses_h
#define tippInputPasses_h

#include "OutOfCore/InputSurvey.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/PiecePlan.h"
#include "Partitioned/PieceBorder.h"
#include "Partitioning/Spill.h"
#include "Ranks/Communicator.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

class SaveArchive;
class LoadArchive;

/// Writes the row of a block's point, in the order of PointRowLayout.
void writeRow(const PointBlock& block, std::size_t i, char* to);

/// Describes a spilled part of the stream.
struct SpilledPart
{
  std::int64_t Points = 0;
  SpilledRows Rows;                   ///< of Spill::close()
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

/// How a rank reads its part of the input.
struct PassOptions
{
  std::size_t BlockPoints; ///< at a time
  std::size_t SamplePoints;
  int Threads;
  /// Called with the number of points of a part that are done.
  std::function<void(std::int64_t)> Progress;
};

/// The passes over the input before its points are triangulated; on the first rank. If the input
/// can be divided, each rank reads a part; the first rank also reads those of ranks that do not see
/// the same input. The results do not depend on the parts.
class VTKTIPPFILTERS_EXPORT InputPasses
{
public:
  /// Ranks: null for this process alone.
  InputPasses(PointStream& points, Communicator* ranks, PassOptions options);

  InputSurvey survey();
  /// Sets the indices of the plan's initial points. `file`: a number is appended for each part.
  std::unique_ptr<SpilledPoints> spill(const InputSurvey& survey, PiecePlan& plan,
    const PointRowLayout& rows, const std::string& file);

private:
  double commonFactor(const InputSurvey& survey);
  template <typename Result, typename Work>
  std::vector<Result> share(MessageKind kind, SaveArchive order, const Work& work);
  Bytes answerOf(int rank);
  void poll();
  std::function<void(std::int64_t)> progress();

  PointStream& Points;
  Communicator* const Ranks;
  const PassOptions Options;
  const std::int64_t Total; ///< points, or -1
  const int Parts;
  std::deque<Message> Arrived;
};

/// Reads the parts of a rank other than the first.
class VTKTIPPFILTERS_EXPORT InputHelper
{
public:
  /// Progress throws to end the run. The other options come from the first rank.
  InputHelper(
    Communicator& ranks, std::function<std::unique_ptr<PointStream>()> open, PassOptions options);

  /// Handles a request of the first rank; returns false if the message is something else.
  bool take(const Message& message);

private:
  void open(LoadArchive& order);
  Bytes survey();
  Bytes factor(LoadArchive& order);
  Bytes spill(LoadArchive& order);

  Communicator& Ranks;
  const std::function<std::unique_ptr<PointStream>()> Open;
  PassOptions Options;
  std::unique_ptr<PointStream> Points; ///< limited to this rank's part; null if it is another input
};

} // namespace tipp

#endif
