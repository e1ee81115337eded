// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointArrangement_h
#define tippPointArrangement_h

#include "Messages/Bytes.h"
#include "Messages/Postbox.h"
#include "Predicates/Point2.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// What travels with points, array by array.
struct PointArrays
{
  Point2* Places;
  PointId* Ids;
  char* Rows;

  PointArrays(Point2* places, PointId* ids, char* rows)
    : Places(places)
    , Ids(ids)
    , Rows(rows)
  {
  }
  /// Those of so many points that lie there one after the other.
  PointArrays(char* memory, std::size_t points);

  /// Of a message of so many points.
  static std::size_t bytes(std::size_t points, std::size_t rowSize);
};

/// Where a rank's points come to lie: leaf by leaf, and in each leaf the points of the ranks in
/// their order.
struct PointArrangement
{
  /// Each rank tells its number of points in each leaf to the leaf's owner. Collective.
  PointArrangement(Postbox& ranks, const std::vector<std::int32_t>& owners,
    const std::vector<std::int64_t>& counts);

  std::int32_t Rank;
  std::vector<std::vector<std::uint64_t>> Counts; ///< from each rank, for each leaf of this one
  std::vector<std::vector<std::size_t>> Firsts;   ///< the place of the first of these
  std::vector<std::size_t> Starts;                ///< of all leaves, and the end
};

/// Brings what comes from another rank, part by part, to its places.
class PointLanding
{
public:
  PointLanding(const PointArrangement& arrangement, std::size_t source, const PointArrays& home,
    std::size_t rowSize);

  /// Throws std::runtime_error if it is more than the rank told.
  void take(const char* part, std::size_t size);

  /// Throws std::runtime_error if it was less.
  void requireComplete() const;

private:
  struct Place
  {
    char* To;
    std::size_t Size;
  };

  std::vector<Place> Left; ///< the next one last
};

} // namespace tipp

#endif
