// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedTesting_h
#define tippDistributedTesting_h

#include "DelaunayOracle.h"

#include "Constraints/ConstraintSegments.h"
#include "Distributed/DistributedTriangulation.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// How the points of a set are shared out to the ranks.
enum class Share
{
  Blocks,     ///< consecutive ones
  RoundRobin, ///< one to each in turn
  AllOnLast,  ///< the other ranks have none
  Uneven,     ///< the first rank none, the others more and more
  Copies      ///< every rank has them all, with the same global ids
};

std::string nameOf(Share share);

/// One rank's points: their places and global ids.
struct RankShare
{
  Coordinates XY;
  std::vector<PointId> GlobalIds;
};
RankShare shareOf(const Coordinates& xy, Share share, int rank, int ranks);

/// All ranks' triangles and points, on rank 0.
struct Gathered
{
  Triangles Mesh;                    ///< by global ids, sorted
  std::vector<Duplicate> Duplicates; ///< by ascending point
  std::vector<PointId> Rejected;     ///< ascending
  std::vector<std::string> Faults;   ///< of single ranks, e.g. a point at the wrong place
};

/// Triangulates over all ranks of the global controller and brings everything together. `xy` has
/// the place of every global id. Constraints: inserted if they are not null.
Gathered triangulateShares(const Coordinates& xy, Share share, const DistributedOptions& options,
  const ConstraintSegments* constraints = nullptr);

/// Is it the reference: the same triangles, and every point accounted for?
testing::AssertionResult matches(
  const Coordinates& xy, const Gathered& result, const Reference& expected);

/// The last reference made is kept: the tests of one input come one after the other.
const Reference& cachedReference(const std::string& key, const Coordinates& xy);

int rank();
int ranks();

} // namespace test
} // namespace tipp

#endif
