// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/Cavity.h"

#include "Kernel/DelaunayKernel.h"

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

[[gnu::noinline]] void DelaunayKernel::addDuplicate(Index vertex, Index equal)
{
  this->Duplicates.push_back({ this->PointIndices[std::size_t(vertex)], equal });
}

inline void DelaunayKernel::insertInOrder(Index first, Index end)
{
  HalfEdgeMesh& mesh = this->Mesh;
  const Point2* const points = this->Points.data();
  Index recent = this->Recent;
  for (Index vertex = first; vertex < end; ++vertex)
  {
    const Location found =
      PointLocation(mesh, points, this->Predicates, pairAt(&points[vertex].x)).from(recent);
    if (__builtin_expect(found.EqualTo != InfiniteVertex, 0))
    {
      this->addDuplicate(vertex, found.EqualTo);
      continue;
    }
    recent = this->Opened.retriangulate(mesh, points, this->Predicates, found, vertex);
  }
  this->Recent = recent;
}

void DelaunayKernel::insertVertices(Index first, Index end)
{
  runWithManyRegisters(this->Allowed, [&] { this->insertInOrder(first, end); });
}

} // namespace tipp
