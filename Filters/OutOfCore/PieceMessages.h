// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceMessages_h
#define tippPieceMessages_h

#include "Ranks/Communicator.h"

#include <cstdint>

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

} // namespace tipp

#endif
