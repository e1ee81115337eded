// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBorderTriangles_h
#define tippBorderTriangles_h

#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// The result of a piece that is done.
using ResultOf = std::function<const StoredResult&(PartitionIndex)>;

/// The interior of a piece that is done. Throws IOError.
PieceInterior readInterior(const PieceWork& work, PartitionIndex piece, const StoredResult& result);

/// Visits the rows of points at borders, which are interface points of their own pieces. `points`:
/// ascending. Throws IOError.
void visitBorderRows(const PieceWork& work, const std::vector<std::int64_t>& points,
  const ResultOf& results, const std::function<void(std::int64_t, const double*)>& visit);

/// Sets the rows of the points of other pieces that a border's triangles use. Throws IOError.
void setGhosts(const PieceWork& work, const ResultOf& results, PieceBorder& border);

/// Gives the triangles between pieces that the last partitions of `piece` have completed to the
/// taker. All pieces that conflict with it must be done: their points are corners. Throws IOError.
void takeBorder(const PieceWork& work, PartitionIndex piece, const ResultOf& results);

/// Gives it triangles of any pieces; `name`: of this part.
void takeTriangles(const PieceWork& work, const std::string& name, const BordersByOwner& triangles,
  const ResultOf& results);

/// Whether takeBorder() has been completed, in this process or another one.
bool isBorderTaken(const PieceWork& work, PartitionIndex piece);

/// Tells which borders can be taken while pieces get done, in any order.
class BorderQueue
{
public:
  /// Of all partitions, of which conflicting ones are neighbours.
  BorderQueue(const PiecePlan& plan, const PartitionOrder& order);

  /// Call once for each piece that gets done. Returns the pieces whose borders can be taken now.
  std::vector<PartitionIndex> setDone(PartitionIndex piece);

private:
  std::vector<std::vector<PartitionIndex>> Neighbours; ///< of each piece, with itself
  std::vector<std::size_t> Open;                       ///< of these, those that are not done
};

} // namespace tipp

#endif
