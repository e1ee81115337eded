// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/PartitionConstraints.h"

#include "Constraints/SegmentInserter.h"
#include "Kernel/DelaunayKernel.h"

#include <algorithm>

namespace tipp
{
namespace
{

using Index = DelaunayKernel::Index;

constexpr Index NoVertex = -1;

std::size_t bitsIn(std::uint64_t word)
{
  return std::size_t(__builtin_popcountll(word));
}

/// A part of a piece, from a vertex to the next one on it, in a kernel's mesh.
struct Walk
{
  enum class End
  {
    Reached, ///< the piece's end
    Touched, ///< another vertex, on the piece
    Left     ///< the piece goes on where the mesh is not the final one
  };
  End How = End::Left;
  Index Vertex = NoVertex; ///< unless Left
  Index Edge = NoVertex;   ///< from the first vertex to this one, if there is one
};

/// A piece's line, for walks along it.
struct Line
{
  Point2 A; ///< where walks begin
  Point2 B;
  Index Goal; ///< the vertex at B, if it is known

  int side(Point2 p) const { return orientation(this->A, this->B, p); }

  /// Whether a point of the line lies between two of it, the second ahead.
  bool isBetween(Point2 from, Point2 p) const
  {
    return lexicographicLess(this->A, this->B)
      ? lexicographicLess(from, p) && lexicographicLess(p, this->B)
      : lexicographicLess(p, from) && lexicographicLess(this->B, p);
  }
};

/// Finds the edges that a line crosses.
class Walker
{
public:
  explicit Walker(const MeshEditor& mesh)
    : Mesh(mesh)
  {
  }

  /// From a vertex of the line on.
  Walk walk(const Line& line, Index a)
  {
    this->Crossed.clear();
    Walk walk;
    const Index first = this->findFirst(line, a, walk);
    if (first != NoVertex)
    {
      this->cross(line, this->Mesh.next(first), walk);
    }
    return walk;
  }

  /// The half-edges that the last walk crossed, in the triangles that it left there.
  const std::vector<Index>& crossed() const { return this->Crossed; }

private:
  /// The half-edge from a in whose triangle the line goes on, unless it goes on along an edge.
  Index findFirst(const Line& line, Index a, Walk& walk) const
  {
    const Index begin = this->Mesh.out(a);
    Index h = begin;
    int right = this->sideOf(line, this->Mesh.to(h));
    do
    {
      const Index p = this->Mesh.to(h);
      const Index q = this->Mesh.from(this->Mesh.previous(h));
      if (right == 0 && this->isNext(line, a, p))
      {
        walk = { p == line.Goal ? Walk::End::Reached : Walk::End::Touched, p, h };
        return NoVertex;
      }
      const int left = this->sideOf(line, q);
      if (right < 0 && left > 0 && right != Unknown && left != Unknown)
      {
        return h;
      }
      right = left;
      h = this->Mesh.twin(this->Mesh.previous(h));
    } while (h != begin);
    return NoVertex;
  }

  static constexpr int Unknown = -2; ///< of the vertex at infinity

  int sideOf(const Line& line, Index v) const
  {
    return v == DelaunayKernel::Infinite ? Unknown : line.side(this->Mesh.at(v));
  }

  bool isNext(const Line& line, Index a, Index v) const
  {
    return v == line.Goal || line.isBetween(this->Mesh.at(a), this->Mesh.at(v));
  }

  void cross(const Line& line, Index crossed, Walk& walk)
  {
    for (;;)
    {
      if (line.Goal == NoVertex &&
        orientation(this->Mesh.at(this->Mesh.from(crossed)), this->Mesh.at(this->Mesh.to(crossed)),
          line.B) >= 0)
      {
        return; // it ends in this triangle, where a vertex of another partition will be
      }
      this->Crossed.push_back(crossed);
      const Index half = this->Mesh.twin(crossed);
      const Index apex = this->Mesh.apex(half);
      if (apex == DelaunayKernel::Infinite)
      {
        return;
      }
      if (apex == line.Goal)
      {
        walk = { Walk::End::Reached, apex, NoVertex };
        return;
      }
      const int side = line.side(this->Mesh.at(apex));
      if (side == 0)
      {
        if (!(this->Mesh.at(apex) == line.B))
        {
          walk = { Walk::End::Touched, apex, NoVertex };
        }
        return;
      }
      crossed = side > 0 ? this->Mesh.next(half) : this->Mesh.previous(half);
    }
  }

  const MeshEditor& Mesh;
  std::vector<Index> Crossed;
};

} // namespace

PieceEnds::PieceEnds(std::size_t points, const std::vector<ConstraintPiece>& pieces)
  : Words(points / 64 + 1)
{
  const auto mark = [this](PointId id)
  { this->Words[std::size_t(id) / 64].Bits |= std::uint64_t(1) << (std::size_t(id) % 64); };
  for (const ConstraintPiece& piece : pieces)
  {
    mark(piece.A);
    mark(piece.B);
  }
  std::size_t ends = 0;
  for (Word& word : this->Words)
  {
    word.Before = ends;
    ends += bitsIn(word.Bits);
  }
  // A counting sort: in the end each Start is where the next one's was at first.
  this->Starts.assign(ends + 2, 0);
  for (const ConstraintPiece& piece : pieces)
  {
    ++this->Starts[this->rank(piece.A) + 2];
    ++this->Starts[this->rank(piece.B) + 2];
  }
  for (std::size_t i = 2; i < this->Starts.size(); ++i)
  {
    this->Starts[i] += this->Starts[i - 1];
  }
  this->Entries.resize(2 * pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    for (const std::size_t end : { std::size_t(0), std::size_t(1) })
    {
      std::int64_t& next = this->Starts[this->rank(end == 0 ? pieces[p].A : pieces[p].B) + 1];
      this->Entries[std::size_t(next++)] = std::int64_t(2 * p + end);
    }
  }
}

std::size_t PieceEnds::rank(PointId id) const
{
  const Word& word = this->Words[std::size_t(id) / 64];
  const std::uint64_t below = (std::uint64_t(1) << (std::size_t(id) % 64)) - 1;
  return word.Before + bitsIn(word.Bits & below);
}

/// One thread's.
class PartitionConstraints::Editor : public PartitionEditor
{
public:
  Editor(PartitionConstraints& of, double factor)
    : Of(of)
    , Factor(factor)
    , Finder(this->Mesh)
  {
  }

  void edit(const Partition<std::int32_t>& partition) override { this->editAny(partition); }
  void edit(const Partition<std::int64_t>& partition) override { this->editAny(partition); }

private:
  template <typename Id>
  void editAny(const Partition<Id>& partition)
  {
    this->collect(partition);
    if (this->EndVertices.empty())
    {
      return;
    }
    this->Mesh.begin(partition.Kernel);
    this->placeEnds(partition.Number);
    this->IsBoundary = partition.IsBoundary;
    const auto idOf = [&](Index v) { return PointId(partition.Ids[v]); };
    // First all that can be inserted, for this changes what the others cross.
    std::size_t left = 0;
    for (const std::int64_t entry : this->Entries)
    {
      const bool isWhole = this->otherEnd(entry, partition.Number) != NoVertex;
      if (isWhole && entry % 2 == 1)
      {
        continue; // taken from its other end
      }
      if (isWhole && this->follow(entry, partition.Number, true, idOf))
      {
        this->Of.Done[std::size_t(entry / 2)] = 1;
      }
      else
      {
        this->Entries[left++] = entry;
      }
    }
    this->Entries.resize(left);
    this->Noted.clear();
    for (const std::int64_t entry : this->Entries)
    {
      this->follow(entry, partition.Number, false, idOf);
    }
    this->publish(partition.Number);
  }

  /// Ends of pieces among the vertices.
  template <typename Id>
  void collect(const Partition<Id>& partition)
  {
    this->EndVertices.clear();
    const Index end = partition.Kernel.vertexEnd();
    for (Index v = 1; v < end; ++v)
    {
      const PointId id = partition.Ids[v];
      if (id >= 0 && this->Of.EndPoints.has(id))
      {
        this->Of.EndPoints.visit(
          id, [this, v](std::int64_t entry) { this->EndVertices.emplace_back(entry, v); });
      }
    }
  }

  void placeEnds(PartitionIndex partition)
  {
    this->Entries.clear();
    for (const auto& [entry, v] : this->EndVertices)
    {
      if (this->Mesh.isUsed(v))
      {
        Ends& ends = this->Of.EndsOf[std::size_t(entry / 2)];
        ends.Vertex[std::size_t(entry % 2)] = v;
        ends.Partition[std::size_t(entry % 2)].store(partition, std::memory_order_relaxed);
        this->Entries.push_back(entry);
      }
    }
  }

  /// The vertex at the other end, if it is this partition's.
  Index otherEnd(std::int64_t entry, PartitionIndex partition) const
  {
    const Ends& ends = this->Of.EndsOf[std::size_t(entry / 2)];
    const auto other = std::size_t(1 - entry % 2);
    return ends.Partition[other].load(std::memory_order_relaxed) == partition ? ends.Vertex[other]
                                                                              : NoVertex;
  }

  Point2 position(PointId id) const
  {
    const Point2 p = this->Of.Points[std::size_t(id)];
    return { p.x * this->Factor, p.y * this->Factor };
  }

  /// Follows a piece from one end on, part by part, and inserts parts that only interior triangles
  /// are in the way of, or notes which interior ones it crosses. Whether it is all there.
  template <typename IdOf>
  bool follow(std::int64_t entry, PartitionIndex partition, bool inserts, const IdOf& idOf)
  {
    const auto piece = std::size_t(entry / 2);
    const std::size_t end = std::size_t(entry % 2);
    const ConstraintPiece& ids = this->Of.Pieces[piece];
    Index at = this->Of.EndsOf[piece].Vertex[end];
    const Index goal = this->otherEnd(entry, partition);
    const Line line{ this->Mesh.at(at),
      goal != NoVertex ? this->Mesh.at(goal) : this->position(end == 0 ? ids.B : ids.A), goal };
    bool isAllThere = true;
    for (;;)
    {
      const Walk walk = this->Finder.walk(line, at);
      isAllThere = (inserts ? this->insert(at, walk) : this->note(piece)) && isAllThere;
      if (walk.How != Walk::End::Touched)
      {
        return isAllThere && walk.How == Walk::End::Reached;
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

  bool insert(Index from, const Walk& walk)
  {
    if (walk.How == Walk::End::Left)
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
    const std::vector<Index>& crossed = this->Finder.crossed();
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
    const std::vector<Index>& crossed = this->Finder.crossed();
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

  void publish(PartitionIndex partition)
  {
    std::sort(this->Noted.begin(), this->Noted.end());
    std::size_t at = 0;
    std::size_t interior = 0; // among the triangles before `at`
    this->Crossings.clear();
    for (const auto& [triangle, piece] : this->Noted)
    {
      for (; at < triangle; ++at)
      {
        interior += this->IsBoundary[at] ? 0 : 1;
      }
      this->Crossings.push_back({ piece, partition, interior });
    }
    const std::lock_guard<std::mutex> lock(this->Of.Mutex);
    this->Of.Crossings.insert(
      this->Of.Crossings.end(), this->Crossings.begin(), this->Crossings.end());
    this->Of.Touches.insert(this->Of.Touches.end(), this->Touches.begin(), this->Touches.end());
    this->Touches.clear();
  }

  PartitionConstraints& Of;
  const double Factor;
  MeshEditor Mesh;
  Walker Finder;
  SegmentInserter<MeshEditor> Inserter;
  const char* IsBoundary = nullptr;
  std::vector<std::pair<std::int64_t, Index>> EndVertices;
  std::vector<std::int64_t> Entries; ///< of pieces with an end here: as PieceEnds has them
  std::vector<std::pair<std::size_t, std::int64_t>> Noted; ///< crossed triangles, by number
  std::vector<Crossing> Crossings;
  std::vector<CrossedTriangles::Touch> Touches;
};

PartitionConstraints::PartitionConstraints(
  PointsView points, const std::vector<ConstraintPiece>& pieces)
  : Points(points)
  , Pieces(pieces)
  , EndPoints(points.size(), pieces)
  , EndsOf(pieces.size())
  , Done(pieces.size(), 0)
{
}

std::unique_ptr<PartitionEditor> PartitionConstraints::makeEditor(double factor)
{
  return std::make_unique<Editor>(*this, factor);
}

} // namespace tipp
