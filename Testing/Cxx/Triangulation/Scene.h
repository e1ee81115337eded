// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScene_h
#define tippScene_h

#include "ExactDisk.h"

#include <algorithm>
#include <cmath>

namespace tipp
{
namespace test
{

/// The input of the lemmas: partitions with their points, the initial points, and artificial points
/// around all of them.
struct Scene
{
  Coordinates XY; ///< the artificial points are first
  std::int64_t Artificial = 0;
  std::vector<Box2> Partitions;
  std::vector<Ids> Points; ///< per partition, without the initial points
  Ids Initial;             ///< the initial points, without the artificial ones

  Ids artificial() const
  {
    Ids ids;
    for (std::int64_t i = 0; i < this->Artificial; ++i)
    {
      ids.push_back(i);
    }
    return ids;
  }
  Ids initialMesh() const
  {
    Ids ids = this->artificial();
    ids.insert(ids.end(), this->Initial.begin(), this->Initial.end());
    return ids;
  }
};

inline Ids together(Ids a, const Ids& b)
{
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  a.erase(std::unique(a.begin(), a.end()), a.end());
  return a;
}

inline Ids verticesOf(const Triangles& triangles)
{
  Ids ids;
  for (const Triangle& t : triangles)
  {
    ids.insert(ids.end(), t.begin(), t.end());
  }
  return together(ids, {});
}

/// `side` x `side` partitions over a point set, every `every`-th point of which is initial. The
/// artificial points are `margin` times the domain's width away from it.
inline Scene makeScene(const std::string& set, std::size_t count, int side, std::size_t every,
  double margin, std::uint64_t seed)
{
  const Coordinates points = makePointSet(set, count, seed);
  Box2 domain{ points[0], points[1], points[0], points[1] };
  for (std::size_t i = 0; i < points.size(); i += 2)
  {
    domain.Min.x = std::min(domain.Min.x, points[i]);
    domain.Max.x = std::max(domain.Max.x, points[i]);
    domain.Min.y = std::min(domain.Min.y, points[i + 1]);
    domain.Max.y = std::max(domain.Max.y, points[i + 1]);
  }
  const double w = domain.Max.x - domain.Min.x;
  const double h = domain.Max.y - domain.Min.y;
  Scene scene;
  for (int i = 0; i <= side; ++i)
  {
    const double x = domain.Min.x - margin * w + i * (1 + 2 * margin) * w / side;
    const double y = domain.Min.y - margin * h + i * (1 + 2 * margin) * h / side;
    const double low = domain.Min.y - margin * h;
    const double left = domain.Min.x - margin * w;
    scene.XY.insert(scene.XY.end(), { x, low, x, low + (1 + 2 * margin) * h });
    if (i > 0 && i < side)
    {
      scene.XY.insert(scene.XY.end(), { left, y, left + (1 + 2 * margin) * w, y });
    }
  }
  scene.Artificial = std::int64_t(scene.XY.size() / 2);
  scene.XY.insert(scene.XY.end(), points.begin(), points.end());
  // The last cut is exactly the domain's end, which a sum would miss by rounding.
  const auto cut = [&](double low, double high, int at)
  { return at == side ? high : low + at * (high - low) / side; };
  for (int i = 0; i < side * side; ++i)
  {
    const int column = i % side;
    const int row = i / side;
    scene.Partitions.push_back(
      { cut(domain.Min.x, domain.Max.x, column), cut(domain.Min.y, domain.Max.y, row),
        cut(domain.Min.x, domain.Max.x, column + 1), cut(domain.Min.y, domain.Max.y, row + 1) });
  }
  scene.Points.resize(scene.Partitions.size());
  for (std::size_t i = 0; i < points.size() / 2; ++i)
  {
    const auto id = scene.Artificial + std::int64_t(i);
    // A point on a common border belongs to the first of the partitions there.
    const auto owner = std::find_if(scene.Partitions.begin(), scene.Partitions.end(),
      [&](const Box2& box) {
        return box.contains(Point2{ points[2 * i], points[2 * i + 1] });
      });
    Ids& ids =
      i % every == 0 ? scene.Initial : scene.Points[std::size_t(owner - scene.Partitions.begin())];
    ids.push_back(id);
  }
  return scene;
}

} // namespace test
} // namespace tipp

#endif
