// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputPasses_h
#define tippInputPasses_h

#include "Arrays/Random.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Partitioned/GrowingPiece.h"
#include "Points/ReadPoints.h"
#include "Predicates/Points.h"
#include "Ranks/Communicator.h"
#include "Ranks/Spill.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

struct PiecePlan;

/// A point of a sample.
template <typename Point>
struct SampledPointOf
{
  std::int64_t Id; ///< index in the stream
  Point Position;
};

/// Picks one point from each range of ids, at random but always the same. Ranges double in length
/// until their number is at most twice `atLeast`. (Picks at equal distances could hit one column of
/// a lattice given row by row.) If the number of all points is known, the picks from a part of the
/// stream are those that the whole stream gives there.
template <typename Point>
class StreamSampler
{
public:
  /// `atLeast`: the smallest size of the sample if the stream has that many points. `points`: the
  /// number of points in the whole stream, or -1.
  StreamSampler(std::size_t atLeast, std::int64_t points)
    : Most(2 * std::int64_t(std::max<std::size_t>(atLeast, 1)))
    , IsKnown(points >= 0)
  {
    while (this->IsKnown && this->pick(this->Most - 1, this->Doublings) < points)
    {
      ++this->Doublings;
    }
  }

  /// Adds the next points of the stream; the first of them has the id `first`. `points` has size()
  /// and operator[].
  template <typename View>
  void add(std::int64_t first, const View& points)
  {
    const std::int64_t end = first + std::int64_t(points.size());
    this->Range = std::max(this->Range, first >> this->Doublings);
    for (std::int64_t id = this->next(); id < end; id = this->next())
    {
      ++this->Range;
      if (id < first)
      {
        continue; // the pick belongs to an earlier part
      }
      this->Picks.push_back({ id, points[std::size_t(id - first)] });
      if (!this->IsKnown && this->Range == this->Most)
      {
        this->halve();
      }
    }
  }

  /// Returns the picks that are finite, and leaves none.
  std::vector<SampledPointOf<Point>> take()
  {
    this->Picks.erase(std::remove_if(this->Picks.begin(), this->Picks.end(),
                        [](const SampledPointOf<Point>& p) { return !isFinite(p.Position); }),
      this->Picks.end());
    return std::move(this->Picks);
  }

private:
  std::int64_t next() const { return this->pick(this->Range, this->Doublings); }

  /// Which one of two neighbouring ranges keeps its pick when ranges double.
  static std::int64_t chosenOf(std::int64_t pair) { return 2 * pair + (mixBits(pair) & 1); }

  /// Returns the id picked for a range after this many doublings. For the first half of the ranges,
  /// it was picked when they were shorter.
  std::int64_t pick(std::int64_t range, int doublings) const
  {
    while (doublings > 0 && range < this->Most / 2)
    {
      range = chosenOf(range);
      --doublings;
    }
    const std::int64_t length = std::int64_t(1) << doublings;
    return range * length +
      std::int64_t(mixBits(std::uint64_t(range * 64 + doublings)) % std::uint64_t(length));
  }

  /// Doubles the length of ranges.
  void halve()
  {
    const std::int64_t half = this->Most / 2;
    for (std::int64_t i = 0; i < half; ++i)
    {
      this->Picks[std::size_t(i)] = this->Picks[std::size_t(chosenOf(i))];
    }
    this->Picks.resize(std::size_t(half));
    this->Range = half;
    ++this->Doublings;
  }

  const std::int64_t Most;
  const bool IsKnown;
  std::vector<SampledPointOf<Point>> Picks;
  std::int64_t Range = 0; ///< the next range to pick from
  int Doublings = 0;
};

using SampledPoint = SampledPointOf<Point2>;

/// The result of the first pass over a stream or a part of it. Coordinates are multiplied by
/// Factor.
struct InputSurvey
{
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;         ///< points with NaN or infinite coordinates
  std::int64_t WithoutElevation = 0; ///< points whose elevation is NaN or infinite
  Box2 Bounds{ HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL }; ///< of the finite points
  /// A power of two that brings very small or large coordinates to about 1; else 1.
  double Factor = 1;
  /// Whether all finite points are on one line.
  bool Collinear = true;
  std::vector<Point2> Line;         ///< of a part, if collinear: at most two points of the line
  std::vector<SampledPoint> Sample; ///< finite points, ascending ids
};

template <typename Archive>
void serialize(Archive& archive, InputSurvey& part)
{
  archive(part.Points, part.Rejected, part.WithoutElevation, part.Bounds, part.Factor,
    part.Collinear, part.Line, part.Sample);
}

/// How a rank reads its part of the input.
struct PassOptions
{
  std::size_t BlockPoints;  ///< points per read
  std::size_t SamplePoints; ///< smallest size of the sample of all parts together
  int Threads;
  /// Called with the number of finished points of a part.
  std::function<void(std::int64_t)> Progress;
};

/// Surveys the points of the stream; Factor is 1. The sample of all parts together has at most
/// twice as many points as SamplePoints: one from each range of ids of equal length, chosen at
/// random but always the same. Throws IOError.
VTKTIPPFILTERS_EXPORT InputSurvey surveyPart(PointStream& points, const PassOptions& options);

/// Joins the surveys of all parts, in their order. The result does not depend on the division into
/// parts.
VTKTIPPFILTERS_EXPORT InputSurvey joinSurveys(std::vector<InputSurvey>& parts);

/// Sets the factor, and multiplies the bounds and the sample by it.
VTKTIPPFILTERS_EXPORT void applyFactor(InputSurvey& survey, double factor);

/// Throws the IOError for an input that is not the same in all passes.
[[noreturn]] void throwChanged();

/// Writes the row of point number i of the block to `to`, in the order of PointRowLayout.
void writeRow(const PointBlock& block, std::size_t i, char* to);

/// Describes the spilled rows of a part of the stream.
struct SpilledPart
{
  std::int64_t Points = 0;
  SpilledRows Rows; ///< as Spill::close() returned them
  /// By initial point of this part: its index among the part's points of the same piece.
  std::vector<std::int64_t> InPieces;
};

/// Spills the part of the stream to which `points` is limited, as part number `part` of `file`. A
/// point's piece is found with its coordinates times `factor`; rows have the original coordinates.
/// Throws IOError.
VTKTIPPFILTERS_EXPORT SpilledPart spillPart(PointStream& points, double factor,
  const PiecePlan& plan, const std::string& file, int part, const PassOptions& options);

/// Sets InitialPoint::InPieces of the plan's initial points, once all parts of the stream are
/// spilled. Throws IOError if the input has changed since the survey.
VTKTIPPFILTERS_EXPORT void placeInitialPoints(
  const std::vector<SpilledPart>& parts, const InputSurvey& survey, PiecePlan& plan);

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

/// The passes over the input before its points are triangulated; used on the first rank. If the
/// input can be divided, each rank reads a part. The first rank also reads the parts of ranks that
/// do not have the same input. The results do not depend on the number of parts. Methods throw
/// IOError.
class VTKTIPPFILTERS_EXPORT InputPasses
{
public:
  /// `ranks`: null for this process alone. Both must outlive this object.
  InputPasses(PointStream& points, Communicator* ranks, const PassOptions& options);

  /// Reads all points, and returns what is known of them.
  InputSurvey survey();
  /// Spills all points, and sets the indices of the plan's initial points. `file`: the path of the
  /// spilled points; each part appends its number.
  std::unique_ptr<SpilledPoints> spill(
    const InputSurvey& survey, PiecePlan& plan, const std::string& file);

private:
  template <typename Result, typename SaveOrder, typename Work>
  std::vector<Result> share(MessageKind kind, const SaveOrder& saveOrder, const Work& work);
  Bytes answerOf(int rank);
  void poll();

  PointStream& Points;
  Communicator* const Ranks;
  const PassOptions Options;
  const std::int64_t Total; ///< number of points; -1: unknown
  const int Parts;
  std::deque<Message> Arrived;
};

/// Called on a rank other than the first: answers the first rank's requests to read this rank's
/// part of the input. next() waits for the next message. Returns the first message that is not such
/// a request. Of `options`, Threads and Progress are used; the first rank sends the others.
/// Progress throws to stop the run.
Message helpWithInput(Communicator& ranks, const OpenPoints& open, PassOptions options,
  const std::function<Message()>& next);

} // namespace tipp

#endif
