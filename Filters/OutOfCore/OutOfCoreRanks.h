// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreRanks_h
#define tippOutOfCoreRanks_h

#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Points/PointStream.h"
#include "Ranks/Communicator.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace tipp
{

constexpr MessageKind pieceMessage(std::uint32_t n)
{
  return static_cast<MessageKind>(static_cast<std::uint32_t>(MessageKind::FirstFree) + n);
}

/// @name From the first rank
///@{
constexpr MessageKind SurveyMessage = pieceMessage(0); ///< these three for an InputHelper
constexpr MessageKind FactorMessage = pieceMessage(1);
constexpr MessageKind SpillMessage = pieceMessage(2);
constexpr MessageKind SetUpMessage = pieceMessage(3); ///< what was prepared
constexpr MessageKind EndMessage = pieceMessage(4);   ///< there is no more work
///@}
/// To the first rank: of the input.
constexpr MessageKind PartMessage = pieceMessage(5);
/// @name Between any ranks
///@{
constexpr MessageKind PartitionMessage = pieceMessage(6); ///< it is done; what it sends
constexpr MessageKind PieceMessage = pieceMessage(7);     ///< its result is on disk
///@}

class RunSetup;

using OpenPoints = std::function<std::unique_ptr<PointStream>()>;

/// triangulateOutOfCore() on all ranks, each of which calls this with the same path and options:
/// points are surveyed and spilled, pieces loaded and triangulated and their interiors written by
/// all; the first one makes the plan and completes the pieces at the end. The files are those of
/// one process. `open` is called on all ranks; where it throws an IOError or opens another input
/// than on the first rank, that one reads this rank's part. The figures are on the first rank.
///
/// All ranks must see the folders. The memory limit and the threads are those of each rank. Throws
/// RankFailure on all ranks; the statistics of a run that was ended by Progress on any rank have
/// Aborted on all. Not to be called within Communicator::together().
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics triangulateOutOfCoreOnRanks(Communicator& ranks,
  const OpenPoints& open, const std::string& path, const OutOfCoreOptions& options);

/// Whether all ranks see a folder of the first rank, by a file that is there for a moment;
/// collective. Throws IOError on a rank that does not.
VTKTIPPFILTERS_EXPORT void requireSharedFolder(Communicator& ranks, const std::string& folder);

/// Of the first rank: sends the others, which wait for it in triangulateOutOfCoreOnRanks(), what
/// they need to work on pieces. `points`: the file they are spilled to; `isDone`: of each piece,
/// whether it is done already.
VTKTIPPFILTERS_EXPORT void shareSetup(Communicator& ranks, RunSetup& prepared,
  const std::string& points, const std::vector<char>& isDone);

} // namespace tipp

#endif
