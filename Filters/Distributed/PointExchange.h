// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointExchange_h
#define tippPointExchange_h

#include "Distributed/Plan.h"
#include "Distributed/PointArrangement.h"
#include "Messages/Postbox.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Triangulate.h"

#include <functional>
#include <vector>

namespace tipp
{

/// The points that a rank brings along.
struct RankPoints
{
  PointsView Points;
  const PointId* GlobalIds = nullptr; ///< null: FirstId and upwards
  PointId FirstId = 0;
  /// What travels with each point, so many bytes: pack(point, to) writes them.
  std::size_t RowSize = 0;
  std::function<void(std::size_t, char*)> PackRow;

  PointId globalId(std::size_t i) const
  {
    return this->GlobalIds ? this->GlobalIds[i] : this->FirstId + PointId(i);
  }
};

/// The points of the leaves that a rank owns, leaf by leaf.
template <typename Id>
struct OwnedPoints
{
  PointBuckets<Id> Buckets; ///< of all leaves; empty those of other owners
  Buffer<Point2> Places;
  Buffer<PointId> GlobalIds;
  Buffer<char> Rows;
  std::vector<std::int64_t> FirstIds; ///< of each rank, counting all ranks' points; and the end

  std::size_t size() const { return this->Places.size(); }
};

/// The points' way to their owners, in one all-to-all.
class PointExchange
{
public:
  /// Finds each point's leaf.
  PointExchange(const RankPoints& points, const Tiling& leaves, int threads);

  /// This rank's points in each leaf.
  std::vector<std::int64_t> counts() const;

  /// Collective. `owners` has a rank for each leaf.
  template <typename Id>
  OwnedPoints<Id> exchange(Postbox& ranks, const std::vector<std::int32_t>& owners) const;

private:
  /// Where in the messages, and how much.
  struct Packing
  {
    std::vector<std::size_t> Sizes;  ///< points to each rank
    std::vector<std::size_t> Begins; ///< of each leaf, among its owner's points from here
    std::vector<Postbox::Stretch> Messages;
    std::size_t Size = 0; ///< of all messages, in bytes
  };

  Packing planPacking(
    const std::vector<std::int32_t>& owners, const PointArrangement& arrangement) const;
  void pack(const std::vector<std::int32_t>& owners, const Packing& packing,
    const PointArrays& home, char* messages) const;
  void scatter(const std::vector<PointArrays>& to, const std::vector<std::size_t>& begins) const;

  const RankPoints& Input;
  const std::size_t Leaves;
  const int Threads;
  Buffer<std::uint32_t> Labels;
  std::vector<std::vector<std::size_t>> Counts; ///< of each thread's part
};

extern template OwnedPoints<std::int32_t> PointExchange::exchange(
  Postbox&, const std::vector<std::int32_t>&) const;
extern template OwnedPoints<std::int64_t> PointExchange::exchange(
  Postbox&, const std::vector<std::int32_t>&) const;

} // namespace tipp

#endif
