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

/// How the points of a set are distributed over the ranks.
enum class Share
{
  Blocks,     ///< consecutive points per rank
  RoundRobin, ///< one point to each rank in turn
  AllOnLast,  ///< the other ranks have none
  Uneven,     ///< no points on the first rank, and more and more on the others
  Copies      ///< all points on every rank, with the same global ids
};

std::string nameOf(Share share);

/// One rank's points: coordinates and global ids.
struct RankShare
{
  Coordinates XY;
  std::vector<PointId> GlobalIds;
};
RankShare shareOf(const Coordinates& xy, Share share, int rank, int ranks);

/// The triangles and points of all ranks, gathered on rank 0.
struct Gathered
{
  Triangles Mesh;                    ///< global ids, sorted
  std::vector<Duplicate> Duplicates; ///< sorted by point
  std::vector<PointId> Rejected;     ///< in ascending order
  std::vector<std::string> Faults;   ///< errors that ranks found, e.g. a point at a wrong position
};

/// Triangulates on all ranks of the global controller, and gathers the result on rank 0. `xy` has
/// the coordinates of each global id. Inserts the constraints, unless they are null.
Gathered triangulateShares(const Coordinates& xy, Share share, const DistributedOptions& options,
  const ConstraintSegments* constraints = nullptr);

/// Whether the result has the reference's triangles, and every point is a vertex, a duplicate or
/// rejected.
testing::AssertionResult matches(
  const Coordinates& xy, const Gathered& result, const Reference& expected);

/// The reference of `xy`. Keeps the last one, since the tests of one input follow each other.
const Reference& cachedReference(const std::string& key, const Coordinates& xy);

int rank();
int ranks();

} // namespace test
} // namespace tipp

#endif
