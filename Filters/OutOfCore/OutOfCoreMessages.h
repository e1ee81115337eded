// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreMessages_h
#define tippOutOfCoreMessages_h

#include "Ranks/Communicator.h"

namespace tipp
{

/// @name From the first rank; the kinds before these are those of RankEngine
///@{
/// Handled by helpWithInput(), like the next two.
constexpr MessageKind SurveyMessage = kindAfter(2);
constexpr MessageKind FactorMessage = kindAfter(3);
constexpr MessageKind SpillMessage = kindAfter(4);
constexpr MessageKind SetUpMessage = kindAfter(5); ///< RunSetup, and which pieces are done
constexpr MessageKind EndMessage = kindAfter(6);   ///< there is no more work
///@}
/// An answer of helpWithInput() to the first rank.
constexpr MessageKind PartMessage = kindAfter(7);
/// Between any ranks: the piece is done, and its result is on disk.
constexpr MessageKind PieceMessage = kindAfter(8);

} // namespace tipp

#endif
