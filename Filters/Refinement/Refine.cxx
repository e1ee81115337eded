// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/Refine.h"

#include "Predicates/Angles.h"
#include "Refinement/BlockRefiner.h"
#include "Refinement/RefinementBlocks.h"
#include "Refinement/RefinementMesh.h"
#include "Refinement/RefinementRules.h"
#include "Refinement/StartMesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

using Index = RefinementMesh::Index;
using Triangle = RefinementMesh::Triangle;
using Element = RefinementQueue::Element;

Index regionOf(const Triangle& triangle)
{
  return Index(triangle.State >> RefinementMesh::RegionShift);
}

template <typename Items>
void append(const Items& from, Items& to)
{
  to.insert(to.end(), from.begin(), from.end());
}

/// Throws std::invalid_argument with a sentence of these parts unless `isValid`.
template <typename... Parts>
void require(bool isValid, const Parts&... parts)
{
  if (!isValid)
  {
    std::ostringstream text;
    (text << ... << parts);
    throw std::invalid_argument(text.str());
  }
}

void requireValid(const RefinementOptions& options)
{
  require(options.MinimumAngle >= 0 && options.MinimumAngle <= RefinementOptions::LargestAngle,
    "The smallest angle must be between 0 and ", RefinementOptions::LargestAngle,
    " degrees; it is ", options.MinimumAngle, ".");
  require(
    options.LargestArea > 0, "The largest area must be above 0; it is ", options.LargestArea, ".");
  require(options.ShortestEdge >= 0 && std::isfinite(options.ShortestEdge),
    "The shortest edge must be at least 0; it is ", options.ShortestEdge, ".");
  for (const RefinementRegion& region : options.Regions)
  {
    require(region.LargestArea > 0, "The largest area of a region must be above 0; it is ",
      region.LargestArea, ".");
  }
}

/// A refinement in levels, each of which makes the edges a quarter as long, in rounds of blocks in
/// parallel.
class Refinement
{
public:
  Refinement(
    PointsView points, const ConstrainedTriangulation& start, const RefinementOptions& options)
    : Options(options)
    , Points(points)
    , Threads(threadCount(options.Threads))
    , Mesh(options.Memory)
  {
    requireValid(options);
    startMesh(points, start, options, this->Mesh);
    this->Given = std::int64_t(this->Mesh.PointEnd);
    this->setRules();
  }

  /// Returns false if Progress stopped it.
  bool run();
  RefinedMesh result();

private:
  void setRules();
  double expectedTriangles() const;
  bool runLevel();
  bool runRound(const std::vector<RefinementBlock>& blocks, Buffer<Element>& elements);
  Buffer<Element> join(const std::vector<BlockRefiner::Result>& results) const;
  static constexpr std::size_t GroupsInChunk = 256;
  static std::size_t chunkCount(const std::vector<Index>& groups)
  {
    return (groups.size() + GroupsInChunk - 1) / GroupsInChunk;
  }
  template <typename Item, typename Visit>
  void forGroups(
    const std::vector<Index>& groups, std::vector<Item>& chunks, const Visit& visit) const;
  template <typename Item, typename Visit>
  void forVertices(std::vector<Item>& chunks, const Visit& visit) const;
  template <typename Item, typename Visit>
  void forTriangles(std::vector<Item>& chunks, const Visit& visit) const;
  Buffer<Element> collect() const;
  bool isFull() const
  {
    return this->Options.MostPoints > 0 && this->inserted() >= this->Options.MostPoints;
  }
  std::int64_t inserted() const
  {
    std::int64_t sum = 0;
    for (const auto& refiner : this->Refiners)
    {
      sum += refiner ? refiner->counts().Inserted : 0;
    }
    return sum;
  }
  double fractionDone() const
  {
    const double end = this->Expected / 2 + double(this->Given);
    return std::min(1.0, double(this->Mesh.PointEnd) / end);
  }
  Buffer<Index> addPoints(RefinedMesh& result) const;
  void addTriangles(const Buffer<Index>& ids, RefinedMesh& result) const;
  void addSegments(
    const Triangle& triangle, const Buffer<Index>& ids, std::vector<IdSegment>& segments) const;
  void judgeResult(
    std::int64_t i, const Triangle& triangle, std::vector<TriangleOutside>& outside) const;
  TriangleOutside::Reason reasonFor(const Triangle& triangle, bool isThin, int leastCorner) const;

  const RefinementOptions& Options;
  const PointsView Points;
  const int Threads;
  RefinementMesh Mesh;
  RefinementRules Rules;
  std::int64_t Given = 0;      ///< vertices before refinement
  double LeastSineSquared = 0; ///< of the bound, a little above it: rounding must not hide an angle
  double Expected = 0;         ///< a rough number of triangles at the end
  bool StoppedEarly = false;   ///< MostPoints was reached
  std::vector<std::unique_ptr<BlockRefiner>> Refiners; ///< by thread
  RefinementStatistics Statistics;
};

void Refinement::setRules()
{
  this->Rules.MinimumAngle = this->Options.MinimumAngle;
  this->Rules.LargestArea = this->Options.LargestArea;
  this->Rules.AreaAt = this->Options.AreaAt;
  this->Rules.KeepsBorder = this->Options.KeepsBorder || this->Options.KeepsSegments;
  this->Rules.KeepsSegments = this->Options.KeepsSegments;
  this->Rules.LeastArea =
    this->Options.AreaAt ? this->Options.LeastArea : std::numeric_limits<double>::infinity();
  this->Rules.LeastArea = std::min(this->Rules.LeastArea, this->Options.LargestArea);
  if (!this->Options.Regions.empty())
  {
    this->Rules.RegionAreas.push_back(std::numeric_limits<double>::infinity()); // in no region
    for (const RefinementRegion& region : this->Options.Regions)
    {
      this->Rules.RegionAreas.push_back(region.LargestArea);
      this->Rules.LeastArea = std::min(this->Rules.LeastArea, region.LargestArea);
    }
  }
  Box2 box = Box2::empty();
  for (std::int64_t i = 0; i < this->Mesh.PointEnd; ++i)
  {
    if (this->Mesh.Origins[std::size_t(i)] != RefinementMesh::NoVertex)
    {
      box.extend(this->Mesh.Points[std::size_t(i)]);
    }
  }
  // Rounding moves a point by 2^-53 of the largest coordinate, which must not matter for an edge.
  const double side = std::max(box.Max.x - box.Min.x, box.Max.y - box.Min.y);
  // Sixth powers of lengths must not overflow, nor underflow for the shortest edges.
  constexpr double largest = 1e45;
  constexpr double smallest = 1e-35;
  require(box.isEmpty() || (side >= smallest && box.largest() <= largest),
    "A domain with a longest side of ", side, " and a largest coordinate of ", box.largest(),
    " cannot be refined; scale the coordinates to between ", smallest, " and ", largest, ".");
  this->Rules.ShortestEdge = this->Options.ShortestEdge > 0
    ? this->Options.ShortestEdge
    : std::max(std::ldexp(side, -36), std::ldexp(box.largest(), -44));
  this->Rules.prepare(1);
  const double sine = sineOfDegrees(this->Options.MinimumAngle);
  this->LeastSineSquared = sine * sine * (1 + 1e-12);
}

/// A rough number of triangles that the limits of area make necessary.
double Refinement::expectedTriangles() const
{
  double sum = 0;
  for (std::int64_t t = 0; t < this->Mesh.TriangleEnd; ++t)
  {
    const Triangle& triangle = this->Mesh.Triangles[std::size_t(t)];
    if ((triangle.State & RefinementMesh::IsLive) == 0)
    {
      continue;
    }
    const std::array<Point2, 3> p = this->Mesh.cornersOf(triangle);
    const double limit = this->Rules.areaLimit(p, regionOf(triangle));
    constexpr double fill = 0.6; // the mean area of a refined mesh's triangles, of the limit
    sum += std::max(1.0, cross(p[1] - p[0], p[2] - p[0]) / 2 / (fill * limit));
  }
  return sum;
}

/// Calls visit(item, first, next) for each of the `groups`, on all threads: `first` is the group's
/// first index, and `next` that of the group after it. Consecutive groups share an item of
/// `chunks`, which is resized.
template <typename Item, typename Visit>
void Refinement::forGroups(
  const std::vector<Index>& groups, std::vector<Item>& chunks, const Visit& visit) const
{
  constexpr auto chunk = std::int64_t(GroupsInChunk);
  const auto count = std::int64_t(groups.size());
  chunks.resize(chunkCount(groups));
  forChunks(count, chunk, this->Threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (std::int64_t group = begin; group < end; ++group)
      {
        const std::int64_t after = std::min(group + 1, count - 1);
        visit(chunks[std::size_t(begin / chunk)], groups[std::size_t(group)],
          groups[std::size_t(after)]);
        constexpr std::int64_t often = 32; // groups: vertices of triangles may be far apart
        if (group % often == 0)
        {
          keepMemoryLimits();
        }
      }
    });
}

/// Calls visit(item, vertex) for all indices of vertices, also unused ones; see forGroups().
template <typename Item, typename Visit>
void Refinement::forVertices(std::vector<Item>& chunks, const Visit& visit) const
{
  this->forGroups(this->Mesh.PointGroups, chunks,
    [&](Item& item, Index first, Index)
    {
      for (Index i = first; i < first + RefinementMesh::PointsInGroup; ++i)
      {
        visit(item, std::size_t(i));
      }
    });
}

/// Calls visit(item, index, triangle) for all triangles; see forGroups().
template <typename Item, typename Visit>
void Refinement::forTriangles(std::vector<Item>& chunks, const Visit& visit) const
{
  this->forGroups(this->Mesh.TriangleGroups, chunks,
    [&](Item& item, Index first, Index after)
    {
      for (Index t = first; t < first + RefinementMesh::TrianglesInGroup; ++t)
      {
        __builtin_prefetch(&this->Mesh.Triangles[std::size_t(after + (t - first))]);
        const Triangle& triangle = this->Mesh.Triangles[std::size_t(t)];
        if ((triangle.State & RefinementMesh::IsLive) != 0)
        {
          visit(item, t, triangle);
        }
      }
    });
}

/// The triangles that need refinement.
Buffer<Element> Refinement::collect() const
{
  // Each chunk writes to a part of the array of its own, with room for all its triangles.
  constexpr std::size_t room = GroupsInChunk * std::size_t(RefinementMesh::TrianglesInGroup);
  struct alignas(64) Part // so that threads do not share a cache line
  {
    std::size_t Count = 0;
  };
  std::vector<Part> parts;
  const std::size_t chunkCount = this->chunkCount(this->Mesh.TriangleGroups);
  Buffer<Element> elements = bufferIn<Element>(this->Options.Memory, room * chunkCount);
  this->forTriangles(parts,
    [&](Part& part, Index t, const Triangle& triangle)
    {
      if (this->Rules.judge(this->Mesh, triangle).Why != RefinementRules::Need::None)
      {
        const auto chunk = std::size_t(&part - parts.data());
        elements[chunk * room + part.Count++] = { t, triangle.Version };
      }
    });
  std::size_t end = 0;
  for (std::size_t chunk = 0; chunk < chunkCount; ++chunk)
  {
    const Element* const first = elements.data() + chunk * room;
    std::copy(first, first + parts[chunk].Count, elements.data() + end);
    end += parts[chunk].Count;
    keepMemoryLimits();
  }
  elements.truncate(end);
  return elements;
}

bool Refinement::run()
{
  this->Refiners.resize(std::size_t(this->Threads));
  this->Expected = this->expectedTriangles();
  const auto most = double(this->Mesh.Triangles.capacity());
  if (this->Expected > most && this->Options.MostPoints == 0)
  {
    std::ostringstream text;
    text << "The limits of areas ask for about " << this->Expected
         << " triangles, and there is room for " << most << "; ask for larger ones.";
    throw std::length_error(text.str());
  }
  this->Expected = std::min(this->Expected, most);
  // Coarse levels first: they cost few points, and later ones then work locally.
  constexpr double coarsest = 8192; // triangles
  constexpr double step = 16;
  double coarser = 1;
  for (double expected = this->Expected;
       expected > std::max(coarsest, step * double(this->Mesh.TriangleEnd)); expected /= step)
  {
    coarser *= step;
  }
  for (; coarser >= 1; coarser /= step)
  {
    this->Rules.prepare(coarser);
    ++this->Statistics.Levels;
    if (!this->runLevel())
    {
      return false;
    }
  }
  return true;
}

/// Refines until no element is left.
bool Refinement::runLevel()
{
  Buffer<Element> elements = this->collect();
  // MostPoints is exact, and the same for any number of threads, in one block only.
  std::size_t most = this->Options.MostPoints > 0 ? 1 : elements.size() + 1;
  for (bool isFirst = true; !elements.empty() && !this->StoppedEarly; isFirst = false)
  {
    const std::vector<RefinementBlock> blocks =
      makeBlocks(this->Mesh, elements, most, !isFirst, this->Threads, this->Options.Memory);
    ++this->Statistics.Rounds;
    this->Statistics.Blocks += std::int64_t(blocks.size());
    const std::size_t before = elements.size();
    if (!this->runRound(blocks, elements))
    {
      return false;
    }
    if (2 * elements.size() > before) // the triangles are too large for such blocks
    {
      most = std::max<std::size_t>(1, std::min(most, blocks.size()) / 4);
    }
  }
  return true;
}

/// Refines the blocks; `elements` becomes those that wait for the next round.
bool Refinement::runRound(const std::vector<RefinementBlock>& blocks, Buffer<Element>& elements)
{
  std::vector<BlockRefiner::Result> results(blocks.size());
  std::atomic<bool> isStopped{ false };
  const auto work = [&](std::int64_t block, std::int64_t, int thread)
  {
    auto& refiner = this->Refiners[std::size_t(thread)];
    if (!refiner)
    {
      refiner = std::make_unique<BlockRefiner>(this->Mesh, this->Rules);
    }
    const auto proceed = [&]
    {
      keepMemoryLimits();
      if (thread == 0 && this->Options.Progress && !this->Options.Progress(this->fractionDone()))
      {
        isStopped = true;
      }
      return !isStopped;
    };
    const RefinementBlock& at = blocks[std::size_t(block)];
    results[std::size_t(block)] = refiner->run(at.Bounds, elements.data() + at.Begin,
      elements.data() + at.End, this->Options.MostPoints, proceed);
  };
  forChunks(std::int64_t(blocks.size()), 1, this->Threads, {}, work);
  if (isStopped)
  {
    return false;
  }
  this->StoppedEarly = this->isFull();
  for (const BlockRefiner::Result& result : results)
  {
    append(result.TriangleGroups, this->Mesh.TriangleGroups);
    append(result.PointGroups, this->Mesh.PointGroups);
  }
  elements = this->join(results);
  return true;
}

/// Returns the elements that wait for another block.
Buffer<Element> Refinement::join(const std::vector<BlockRefiner::Result>& results) const
{
  std::size_t count = 0;
  for (const BlockRefiner::Result& result : results)
  {
    count += result.Waiting.size();
  }
  Buffer<Element> elements = bufferIn<Element>(this->Options.Memory, count);
  Element* to = elements.data();
  for (const BlockRefiner::Result& result : results)
  {
    to = std::copy(result.Waiting.begin(), result.Waiting.end(), to);
    keepMemoryLimits();
  }
  return elements;
}

/// Sets the added points. Returns the id of each vertex.
Buffer<Index> Refinement::addPoints(RefinedMesh& result) const
{
  const RefinementMesh& mesh = this->Mesh;
  const auto given = std::int64_t(this->Points.size());
  if (given + mesh.PointEnd > std::numeric_limits<Index>::max())
  {
    throw std::length_error("The mesh would have too many points.");
  }
  const auto isAdded = [](Index origin)
  { return origin == RefinementMesh::Free || RefinementMesh::isOnSegment(origin); };
  std::vector<std::int64_t> chunks; // for each the index of its first added point
  this->forVertices(chunks,
    [&](std::int64_t& count, std::size_t vertex)
    { count += isAdded(mesh.Origins[vertex]) ? 1 : 0; });
  std::int64_t added = 0;
  for (std::int64_t& chunk : chunks)
  {
    added += std::exchange(chunk, added);
  }
  Buffer<Index> ids = bufferIn<Index>(this->Options.Memory, std::size_t(mesh.PointEnd));
  result.IsUsed.assign(this->Points.size(), 0);
  result.AddedXY = bufferIn<double>(this->Options.Memory, 2 * std::size_t(added));
  this->forVertices(chunks,
    [&](std::int64_t& next, std::size_t vertex)
    {
      const Index origin = mesh.Origins[vertex];
      if (RefinementMesh::isInput(origin))
      {
        ids[vertex] = RefinementMesh::inputId(origin);
        result.IsUsed[std::size_t(ids[vertex])] = 1;
      }
      else if (isAdded(origin))
      {
        const auto i = std::size_t(next++);
        ids[vertex] = Index(given + std::int64_t(i));
        result.AddedXY[2 * i] = mesh.Points[vertex].x;
        result.AddedXY[2 * i + 1] = mesh.Points[vertex].y;
      }
    });
  return ids;
}

/// A triangle's shape.
struct TriangleShape
{
  explicit TriangleShape(const std::array<Point2, 3>& p)
    : Twice(cross(p[1] - p[0], p[2] - p[0]))
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Point2 edge = p[(i + 2) % 3] - p[(i + 1) % 3];
      this->Squares[i] = edge.x * edge.x + edge.y * edge.y;
    }
  }

  double shortest() const
  {
    return std::min(std::min(this->Squares[0], this->Squares[1]), this->Squares[2]);
  }
  double product() const { return this->Squares[0] * this->Squares[1] * this->Squares[2]; }
  /// The corner with the smallest angle, which is opposite to the shortest edge.
  int leastCorner() const
  {
    return int(
      std::min_element(this->Squares.begin(), this->Squares.end()) - this->Squares.begin());
  }
  /// The smallest angle in degrees.
  double leastAngle() const
  {
    const double product = this->product();
    const double square = product > 0 ? this->Twice * this->Twice * this->shortest() / product : 0;
    return degreesOf(std::sqrt(std::max(0.0, 1 - square)), std::sqrt(square));
  }

  double Twice;                  ///< the area
  std::array<double, 3> Squares; ///< of the lengths of the edges opposite to the corners
};

/// What a chunk of triangles contributes to the result.
struct ResultChunk
{
  std::int64_t Next = 0; ///< index of the next triangle
  std::vector<IdSegment> Segments;
  std::vector<TriangleOutside> Outside;
};

/// Sets the triangles, the segments, and the triangles that are not as asked.
void Refinement::addTriangles(const Buffer<Index>& ids, RefinedMesh& result) const
{
  std::vector<ResultChunk> chunks;
  this->forTriangles(chunks, [](ResultChunk& chunk, Index, const Triangle&) { ++chunk.Next; });
  std::int64_t count = 0;
  for (ResultChunk& chunk : chunks)
  {
    count += std::exchange(chunk.Next, count);
  }
  result.Triangles = bufferIn<std::int32_t>(this->Options.Memory, 3 * std::size_t(count));
  result.RegionOf = bufferIn<std::int32_t>(
    this->Options.Memory, this->Options.Regions.empty() ? 0 : std::size_t(count));
  this->forTriangles(chunks,
    [&](ResultChunk& chunk, Index, const Triangle& triangle)
    {
      const std::int64_t i = chunk.Next++;
      for (std::size_t c = 0; c < 3; ++c)
      {
        result.Triangles[3 * std::size_t(i) + c] = ids[std::size_t(triangle.Corner[c])];
      }
      if (!result.RegionOf.empty())
      {
        result.RegionOf[std::size_t(i)] = regionOf(triangle) - 1;
      }
      if (((triangle.Across[0] | triangle.Across[1] | triangle.Across[2]) &
            RefinementMesh::IsSegment) != 0)
      {
        this->addSegments(triangle, ids, chunk.Segments);
      }
      this->judgeResult(i, triangle, chunk.Outside);
    });
  for (const ResultChunk& chunk : chunks)
  {
    append(chunk.Segments, result.Segments);
    append(chunk.Outside, result.Outside);
  }
  std::stable_sort(result.Segments.begin(), result.Segments.end(),
    [](const IdSegment& a, const IdSegment& b) { return a.Constraint < b.Constraint; });
}

/// Appends the subsegments of a triangle, one that two triangles share for one of them.
void Refinement::addSegments(
  const Triangle& triangle, const Buffer<Index>& ids, std::vector<IdSegment>& segments) const
{
  for (int c = 0; c < 3; ++c)
  {
    const RefinementMesh::Link link = triangle.Across[std::size_t(c)];
    const Index a = triangle.Corner[std::size_t(RefinementMesh::next(c))];
    const Index b = triangle.Corner[std::size_t(RefinementMesh::previous(c))];
    const Index idA = ids[std::size_t(a)];
    const Index idB = ids[std::size_t(b)];
    if (RefinementMesh::isSegment(link) && (link == RefinementMesh::Outside || idA < idB))
    {
      const Index segment = this->Mesh.segmentOf(a, b);
      segments.push_back({ idA, idB, this->Mesh.Segments[std::size_t(segment)].Constraint });
    }
  }
}

/// Appends triangle i of the result to the list if it is not as asked.
void Refinement::judgeResult(
  std::int64_t i, const Triangle& triangle, std::vector<TriangleOutside>& outside) const
{
  const std::array<Point2, 3> p = this->Mesh.cornersOf(triangle);
  const TriangleShape shape(p);
  const double own = shape.Twice * shape.Twice * shape.shortest();
  const bool isThin = own < this->LeastSineSquared * shape.product() ||
    (own == 0 && this->LeastSineSquared > 0); // an underflow, as for a needle
  if (!isThin && shape.Twice <= 2 * this->Rules.LeastArea)
  {
    return;
  }
  if (isThin || shape.Twice > 2 * this->Rules.areaLimit(p, regionOf(triangle)))
  {
    outside.push_back({ i, shape.leastAngle(), shape.Twice / 2,
      this->reasonFor(triangle, isThin, shape.leastCorner()) });
  }
}

TriangleOutside::Reason Refinement::reasonFor(
  const Triangle& triangle, bool isThin, int leastCorner) const
{
  using Reason = TriangleOutside::Reason;
  if (isThin && this->Rules.isForced(this->Mesh, triangle, leastCorner))
  {
    return Reason::InputAngle;
  }
  if (this->StoppedEarly && (triangle.State & RefinementMesh::IsGivenUp) == 0)
  {
    return Reason::MostPoints;
  }
  return this->Options.KeepsBorder || this->Options.KeepsSegments ? Reason::KeptSegments
                                                                  : Reason::ShortestEdge;
}

RefinedMesh Refinement::result()
{
  RefinedMesh result;
  this->addTriangles(this->addPoints(result), result);
  for (const auto& refiner : this->Refiners)
  {
    if (refiner)
    {
      this->Statistics.Splits += refiner->counts().Splits;
      this->Statistics.Inserted += refiner->counts().Inserted;
      this->Statistics.GivenUp += refiner->counts().GivenUp;
    }
  }
  result.Statistics = this->Statistics;
  return result;
}

} // namespace

RefinedMesh refine(PointsView points, const ConstrainedTriangulation& triangulation,
  const RefinementOptions& options)
{
  Refinement refinement(points, triangulation, options);
  if (!refinement.run())
  {
    RefinedMesh aborted;
    aborted.Aborted = true;
    return aborted;
  }
  return refinement.result();
}

} // namespace tipp
