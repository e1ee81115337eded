// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointExchange_h
#define tippPointExchange_h

#include "Distributed/CellExchange.h"
#include "Distributed/Plan.h"
#include "Predicates/Points.h"
#include "Ranks/Archive.h"
#include "Ranks/Communicator.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// The arrays of points and their data, as sent in messages. Does not own the memory.
struct PointArrays
{
  Point2* Positions;
  PointId* Ids;
  char* Rows;

  PointArrays(Point2* positions, PointId* ids, char* rows)
    : Positions(positions)
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
struct PointLayout
{
  /// Sends the number of points in each leaf to the leaf's owner. Collective.
  PointLayout(Communicator& ranks, const std::vector<std::int32_t>& owners,
    const std::vector<std::int64_t>& counts);

  std::int32_t Rank;
  std::vector<std::vector<std::uint64_t>>
    Counts; ///< number of points, by source rank and leaf of this rank
  std::vector<std::vector<std::size_t>> Firsts; ///< index of the first of these points
  std::vector<std::size_t> Starts;              ///< index of each leaf's first point, and the end
};

/// Copies what is received from another rank, part by part, to its position.
class PointReceiver
{
public:
  PointReceiver(const PointLayout& layout, std::size_t source, const PointArrays& destination,
    std::size_t rowSize);

  /// Copies the next part. Throws std::runtime_error if the rank sent more than it announced.
  void take(const char* part, std::size_t size);

  /// Throws std::runtime_error if the rank sent less than it announced.
  void requireComplete() const;

private:
  /// A byte range of the destination that is not filled yet.
  struct Range
  {
    char* To;
    std::size_t Size;
  };

  std::vector<Range> Left; ///< ranges still to fill, in reverse order
};

/// A rank's input points. Does not own the memory.
struct RankPoints : RankPointData
{
  PointsView Points; ///< coordinates of this rank's points
};

/// The points of the leaves that a rank owns, ordered by leaf.
template <typename Id>
struct OwnedPoints
{
  PointBuckets<Id> Buckets; ///< one bucket per leaf; empty for leaves of other owners
  Buffer<Point2> Positions;
  Buffer<PointId> GlobalIds;
  Buffer<char> Rows;                  ///< data of the points, RowSize bytes each
  std::vector<std::int64_t> FirstIds; ///< first internal id of each rank, and the end

  std::size_t size() const { return this->Positions.size(); }
};

/// Sends points to their owners in one all-to-all exchange.
class PointExchange
{
public:
  /// Finds each point's leaf. `points` must outlive this object.
  PointExchange(const RankPoints& points, const Tiling& leaves, int threads);

  /// The number of this rank's points in each leaf.
  std::vector<std::int64_t> counts() const;

  /// Sends each point to its leaf's owner and returns the points received. `owners` has the rank of
  /// each leaf. Collective.
  template <typename Id>
  OwnedPoints<Id> exchange(Communicator& ranks, const std::vector<std::int32_t>& owners) const;

private:
  /// The layout of the outgoing messages.
  struct Packing
  {
    std::vector<std::size_t> Sizes;  ///< number of points to each rank
    std::vector<std::size_t> Begins; ///< index of each leaf's first point in its owner's message
    std::vector<Communicator::ByteRange> Messages;
    std::size_t Size = 0; ///< bytes of all messages
  };

  Packing planPacking(const std::vector<std::int32_t>& owners, const PointLayout& layout) const;
  void pack(const std::vector<std::int32_t>& owners, const Packing& packing,
    const PointArrays& destination, char* messages) const;
  void scatter(const std::vector<PointArrays>& to, const std::vector<std::size_t>& begins) const;

  const RankPoints& Input;
  const std::size_t Leaves;
  const int Threads;
  Buffer<std::uint32_t> Labels;
  std::vector<std::vector<std::size_t>> Counts; ///< number of points, by thread and leaf
};

extern template OwnedPoints<std::int32_t> PointExchange::exchange(
  Communicator&, const std::vector<std::int32_t>&) const;
extern template OwnedPoints<std::int64_t> PointExchange::exchange(
  Communicator&, const std::vector<std::int32_t>&) const;

} // namespace tipp

#endif
