// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/PartitionConstraints.h"

#include "Arrays/IndexMap.h"
#include "Constraints/Insertion/ConstrainedMesh.h"
#include "Constraints/Insertion/SegmentInserter.h"
#include "Constraints/SegmentTree.h"
#include "Kernel/DelaunayKernel.h"
#include "Parallel/Instructions.h"
#include "Parallel/Sort.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <utility>

namespace tipp
{
namespace
{

using Index = DelaunayKernel::Index;

constexpr Index NoVertex = LineWalk::NoIndex;

/// The vertices of a partition at the ends of segments.
class EndVertices
{
public:
  /// An end of a segment: twice the segment's number in the partition, plus 1 for B.
  using End = std::uint32_t;

  void begin(std::size_t segments)
  {
    this->Lists.clear();
    this->Last.clear();
    this->Marks.fill(0);
    this->Earlier.resize(2 * segments);
    this->VertexOf.assign(2 * segments, NoVertex);
  }

  void add(End end, PointId id)
  {
    const auto [list, isNew] = this->Lists.insert(id);
    if (isNew)
    {
      this->Last.push_back(NoEnd);
    }
    this->Earlier[end] = std::exchange(this->Last[std::size_t(list)], end);
    this->Marks[word(id)] |= bit(id);
  }

  /// A quick filter: false for most ids that are not ends.
  bool mayHave(PointId id) const { return (this->Marks[word(id)] & bit(id)) != 0; }

  /// Sets the vertex of all ends with this id. Calls visit(end) for each of them whose segment's
  /// ends are now both known.
  template <typename Visit>
  void setVertex(PointId id, Index vertex, const Visit& visit)
  {
    const std::int32_t list = this->Lists.find(id);
    for (End end = list == IndexMap::None ? NoEnd : this->Last[std::size_t(list)]; end != NoEnd;
         end = this->Earlier[end])
    {
      this->VertexOf[end] = vertex;
      if (this->VertexOf[end ^ 1] != NoVertex)
      {
        visit(end);
      }
    }
  }

  /// The vertex at an end, or NoVertex if it is not in this partition.
  Index vertex(End end) const { return this->VertexOf[end]; }

private:
  static constexpr End NoEnd = ~End(0);
  static constexpr std::size_t Words = 2048; ///< so few that they stay in the first-level cache
  static std::size_t word(PointId id) { return std::size_t(id) / 64 % Words; }
  static std::uint64_t bit(PointId id) { return std::uint64_t(1) << (std::size_t(id) % 64); }

  std::array<std::uint64_t, Words> Marks{}; ///< bits at the ids of ends, modulo the number of bits
  IndexMap Lists;                           ///< numbers the ids of ends, which have a list each
  std::vector<End> Last;                    ///< by list: the last end added
  std::vector<End> Earlier;                 ///< by end: the end added to its list before, or NoEnd
  std::vector<Index> VertexOf;              ///< by end
};

} // namespace

/// The editor of one thread.
class PartitionConstraints::Editor : public PartitionEditor
{
public:
  explicit Editor(PartitionConstraints& shared)
    : Shared(shared)
    , Walker(this->Mesh)
    , Inserter(this->Mesh)
  {
  }

  void edit(const Partition<std::int32_t>& partition) override { this->editAny(partition); }
  void edit(const Partition<std::int64_t>& partition) override { this->editAny(partition); }

private:
  /// A segment that starts at a vertex of the partition.
  struct BegunSegment
  {
    std::int64_t Segment;
    Index From;
    DirectedLine Line;
  };

  template <typename Id>
  void editAny(const Partition<Id>& partition)
  {
    this->Near = this->Shared.Near.begin(partition.Bucket);
    this->NearCount = std::size_t(this->Shared.Near.end(partition.Bucket) - this->Near);
    if (this->NearCount > 0)
    {
      this->IsBoundary = partition.IsBoundary;
      this->IdOf = [ids = partition.Ids](Index v) { return PointId(ids[v]); };
      HalfEdgeMesh& mesh = partition.Kernel.editMesh();
      this->Mesh.begin(mesh.slots(), mesh.end(), partition.Kernel.points(),
        std::size_t(partition.Kernel.vertexEnd()));
      this->keepBoundary(partition.Kernel.triangleCount());
      this->findEnds(partition);
      this->insertWhole();
      this->noteOthers(partition.Border);
    }
    this->publish(partition.Bucket);
  }

  /// Marks the boundary triangles in the mesh, so that no segment is inserted there. Most triangles
  /// are interior, and memchr() skips them quickly.
  void keepBoundary(std::size_t triangles)
  {
    const char* const end = this->IsBoundary + triangles;
    const auto next = [end](const char* from)
    { return static_cast<const char*>(std::memchr(from, 1, std::size_t(end - from))); };
    for (const char* t = next(this->IsBoundary); t != nullptr; t = next(t + 1))
    {
      this->Mesh.keep(DelaunayKernel::triangle(std::size_t(t - this->IsBoundary)));
    }
  }

  const IdSegment& segment(std::size_t number) const
  {
    return this->Shared.Segments[std::size_t(this->Near[number])];
  }

  /// Finds the vertices at the ends of segments. Segments that have both are in Whole.
  template <typename Id>
  void findEnds(const Partition<Id>& partition)
  {
    this->Ends.begin(this->NearCount);
    constexpr std::size_t ahead = 16; // segments are scattered in memory
    for (std::size_t i = 0; i < this->NearCount; ++i)
    {
      __builtin_prefetch(&this->segment(std::min(i + ahead, this->NearCount - 1)));
      this->Ends.add(EndVertices::End(2 * i), this->segment(i).A);
      this->Ends.add(EndVertices::End(2 * i + 1), this->segment(i).B);
    }
    this->Whole.clear();
    this->Coinciding.clear();
    constexpr Index group = 64;
    std::array<Index, group> likely;
    const Index last = partition.Kernel.vertexEnd();
    for (Index begin = 1; begin < last; begin += group)
    {
      std::size_t count = 0;
      for (Index v = begin; v < std::min(begin + group, last); ++v)
      {
        likely[count] = v;
        count += std::size_t(this->Ends.mayHave(partition.Ids[v]));
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        const Index vertex = this->usedVertex(likely[i], partition.Kernel);
        if (vertex != NoVertex)
        {
          this->Ends.setVertex(partition.Ids[likely[i]], vertex,
            [this](EndVertices::End end) { this->Whole.push_back(end); });
        }
      }
    }
  }

  /// The vertex itself, the one that it coincides with, or NoVertex if it has no triangles.
  Index usedVertex(Index v, const DelaunayKernel& kernel)
  {
    if (this->Mesh.isUsed(v))
    {
      return v;
    }
    if (this->Coinciding.empty()) // the first time for each partition
    {
      for (const DelaunayKernel::Duplicate& duplicate : kernel.duplicates())
      {
        this->Coinciding.emplace_back(duplicate.Point, duplicate.Vertex);
      }
      std::sort(this->Coinciding.begin(), this->Coinciding.end());
    }
    const std::pair<std::size_t, Index> wanted(kernel.pointIndex(v), 0);
    const auto found = std::lower_bound(this->Coinciding.begin(), this->Coinciding.end(), wanted);
    return found != this->Coinciding.end() && found->first == wanted.first ? found->second
                                                                           : NoVertex;
  }

  BegunSegment begun(std::size_t number, bool fromB) const
  {
    const auto from = EndVertices::End(2 * number + (fromB ? 1 : 0));
    const Index a = this->Ends.vertex(from);
    const Index b = this->Ends.vertex(from ^ 1);
    const IdSegment& ids = this->segment(number);
    return { this->Near[number], a,
      { this->Mesh.at(a),
        b != NoVertex ? this->Mesh.at(b) : this->Shared.EndsAt[fromB ? ids.A : ids.B], b } };
  }

  /// Inserts what can be inserted, before crossings are recorded, because this changes the edges
  /// that other segments cross.
  void insertWhole()
  {
    this->Begun.clear();
    runWith(Instructions::Best,
      [&]
      {
        for (std::size_t i = 0; i < this->Whole.size(); ++i)
        {
          this->prefetchAfter(i);
          const BegunSegment segment = this->begun(this->Whole[i] / 2, this->Whole[i] % 2 != 0);
          if (this->follow(segment, true))
          {
            this->Shared.Done[std::size_t(segment.Segment)] = 1;
          }
          else
          {
            this->Begun.push_back(segment);
          }
        }
      });
  }

  /// Starts to load what the next segments in Whole need, because the mesh is larger than the
  /// second-level cache.
  [[gnu::always_inline]] void prefetchAfter(std::size_t i) const
  {
    const auto startOf = [this](std::size_t later)
    { return this->Ends.vertex(this->Whole[std::min(later, this->Whole.size() - 1)]); };
    this->Mesh.prefetchVertex(startOf(i + 6));
    this->Mesh.prefetchTriangle(startOf(i + 4));
    this->Mesh.prefetchAround(startOf(i + 2));
  }

  /// Records the interior triangles that the remaining segments cross.
  void noteOthers(const std::vector<BorderEdge>& border)
  {
    this->Through.clear();
    for (std::size_t i = 0; i < this->NearCount; ++i)
    {
      const bool hasA = this->Ends.vertex(EndVertices::End(2 * i)) != NoVertex;
      const bool hasB = this->Ends.vertex(EndVertices::End(2 * i + 1)) != NoVertex;
      if (hasA != hasB)
      {
        this->Begun.push_back(this->begun(i, hasB));
      }
      else if (!hasA)
      {
        this->Through.push_back(i);
      }
    }
    for (const BegunSegment& segment : this->Begun)
    {
      this->follow(segment, false);
    }
    this->Border.clear();
    for (const std::size_t number : this->Through)
    {
      this->noteEntries(border, number);
    }
  }

  /// Records the interior triangles that a segment without ends in the partition crosses. Follows
  /// it from each edge and vertex where it enters them.
  void noteEntries(const std::vector<BorderEdge>& border, std::size_t number)
  {
    this->locateBorder(border);
    const std::int64_t segment = this->Near[number];
    const IdSegment& ids = this->segment(number);
    const DirectedLine line{ this->Shared.EndsAt[ids.A], this->Shared.EndsAt[ids.B], NoVertex };
    const auto noteFromVertex = [&](Index vertex)
    {
      this->touch(segment, vertex);
      this->follow({ segment, vertex, line }, false);
    };
    const Box2 box = Box2::of(line.A, line.B);
    for (const EntryEdge& edge : this->Border)
    {
      if (!box.meets(Box2::of(edge.From, edge.To)))
      {
        continue;
      }
      const int from = line.side(edge.From);
      if (from == 0 && isBetween(line.A, edge.From, line.B))
      {
        noteFromVertex(this->Mesh.from(edge.Half));
      }
      else if (from < 0 && line.side(edge.To) > 0 && orientation(edge.From, edge.To, line.A) > 0 &&
        orientation(edge.From, edge.To, line.B) < 0)
      {
        const LineWalk walk = this->Walker.walkAcross(line, edge.Half);
        this->note(segment);
        if (walk.Reason == LineWalk::End::Touched)
        {
          noteFromVertex(walk.Vertex);
        }
      }
    }
  }

  /// Finds the positions of the border's edges, the first time for each partition.
  void locateBorder(const std::vector<BorderEdge>& border)
  {
    for (std::size_t i = this->Border.size(); i < border.size(); ++i)
    {
      const Index half = ConstrainedMesh::halfFrom(border[i].Outside, (border[i].Corner + 1) % 3);
      this->Border.push_back(
        { half, this->Mesh.at(this->Mesh.from(half)), this->Mesh.at(this->Mesh.to(half)) });
    }
  }

  /// Follows a segment from a vertex on it. If `inserts`, inserts its parts that only cross
  /// interior triangles; otherwise records the interior triangles that it crosses. Returns whether
  /// all parts are edges.
  bool follow(const BegunSegment& begun, bool inserts)
  {
    Index at = begun.From;
    bool isAllThere = true;
    for (;;)
    {
      const LineWalk walk = this->Walker.walk(begun.Line, at);
      isAllThere = (inserts ? this->insert(walk) : this->note(begun.Segment)) && isAllThere;
      if (walk.Reason != LineWalk::End::Touched)
      {
        return isAllThere && walk.Reason == LineWalk::End::Reached;
      }
      at = walk.Vertex;
      this->touch(begun.Segment, at);
    }
  }

  void touch(std::int64_t segment, Index vertex)
  {
    const PointId id = this->IdOf(vertex);
    if (id >= 0)
    {
      this->Touches.push_back({ segment, id });
    }
  }

  bool insert(const LineWalk& walk)
  {
    if (walk.Reason == LineWalk::End::LeftMesh)
    {
      return false;
    }
    if (walk.Edge != NoVertex)
    {
      this->Mesh.fix(walk.Edge);
      return !this->Mesh.isKept(ConstrainedMesh::triangleOf(walk.Edge)) ||
        !this->Mesh.isKept(ConstrainedMesh::triangleOf(this->Mesh.twin(walk.Edge)));
    }
    CrossedCavity& crossed = this->Walker.crossed();
    if (crossed.HasKept)
    {
      return false;
    }
    this->Inserter.insert(crossed);
    return true;
  }

  bool note(std::int64_t segment)
  {
    const CrossedCavity& crossed = this->Walker.crossed();
    for (std::size_t i = 0; i < crossed.Count; ++i)
    {
      this->noteTriangle(segment, crossed.Triangles[i]);
    }
    return false;
  }

  void noteTriangle(std::int64_t segment, Index triangle)
  {
    if (this->Mesh.isKept(triangle))
    {
      return;
    }
    this->Noted.push_back({ std::int64_t(DelaunayKernel::number(triangle)), segment });
    for (Index i = 0; i < 3; ++i)
    {
      const Index half = triangle + i;
      if (ConstrainedMesh::isFixed(this->Mesh.link(half)))
      {
        this->FixedEdges.push_back(
          { this->IdOf(this->Mesh.from(half)), this->IdOf(this->Mesh.to(half)) });
      }
    }
  }

  void publish(PartitionIndex partition)
  {
    sortUnique(this->Noted);
    std::vector<CrossedTriangles::Crossing> crossings;
    crossings.reserve(this->Noted.size());
    std::int64_t at = 0;
    std::int64_t before = 0; // number of interior triangles before `at`
    for (const auto& [triangle, segment] : this->Noted)
    {
      before += std::count(this->IsBoundary + at, this->IsBoundary + triangle, 0);
      at = triangle;
      crossings.push_back({ before, segment });
    }
    this->Shared.Crossings[std::size_t(partition)] = std::move(crossings);
    const std::lock_guard<std::mutex> lock(this->Shared.Mutex);
    this->Shared.Touches.insert(
      this->Shared.Touches.end(), this->Touches.begin(), this->Touches.end());
    this->Shared.FixedEdges.insert(
      this->Shared.FixedEdges.end(), this->FixedEdges.begin(), this->FixedEdges.end());
    this->Touches.clear();
    this->FixedEdges.clear();
    this->Noted.clear();
  }

  PartitionConstraints& Shared;
  ConstrainedMesh Mesh;
  LineWalker Walker;
  SegmentInserter Inserter;
  const char* IsBoundary = nullptr;
  std::function<PointId(Index)> IdOf;
  const std::int64_t* Near = nullptr; ///< the segments near the partition
  std::size_t NearCount = 0;
  EndVertices Ends;
  std::vector<EndVertices::End>
    Whole; ///< of segments with both ends in the partition: the one found last
  std::vector<BegunSegment> Begun;  ///< segments with one or both ends here that are not inserted
  std::vector<std::size_t> Through; ///< by number in Near: segments without ends in the partition
  std::vector<std::pair<std::size_t, Index>> Coinciding; ///< points and the vertices at them
  struct EntryEdge
  {
    Index Half; ///< its right side is interior
    Point2 From;
    Point2 To;
  };
  std::vector<EntryEdge> Border;                 ///< the partition's border, if it was needed
  std::vector<CrossedTriangles::Crossing> Noted; ///< triangles are numbers in the kernel
  std::vector<CrossedTriangles::Touch> Touches;
  std::vector<Edge> FixedEdges;
};

PartitionConstraints::PartitionConstraints(
  const std::vector<IdSegment>& segments, int threads, std::vector<Point2> others)
  : Segments(segments)
  , Threads(threads)
  , EndsAt{ {}, std::move(others) }
  , Done(segments.size(), 0)
{
}

void PartitionConstraints::begin(PointsView points, const Tiling& tiling)
{
  this->EndsAt.Points = points;
  for (Point2& p : this->EndsAt.Others)
  {
    p = { p.x * points.factor(), p.y * points.factor() };
  }
  this->Crossings.resize(std::size_t(tiling.size()));
  this->Near = PartitionSegments(tiling, this->Segments, this->EndsAt, this->Threads);
}

std::vector<std::int64_t> PartitionConstraints::remaining() const
{
  std::vector<std::int64_t> segments;
  for (std::size_t segment = 0; segment < this->Done.size(); ++segment)
  {
    if (!this->Done[segment])
    {
      segments.push_back(std::int64_t(segment));
    }
  }
  return segments;
}

std::unique_ptr<PartitionEditor> PartitionConstraints::makeEditor()
{
  return std::make_unique<Editor>(*this);
}

} // namespace tipp
