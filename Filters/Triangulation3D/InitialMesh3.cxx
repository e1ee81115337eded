// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/InitialMesh3.h"

#include "Arrays/SortUnique.h"
#include "Kernel3D/DelaunayKernel3.h"
#include "Predicates/Circumball.h"

#include <algorithm>
#include <cmath>

namespace tipp
{

std::vector<std::size_t> chooseInitialPoints(
  const Point3* points, std::size_t count, std::size_t wanted)
{
  std::vector<std::size_t> chosen;
  const auto add = [&](const auto& isBefore)
  { chosen.push_back(std::size_t(std::min_element(points, points + count, isBefore) - points)); };
  for (double Point3::*axis : { &Point3::x, &Point3::y, &Point3::z })
  {
    add([axis](const Point3& a, const Point3& b) { return a.*axis < b.*axis; });
    add([axis](const Point3& a, const Point3& b) { return a.*axis > b.*axis; });
  }
  for (std::size_t i = 0; i < wanted; ++i)
  {
    chosen.push_back((2 * i + 1) * count / (2 * wanted));
  }
  sortUnique(chosen);
  return chosen;
}

std::vector<Vertex3> makeArtificialPoints(const PointBuckets3& buckets, bool areSlabs)
{
  const std::vector<char> areUsed = buckets.areUsed();
  PointBounds domain;
  double margin = 0;
  std::size_t used = 0;
  for (std::size_t p = 0; p < buckets.Regions.size(); ++p)
  {
    if (areUsed[p])
    {
      const Box3& box = buckets.Regions[p];
      domain.include({ box.Min[0], box.Min[1], box.Min[2] });
      domain.include({ box.Max[0], box.Max[1], box.Max[2] });
      const std::initializer_list<double> sides = { box.Max[0] - box.Min[0],
        box.Max[1] - box.Min[1], box.Max[2] - box.Min[2] };
      margin += areSlabs ? std::min(sides) / 2 : std::max(sides);
      ++used;
    }
  }
  margin /= double(std::max<std::size_t>(used, 1));
  std::array<std::vector<double>, 3> ticks;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double low = outward(domain.Box.Min[k], -1, margin);
    const double high = outward(domain.Box.Max[k], 1, margin);
    constexpr double most = 16;
    if (!std::isfinite(high - low))
    {
      return {};
    }
    const auto pieces = int(std::clamp(std::ceil((high - low) / margin), 1.0, most));
    for (int i = 0; i < pieces; ++i)
    {
      ticks[k].push_back(low + (high - low) * (double(i) / pieces));
    }
    ticks[k].push_back(high);
  }
  std::vector<Vertex3> vertices;
  for (const double x : ticks[0])
  {
    for (const double y : ticks[1])
    {
      for (const double z : ticks[2])
      {
        const auto isEnd = [](double at, const std::vector<double>& all)
        { return at == all.front() || at == all.back(); };
        if (isEnd(x, ticks[0]) || isEnd(y, ticks[1]) || isEnd(z, ticks[2]))
        {
          vertices.push_back({ { x, y, z }, -1 - std::int64_t(vertices.size()), -1 });
        }
      }
    }
  }
  return vertices;
}

InitialMesh3::InitialMesh3(
  const PointBuckets3& buckets, const std::vector<Vertex3>& artificial, std::size_t wanted)
{
  const std::vector<char> areUsed = buckets.areUsed();
  const std::size_t partitions = areUsed.size();
  for (std::size_t p = 0; p < partitions; ++p)
  {
    const PartitionPoints3 own = buckets.of(PartitionIndex(p));
    for (const std::size_t i :
      areUsed[p] ? chooseInitialPoints(own.Points, own.Count, wanted) : std::vector<std::size_t>())
    {
      this->Vertices.push_back({ own.Points[i], own.id(i), own.Partition });
    }
  }
  this->Vertices.insert(this->Vertices.end(), artificial.begin(), artificial.end());
  const std::vector<Point3> points = positionsOf(this->Vertices);
  DelaunayKernel3 kernel;
  kernel.triangulate(points.data(), points.size());
  std::vector<PartitionIndex> met;
  kernel.forEach(
    [&](DelaunayKernel3::Index t)
    {
      if (kernel.isInfinite(t))
      {
        return;
      }
      const auto [a, b, c, d] = kernel.corners(t);
      this->Cells.push_back(
        { kernel.pointIndex(a), kernel.pointIndex(b), kernel.pointIndex(c), kernel.pointIndex(d) });
      const Circumball ball(kernel.point(a), kernel.point(b), kernel.point(c), kernel.point(d));
      met.clear();
      for (std::size_t p = 0; p < partitions; ++p)
      {
        if (areUsed[p] && ball.meets(buckets.Regions[p]))
        {
          met.push_back(PartitionIndex(p));
        }
      }
      this->SetOf.push_back(this->Sets.number(met.data(), met.data() + met.size()));
    });
  this->AdjacentSets = adjacentSets<4>(kernel, this->SetOf);
}

} // namespace tipp
