// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/PartitionConstraints.h"

#include "Arrays/SortUnique.h"
#include "Constraints/LineWalker.h"
#include "Constraints/SegmentInserter.h"
#include "Kernel/DelaunayKernel.h"
#include "Kernel/Lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

using Index = DelaunayKernel::Index;

constexpr Index NoVertex = LineWalk::None;

} // namespace

/// The editor of one thread.
class PartitionConstraints::Editor : public PartitionEditor
{
public:
  Editor(PartitionConstraints& of, double factor)
    : Of(of)
    , Factor(factor)
    , Walker(this->Mesh)
  {
  }

  void edit(const Partition<std::int32_t>& partition) override { this->editAny(partition); }
  void edit(const Partition<std::int64_t>& partition) override { this->editAny(partition); }

private:
  /// A piece that starts at a vertex of the partition.
  struct BegunPiece
  {
    std::int64_t Entry; ///< entry of PieceEnds for the start
    Index From;
    Index To; ///< vertex at the other end, or NoVertex if another partition has it
  };

  template <typename Id>
  void editAny(const Partition<Id>& partition)
  {
    this->findEnds(partition);
    this->IsBoundary = partition.IsBoundary;
    if (!this->Found.empty())
    {
      this->insertAll(partition);
    }
    this->publish(partition.Number, partition.Border);
  }

  template <typename Id>
  void insertAll(const Partition<Id>& partition)
  {
    this->Mesh.begin(partition.Kernel);
    this->collectPieces();
    this->placeEnds(partition.Number);
    this->findBegun(partition.Number);
    const auto idOf = [&](Index v) { return PointId(partition.Ids[v]); };
    // First inserts what can be inserted, because this changes the edges that other pieces cross.
    runWith(Instructions::Best,
      [&]
      {
        for (const BegunPiece& piece : this->Whole)
        {
          if (this->follow(piece, true, idOf))
          {
            this->Of.Done[std::size_t(piece.Entry / 2)] = 1;
          }
          else
          {
            this->Begun.push_back(piece);
          }
        }
      });
    for (const BegunPiece& piece : this->Begun)
    {
      this->follow(piece, false, idOf);
    }
  }

  /// Finds the pieces with an end in the partition. Those with both ends are in Whole, once each;
  /// the others are in Begun.
  void findBegun(PartitionIndex partition)
  {
    this->Whole.clear();
    this->Begun.clear();
    for (const auto& [entry, v] : this->EndVertices)
    {
      if (v != NoVertex)
      {
        const Index other = this->otherEnd(entry, partition);
        const BegunPiece piece{ entry, v, other };
        other == NoVertex  ? this->Begun.push_back(piece)
          : entry % 2 == 0 ? this->Whole.push_back(piece)
                           : void();
      }
    }
  }

  /// Finds ends of pieces among the vertices. Data of points and pieces are accessed at random, and
  /// so are prefetched.
  template <typename Id>
  void findEnds(const Partition<Id>& partition)
  {
    const PieceEnds& ends = this->Of.EndPoints;
    constexpr Index group = 64;
    std::array<Index, group> likely;
    this->Found.clear();
    const Index last = partition.Kernel.vertexEnd();
    for (Index begin = 1; begin < last; begin += group)
    {
      std::size_t count = 0;
      const Index end = std::min(begin + group, last);
      for (Index v = begin; v < end; ++v)
      {
        likely[count] = v;
        count += std::size_t(ends.mayHave(partition.Ids[v]));
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        ends.expect(partition.Ids[likely[i]]);
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        const PointId id = partition.Ids[likely[i]];
        if (ends.has(id))
        {
          this->Found.push_back({ ends.rank(id), likely[i] });
        }
      }
    }
  }

  void collectPieces()
  {
    const PieceEnds& ends = this->Of.EndPoints;
    for (const FoundEnd& end : this->Found)
    {
      ends.expectEntries(end.Rank);
    }
    for (const FoundEnd& end : this->Found)
    {
      ends.expectVisit(end.Rank);
    }
    this->EndVertices.clear();
    for (const auto& [rank, v] : this->Found)
    {
      ends.visit(rank,
        [this, v = v](std::int64_t entry)
        {
          this->EndVertices.emplace_back(entry, v);
          __builtin_prefetch(&this->Of.EndsOf[std::size_t(entry / 2)], 1);
        });
    }
  }

  void placeEnds(PartitionIndex partition)
  {
    for (auto& [entry, v] : this->EndVertices)
    {
      if (this->Mesh.isUsed(v))
      {
        Ends& ends = this->Of.EndsOf[std::size_t(entry / 2)];
        ends.Vertex[std::size_t(entry % 2)] = v;
        ends.Partition[std::size_t(entry % 2)].store(partition, std::memory_order_relaxed);
      }
      else
      {
        v = NoVertex;
      }
    }
  }

  /// The vertex at the other end, or NoVertex if it is not in this partition.
  Index otherEnd(std::int64_t entry, PartitionIndex partition) const
  {
    const Ends& ends = this->Of.EndsOf[std::size_t(entry / 2)];
    const auto other = std::size_t(1 - entry % 2);
    return ends.Partition[other].load(std::memory_order_relaxed) == partition ? ends.Vertex[other]
                                                                              : NoVertex;
  }

  /// The position of the piece's other end, in the kernel's scale.
  Point2 otherPosition(std::int64_t entry) const
  {
    const ConstraintPiece& ids = this->Of.Pieces[std::size_t(entry / 2)];
    const Point2 p = this->Of.at(entry % 2 == 0 ? ids.B : ids.A);
    return { p.x * this->Factor, p.y * this->Factor };
  }

  /// Follows a piece from one end. If `inserts`, inserts its parts that only cross interior
  /// triangles; otherwise records the interior triangles that it crosses. Returns whether all parts
  /// are edges.
  template <typename IdOf>
  bool follow(const BegunPiece& begun, bool inserts, const IdOf& idOf)
  {
    const auto piece = std::size_t(begun.Entry / 2);
    Index at = begun.From;
    const DirectedLine line{ this->Mesh.at(at),
      begun.To != NoVertex ? this->Mesh.at(begun.To) : this->otherPosition(begun.Entry), begun.To };
    bool isAllThere = true;
    for (;;)
    {
      const LineWalk walk = this->Walker.walk(line, at);
      isAllThere = (inserts ? this->insert(at, walk) : this->note(piece)) && isAllThere;
      if (walk.How != LineWalk::End::Touched)
      {
        return isAllThere && walk.How == LineWalk::End::Reached;
      }
      at = walk.Vertex;
      if (idOf(at) >= 0)
      {
        this->Touches.push_back({ std::int64_t(piece), idOf(at) });
      }
    }
  }

  bool isInterior(Index triangle) const
  {
    return !this->IsBoundary[DelaunayKernel::number(triangle)];
  }

  bool insert(Index from, const LineWalk& walk)
  {
    if (walk.How == LineWalk::End::Left)
    {
      return false;
    }
    if (walk.Edge != NoVertex)
    {
      const Index twin = this->Mesh.twin(walk.Edge);
      this->Mesh.setFixed(walk.Edge, true);
      this->Mesh.setFixed(twin, true);
      return this->isInterior(this->Mesh.triangleOf(walk.Edge)) ||
        this->isInterior(this->Mesh.triangleOf(twin));
    }
    const std::vector<Index>& crossed = this->Walker.crossed();
    const bool isInside = this->isInterior(this->Mesh.triangleOf(crossed.front())) &&
      std::all_of(crossed.begin(), crossed.end(),
        [this](Index h) { return this->isInterior(this->Mesh.triangleOf(this->Mesh.twin(h))); });
    if (isInside)
    {
      this->Inserter.insert(this->Mesh, from, walk.Vertex, crossed);
    }
    return isInside;
  }

  bool note(std::size_t piece)
  {
    const auto noteTriangle = [this, piece](Index triangle)
    {
      if (this->isInterior(triangle))
      {
        this->Noted.push_back({ DelaunayKernel::number(triangle), std::int64_t(piece) });
      }
    };
    const std::vector<Index>& crossed = this->Walker.crossed();
    if (!crossed.empty())
    {
      noteTriangle(this->Mesh.triangleOf(crossed.front()));
      for (const Index h : crossed)
      {
        noteTriangle(this->Mesh.triangleOf(this->Mesh.twin(h)));
      }
    }
    return false;
  }

  void publish(PartitionIndex partition, const std::vector<Box2>& border)
  {
    Interior interior;
    interior.Border.reserve(border.size());
    for (const Box2& edge : border)
    {
      interior.Border.push_back(scaled(edge, 1 / this->Factor)); // exact: a power of two
    }
    sortUnique(this->Noted);
    std::size_t at = 0;
    std::size_t before = 0; // number of interior triangles before `at`
    interior.Crossings.reserve(this->Noted.size());
    for (const auto& [triangle, piece] : this->Noted)
    {
      before += std::size_t(std::count(this->IsBoundary + at, this->IsBoundary + triangle, 0));
      at = triangle;
      interior.Crossings.emplace_back(before, piece);
    }
    const std::lock_guard<std::mutex> lock(this->Of.Mutex);
    this->Of.Touches.insert(this->Of.Touches.end(), this->Touches.begin(), this->Touches.end());
    this->Of.Interiors[partition] = std::move(interior);
    this->Touches.clear();
    this->Noted.clear();
  }

  PartitionConstraints& Of;
  const double Factor;
  MeshEditor Mesh;
  LineWalker Walker;
  SegmentInserter<MeshEditor> Inserter;
  const char* IsBoundary = nullptr;
  struct FoundEnd
  {
    std::size_t Rank;
    Index Vertex;
  };
  std::vector<FoundEnd> Found;                             ///< vertices that are ends of pieces
  std::vector<std::pair<std::int64_t, Index>> EndVertices; ///< entries of PieceEnds, vertices
  std::vector<BegunPiece> Whole;
  std::vector<BegunPiece> Begun; ///< pieces that are not inserted here
  std::vector<Crossing> Noted;   ///< triangles are indices in the kernel
  std::vector<CrossedTriangles::Touch> Touches;
};

PartitionConstraints::PartitionConstraints(PointsView points,
  const std::vector<ConstraintPiece>& pieces, int threads, std::vector<Point2> others)
  : Points(points)
  , Others(std::move(others))
  , Pieces(pieces)
  , EndPoints(points.size() + this->Others.size(), pieces, threads)
  , EndsOf(pieces.size())
  , Done(pieces.size(), 0)
{
}

bool PartitionConstraints::mayEnter(const SegmentTree& tree, PartitionIndex partition,
  const std::function<std::int64_t(std::int64_t)>& pieceOf) const
{
  const auto& border = this->interiorOf(partition).Border;
  const Box2 all{ -HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL };
  const Box2 box =
    border.empty() ? all : std::accumulate(border.begin(), border.end(), border.front(), unionOf);
  bool isNear = false;
  tree.visitNear(box,
    [&](const SegmentTree::Item& item)
    {
      const std::int64_t piece = pieceOf(item.Id);
      // Unless an end is a duplicate, no end is a vertex of an interior triangle.
      isNear = !(piece >= 0 && this->isKnown(piece, partition)) &&
        (border.empty() || (piece >= 0 && this->mayEndAtDuplicate(piece)) ||
          std::any_of(border.begin(), border.end(),
            [&item](const Box2& edge)
            { return overlap(boxOf(item.A, item.B), edge) && lineMayMeet(item.A, item.B, edge); }));
      return !isNear;
    });
  return isNear;
}

std::unique_ptr<PartitionEditor> PartitionConstraints::makeEditor(double factor)
{
  return std::make_unique<Editor>(*this, factor);
}

} // namespace tipp
