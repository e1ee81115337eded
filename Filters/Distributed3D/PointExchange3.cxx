// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/PointExchange.h"
#include "Distributed3D/DistributedTetrahedralization.h"

#include <numeric>
#include <vector>

namespace tipp
{
namespace
{

/// Points times a factor.
struct PointsView3
{
  const Point3* Points;
  std::size_t Count;
  double Factor;

  std::size_t size() const { return this->Count; }

  template <typename Visit>
  void forEach(std::size_t begin, std::size_t end, const Visit& visit) const
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      const Point3& p = this->Points[i];
      visit(i, Point3{ p.x * this->Factor, p.y * this->Factor, p.z * this->Factor });
    }
  }
};

} // namespace

PointTuples3 exchangePoints(
  Communicator& ranks, const RankPoints3& points, const Tiling3& tiling, double factor, int threads)
{
  const PointsView3 view{ points.Points, points.Count, factor };
  // A leaf is a group of partitions, and belongs to the rank with its index.
  std::vector<std::int32_t> owners(std::size_t(ranks.size()));
  std::iota(owners.begin(), owners.end(), 0);
  const PointSender<Point3, PointsView3> sender(points, view, owners.size(), threads,
    [&](std::size_t begin, std::size_t end, std::uint32_t* labels, std::vector<std::size_t>& counts)
    {
      view.forEach(begin, end,
        [&](std::size_t i, const Point3& p)
        {
          labels[i] = PartitionFinder::None;
          if (isFinite(p))
          {
            labels[i] = std::uint32_t(tiling.groupOf(tiling.locate(p)));
            ++counts[labels[i]];
          }
        });
    });
  const PointLayout layout(ranks, owners, sender.counts());
  const auto packing = sender.plan(owners, layout);
  PointTuples3 owned = sender.makeRoom(layout);
  sender.send(ranks, owners, layout, packing, Bytes(packing.Size), owned);
  return owned;
}

} // namespace tipp
