// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputPasses_h
#define tippInputPasses_h

#include "OutOfCore/InputSurvey.h"
#include "OutOfCore/PieceMessages.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/SpillPoints.h"
#include "Ranks/Communicator.h"

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
  SaveArchive survey();
  SaveArchive factor(LoadArchive& order);
  SaveArchive spill(LoadArchive& order);

  Communicator& Ranks;
  const std::function<std::unique_ptr<PointStream>()> Open;
  PassOptions Options;
  std::unique_ptr<PointStream> Points; ///< limited to this rank's part; null if it is another input
};

} // namespace tipp

#endif
