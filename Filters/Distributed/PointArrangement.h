// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointArrangement_h
#define tippPointArrangement_h

#include "Messages/Bytes.h"
#include "Messages/Communicator.h"
#include "Predicates/Point2.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// The arrays of points and their data, as sent in messages. Does not own the memory.
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
  /// The arrays of `points` points that are stored one after the other in `memory`.
  PointArrays(char* memory, std::size_t points);

  /// The size of a message with `points` points, in bytes.
  static std::size_t bytes(std::size_t points, std::size_t rowSize);
};

/// The order of a rank's points: by leaf, and within each leaf by source rank.
struct PointArrangement
{
  /// Sends the number of points in each leaf to the leaf's owner. Collective.
  PointArrangement(Communicator& ranks, const std::vector<std::int32_t>& owners,
    const std::vector<std::int64_t>& counts);

  std::int32_t Rank;
  std::vector<std::vector<std::uint64_t>> Counts; ///< by source rank and leaf of this rank
  std::vector<std::vector<std::size_t>> Firsts;   ///< index of the first of these points
  std::vector<std::size_t> Starts;                ///< index of each leaf's first point, and the end
};

/// Copies what is received from another rank, part by part, to its position.
class PointLanding
{
public:
  PointLanding(const PointArrangement& arrangement, std::size_t source, const PointArrays& home,
    std::size_t rowSize);

  /// Copies the next part. Throws std::runtime_error if the rank sent more than it announced.
  void take(const char* part, std::size_t size);

  /// Throws std::runtime_error if the rank sent less than it announced.
  void requireComplete() const;

private:
  /// A byte range of the destination that is not filled yet.
  struct Place
  {
    char* To;
    std::size_t Size;
  };

  std::vector<Place> Left; ///< in reverse order
};

} // namespace tipp

#endif
