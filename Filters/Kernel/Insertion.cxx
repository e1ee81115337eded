// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/Insertion.h"

#include "Kernel/CavityGrowth.h"
#include "Kernel/PointLocation.h"

namespace tipp
{
namespace
{

using Index = HalfEdgeMesh::Index;

/// The triangle's vertex at p, or the infinite one.
Index equalVertex(const HalfEdgeMesh& mesh, const Point2* points, const Location& at, Point2 p)
{
  // At a corner two of them are zero, or NaN where the triangle's extent overflows.
  if (__builtin_expect(at.Cross[0] > 0 && at.Cross[1] > 0 && at.Cross[2] > 0, 1))
  {
    return InfiniteVertex;
  }
  for (Index i = 0; i < 3; ++i)
  {
    const Index v = mesh.vertex(at.Triangle + i);
    if (points[v] == p)
    {
      return v;
    }
  }
  return InfiniteVertex;
}

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
    const Point2 p = points[vertex];
    const Location location = locate(mesh, points, scene.Predicates, recent, p);
    const Index equal = equalVertex(mesh, points, location, p);
    if (__builtin_expect(equal != InfiniteVertex, 0))
    {
      addCoincidence(scene, vertex, equal);
      continue;
    }
    scene.Opened.open(mesh, points, scene.Predicates, location, p);
    recent = scene.Opened.fill(mesh, vertex);
  }
  scene.Recent = recent;
}

// All that is inline becomes part of each of these, and so is compiled for its instructions.

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
  if (instructions == Instructions::Best && __builtin_cpu_supports("avx2") &&
    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2"))
  {
    return insertAvx2;
  }
#endif
  static_cast<void>(instructions);
  return insertCommon;
}

} // namespace tipp
