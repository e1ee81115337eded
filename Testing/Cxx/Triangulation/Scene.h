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
  std::vector<Box> Partitions;
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
  Box domain{ points[0], points[1], points[0], points[1] };
  for (std::size_t i = 0; i < points.size(); i += 2)
  {
    domain.XMin = std::min(domain.XMin, points[i]);
    domain.XMax = std::max(domain.XMax, points[i]);
    domain.YMin = std::min(domain.YMin, points[i + 1]);
    domain.YMax = std::max(domain.YMax, points[i + 1]);
  }
  const double w = domain.XMax - domain.XMin;
  const double h = domain.YMax - domain.YMin;
  Scene scene;
  for (int i = 0; i <= side; ++i)
  {
    const double x = domain.XMin - margin * w + i * (1 + 2 * margin) * w / side;
    const double y = domain.YMin - margin * h + i * (1 + 2 * margin) * h / side;
    const double low = domain.YMin - margin * h;
    const double left = domain.XMin - margin * w;
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
      { cut(domain.XMin, domain.XMax, column), cut(domain.YMin, domain.YMax, row),
        cut(domain.XMin, domain.XMax, column + 1), cut(domain.YMin, domain.YMax, row + 1) });
  }
  scene.Points.resize(scene.Partitions.size());
  for (std::size_t i = 0; i < points.size() / 2; ++i)
  {
    const auto id = scene.Artificial + std::int64_t(i);
    // A point on a common border belongs to the first of the partitions there.
    const auto owner = std::find_if(scene.Partitions.begin(), scene.Partitions.end(),
      [&](const Box& box) { return box.holds(points[2 * i], points[2 * i + 1]); });
    Ids& ids =
      i % every == 0 ? scene.Initial : scene.Points[std::size_t(owner - scene.Partitions.begin())];
    ids.push_back(id);
  }
  return scene;
}

} // namespace test
} // namespace tipp

#endif
