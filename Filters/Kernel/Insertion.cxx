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

/// Inserts the pending vertices of a kernel step by step. A step ends with comparisons, whose
/// results decide what the next one does: so a step of another kernel can be computed in between.
class DelaunayKernel::Insertion
{
public:
  explicit Insertion(DelaunayKernel& kernel)
    : Kernel(kernel)
    , Walk(kernel.Mesh, kernel.Points.data(), kernel.Predicates)
    , Growth(kernel.Opened, kernel.Mesh, kernel.Points.data(), kernel.Predicates)
    , Vertex(kernel.Pending)
    , End(kernel.vertexEnd())
    , Recent(kernel.Recent)
  {
    this->beginWalk();
  }

  bool isDone() const { return this->Phase == Done; }

  void step()
  {
    if (this->Phase == Growing)
    {
      this->stepOfGrowth();
    }
    else if (this->Phase == Walking)
    {
      this->stepOfWalk();
    }
  }

  /// Stores in the kernel how far it came.
  void finish()
  {
    this->Kernel.Pending = this->Vertex;
    this->Kernel.Recent = this->Recent;
  }

private:
  void beginWalk()
  {
    this->Phase = Done;
    if (this->Vertex < this->End)
    {
      this->Phase = Walking;
      this->Walk.begin(pairAt(&this->Kernel.Points[this->Vertex].x), this->Recent);
    }
  }

  void stepOfWalk()
  {
    if (!this->Walk.isAtEnd())
    {
      this->Walk.step();
      return;
    }
    const Location found = this->Walk.location();
    if (__builtin_expect(found.EqualTo != InfiniteVertex, 0))
    {
      this->Kernel.addDuplicate(this->Vertex, found.EqualTo);
      this->beginNext();
      return;
    }
    this->Growth.begin(found, this->Vertex);
    this->Phase = Growing;
  }

  void stepOfGrowth()
  {
    if (!this->Growth.step())
    {
      this->Recent = this->Growth.closeRing();
      this->beginNext();
    }
  }

  void beginNext()
  {
    ++this->Vertex;
    this->beginWalk();
  }

  DelaunayKernel& Kernel;
  PointLocation Walk;
  Cavity::Growth Growth;
  Index Vertex;
  const Index End;
  Index Recent; ///< a finite triangle near the last insertion
  enum
  {
    Walking,
    Growing,
    Done
  } Phase = Walking;
};

inline void DelaunayKernel::insertInOrder(Index end)
{
  HalfEdgeMesh& mesh = this->Mesh;
  const Point2* const points = this->Points.data();
  Index recent = this->Recent;
  for (Index vertex = this->Pending; vertex < end; ++vertex)
  {
    const Location found =
      PointLocation(mesh, points, this->Predicates).from(pairAt(&points[vertex].x), recent);
    if (__builtin_expect(found.EqualTo != InfiniteVertex, 0))
    {
      this->addDuplicate(vertex, found.EqualTo);
      continue;
    }
    recent = this->Opened.retriangulate(mesh, points, this->Predicates, found, vertex);
  }
  this->Pending = end;
  this->Recent = recent;
}

void DelaunayKernel::insertUpTo(Index end)
{
  runWithManyRegisters(this->Allowed, [&] { this->insertInOrder(end); });
}

void DelaunayKernel::insertInTurn(DelaunayKernel& one, DelaunayKernel& other)
{
  runWithManyRegisters(one.Allowed,
    [&]
    {
      Insertion first(one);
      Insertion second(other);
      while (!first.isDone() || !second.isDone())
      {
        first.step();
        second.step();
      }
      first.finish();
      second.finish();
    });
}

} // namespace tipp
