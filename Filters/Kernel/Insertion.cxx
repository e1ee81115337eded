// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/Insertion.h"

#include "Kernel/PointLocation.h"

namespace tipp
{

Cavity::Cavity()
  : Free(64)
  , Stack(64)
{
}

[[gnu::noinline]] void Cavity::grow()
{
  const std::size_t size = 2 * this->Free.size();
  this->Free.resize(size);
  this->Stack.resize(size);
}

namespace
{

using Index = HalfEdgeMesh::Index;

[[gnu::noinline]] void addCoincidence(const InsertionData& scene, Index vertex, Index equal)
{
  scene.Coincidences.push_back({ vertex, equal });
}

inline void insertInto(const InsertionData& scene, Index first, Index end)
{
  HalfEdgeMesh& mesh = scene.Mesh;
  const Point2* const points = scene.Points;
  Index recent = scene.Recent;
  for (Index vertex = first; vertex < end; ++vertex)
  {
    const Location found =
      PointLocation(mesh, points, scene.Predicates, pairAt(&points[vertex].x)).from(recent);
    if (__builtin_expect(found.EqualTo != InfiniteVertex, 0))
    {
      addCoincidence(scene, vertex, found.EqualTo);
      continue;
    }
    recent = scene.Opened.retriangulate(mesh, points, scene.Predicates, found, vertex);
  }
  scene.Recent = recent;
}

} // namespace

void insertVertices(const InsertionData& scene, HalfEdgeMesh::Index first, HalfEdgeMesh::Index end,
  Instructions instructions)
{
  runWith(instructions, [&] { insertInto(scene, first, end); });
}

} // namespace tipp
