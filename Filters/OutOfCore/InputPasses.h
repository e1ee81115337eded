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
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

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
  void setStarts();

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
  double commonFactor(const InputSurvey& survey);
  template <typename Result, typename Work>
  std::vector<Result> share(MessageKind kind, SaveArchive order, const Work& work);
  Bytes answerOf(int rank);
  void poll();

  PointStream& Points;
  Communicator* const Ranks;
  const PassOptions Options;
  const std::int64_t Total; ///< number of points; -1: unknown
  const int Parts;
  std::deque<Message> Arrived;
};

/// Reads the parts of the input that belong to a rank other than the first.
class VTKTIPPFILTERS_EXPORT InputHelper
{
public:
  /// Of `options`, Threads and Progress are used; the first rank sends the others. Progress throws
  /// to stop the run.
  InputHelper(Communicator& ranks, OpenPoints open, PassOptions options);

  /// Handles a request of the first rank. Returns false if the message is not one.
  bool take(const Message& message);

private:
  void open(LoadArchive& order);
  Bytes spill(LoadArchive& order);

  Communicator& Ranks;
  const OpenPoints Open;
  PassOptions Options;
  std::unique_ptr<PointStream> Points; ///< limited to this rank's part; null if the input differs
};

} // namespace tipp

#endif
