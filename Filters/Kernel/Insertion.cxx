// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/Insertion.h"

#include "Kernel/CavityGrowth.h"
#include "Kernel/PointLocation.h"

namespace tipp
{
namespace
{

using Index = HalfEdgeMesh::Index;

[[gnu::noinline]] void addCoincidence(const InsertionScene& scene, Index vertex, Index equal)
{
  scene.Coincidences.push_back({ vertex, equal });
}

inline void insertInto(const InsertionScene& scene, Index first, Index end)
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

// `flatten` inlines all calls into each of these functions, so that everything is compiled for its
// instruction set.

[[gnu::flatten]] void insertCommon(const InsertionScene& scene, Index first, Index end)
{
  insertInto(scene, first, end);
}

#ifdef __x86_64__
[[gnu::flatten, gnu::target("avx2,bmi,bmi2")]] void insertAvx2(
  const InsertionScene& scene, Index first, Index end)
{
  insertInto(scene, first, end);
}
#endif

} // namespace

InsertVertices chooseInsertion(Instructions instructions)
{
#ifdef __x86_64__
  if (hasAvx2(instructions))
  {
    return insertAvx2;
  }
#endif
  static_cast<void>(instructions);
  return insertCommon;
}

} // namespace tipp
