// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceMessages_h
#define tippPieceMessages_h

#include "Messages/Postbox.h"
#include "OutOfCore/LoadedPieces.h"

#include <cstdint>
#include <vector>

namespace tipp
{

constexpr MessageKind pieceMessage(std::uint32_t n)
{
  return static_cast<MessageKind>(static_cast<std::uint32_t>(MessageKind::FirstFree) + n);
}

/// @name From the first rank
///@{
constexpr MessageKind SetUpMessage = pieceMessage(0);
constexpr MessageKind LoadMessage = pieceMessage(1);        ///< a LoadOrder
constexpr MessageKind TriangulateMessage = pieceMessage(2); ///< a PartitionTask
constexpr MessageKind WriteMessage = pieceMessage(3);       ///< an InteriorTask
constexpr MessageKind EndMessage = pieceMessage(4);         ///< there is no more work
constexpr MessageKind SurveyMessage = pieceMessage(9);      ///< these three for an InputHelper
constexpr MessageKind FactorMessage = pieceMessage(10);
constexpr MessageKind SpillMessage = pieceMessage(11);
///@}
/// @name To the first rank
///@{
constexpr MessageKind ReadyMessage = pieceMessage(5);     ///< its number of threads
constexpr MessageKind LoadedMessage = pieceMessage(6);    ///< the piece
constexpr MessageKind PartitionMessage = pieceMessage(7); ///< a PartitionResult
constexpr MessageKind WrittenMessage = pieceMessage(8);   ///< a WrittenInterior
constexpr MessageKind PartMessage = pieceMessage(12);     ///< of the input
///@}

struct LoadOrder
{
  PartitionIndex Piece = 0;
  std::vector<PartitionIndex> Finished; ///< of its partitions, by a run before this one
};

struct PartitionTask
{
  PartitionIndex Partition = 0;
  std::vector<PlainVertex> Vertices;
};

struct WrittenInterior
{
  PartitionIndex Piece = 0;
  GrowingPiece Growing;
};

VTKTIPPFILTERS_EXPORT Bytes pack(const LoadOrder& order);
VTKTIPPFILTERS_EXPORT Bytes pack(const PartitionTask& task);
VTKTIPPFILTERS_EXPORT Bytes pack(const InteriorTask& task);
VTKTIPPFILTERS_EXPORT Bytes pack(const PartitionResult& result);
VTKTIPPFILTERS_EXPORT Bytes pack(WrittenInterior& written);
VTKTIPPFILTERS_EXPORT Bytes pack(std::int32_t number);

/// These throw std::runtime_error for what pack() has not made.
VTKTIPPFILTERS_EXPORT void unpack(const Bytes& bytes, LoadOrder& order);
VTKTIPPFILTERS_EXPORT void unpack(const Bytes& bytes, PartitionTask& task);
VTKTIPPFILTERS_EXPORT void unpack(const Bytes& bytes, InteriorTask& task);
VTKTIPPFILTERS_EXPORT void unpack(const Bytes& bytes, PartitionResult& result);
VTKTIPPFILTERS_EXPORT void unpack(const Bytes& bytes, WrittenInterior& written);
VTKTIPPFILTERS_EXPORT void unpack(const Bytes& bytes, std::int32_t& number);

} // namespace tipp

#endif
