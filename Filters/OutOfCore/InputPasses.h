// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputPasses_h
#define tippInputPasses_h

#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PiecePlan3.h"
#include "OutOfCore/SpilledPoints.h"
#include "Points/ReadPoints.h"
#include "Ranks/Communicator.h"
#include "Ranks/Spill.h"
#include "Triangulation/InputSurvey.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

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
/// random but always the same. `total`: the number of points of all parts; -1 if this part is the
/// only one, because counting the points of a LAZ file takes a pass. Throws IOError.
template <int D>
VTKTIPPFILTERS_EXPORT InputSurveyOf<D> surveyPart(
  PointStream& points, std::int64_t total, const PassOptions& options);

/// Throws the IOError for an input that is not the same in all passes.
[[noreturn]] void throwChanged();

/// Describes the spilled rows of a part of the stream.
struct SpilledPart
{
  std::int64_t Points = 0;
  SpilledRows Rows; ///< as Spill::close() returned them
  /// By initial point of this part: its index among the part's points of the same piece.
  std::vector<std::int64_t> InPieces;
  std::vector<ExtremePoints> Extremes; ///< in space: of this part's points, by piece
};

/// Spills the part of the stream to which `points` is limited, as part number `part` of `file`. A
/// point's piece is found with its coordinates times `factor`; rows have the original coordinates.
/// Throws IOError.
template <typename Plan>
VTKTIPPFILTERS_EXPORT SpilledPart spillPart(PointStream& points, double factor, const Plan& plan,
  const std::string& file, int part, const PassOptions& options);

/// Sets InitialPointOf::InPieces of the plan's initial points and, in space, the plan's regions,
/// once all parts of the stream are spilled. Throws IOError if the input has changed since the
/// survey.
template <typename Plan>
VTKTIPPFILTERS_EXPORT void placeInitialPoints(
  const std::vector<SpilledPart>& parts, const InputSurveyOf<Plan::Dimensions>& survey, Plan& plan);

/// The passes over the input before its points are triangulated; used on the first rank. If the
/// input can be divided, each rank reads a part. The first rank also reads the parts of ranks that
/// do not have the same input. The results do not depend on the number of parts. Methods throw
/// IOError.
template <typename Plan>
class VTKTIPPFILTERS_EXPORT InputPassesOf
{
public:
  using Survey = InputSurveyOf<Plan::Dimensions>;

  /// `ranks`: null for this process alone. Both must outlive this object.
  InputPassesOf(PointStream& points, Communicator* ranks, const PassOptions& options);

  /// Reads all points, and returns what is known of them.
  Survey survey();
  /// Spills all points, and sets the indices of the plan's initial points. `file`: the path of the
  /// spilled points; each part appends its number.
  std::unique_ptr<SpilledPoints> spill(const Survey& survey, Plan& plan, const std::string& file);

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

using InputPasses = InputPassesOf<PiecePlan>;

/// Called on a rank other than the first: answers the first rank's requests to read this rank's
/// part of the input. next() waits for the next message. Returns the first message that is not such
/// a request. Of `options`, Threads and Progress are used; the first rank sends the others.
/// Progress throws to stop the run.
template <typename Plan>
Message helpWithInput(Communicator& ranks, const OpenPoints& open, PassOptions options,
  const std::function<Message()>& next);

} // namespace tipp

#endif
