// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/CrossedPart.h"

#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/ConstraintJobs.h"
#include "Constraints/PositionIndex.h"
#include "Constraints/SurfaceValues.h"
#include "Parallel/Sort.h"
#include "Triangulation/TriangleSink.h"

#include <numeric>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

/// Sorts items by key(item), and removes those whose key is repeated.
template <typename Item, typename Key>
void sortUniqueBy(std::vector<Item>& items, const Key& key)
{
  std::sort(
    items.begin(), items.end(), [&key](const Item& a, const Item& b) { return key(a) < key(b); });
  items.erase(std::unique(items.begin(), items.end(),
                [&key](const Item& a, const Item& b) { return key(a) == key(b); }),
    items.end());
}

/// Sorts the part's known segments and its touches, and removes repeated ones.
void removeRepeated(CrossedPart& part)
{
  sortUniqueBy(part.Known, [](const SegmentTree::Item& item) { return item.Id; });
  sortUniqueBy(part.Touches,
    [](const CrossedPart::Touch& touch) { return std::make_pair(touch.Segment, touch.Vertex); });
}

/// The item in part.Known of a segment, given by its Id. Call after removeRepeated().
const SegmentTree::Item& knownOf(const CrossedPart& part, std::int64_t segment)
{
  return *std::lower_bound(part.Known.begin(), part.Known.end(), segment,
    [](const SegmentTree::Item& item, std::int64_t id) { return item.Id < id; });
}

template <typename Item>
std::size_t indexIn(const std::vector<Item>& sorted, const Item& item)
{
  return std::size_t(std::lower_bound(sorted.begin(), sorted.end(), item) - sorted.begin());
}

/// The part's triangles and the segments that cross them, as indices in `segments`, which must
/// contain them all.
CrossedTriangles crossingsOf(const CrossedPart& part, const std::vector<std::int64_t>& segments)
{
  CrossedTriangles crossed;
  crossed.Triangles.resize(part.Triangles.size());
  std::iota(crossed.Triangles.begin(), crossed.Triangles.end(), std::int64_t(0));
  crossed.Starts.push_back(0);
  crossed.Starts.insert(crossed.Starts.end(), part.SegmentEnds.begin(), part.SegmentEnds.end());
  for (const std::int64_t segment : part.Segments)
  {
    crossed.Segments.push_back(std::int64_t(indexIn(segments, segment)));
  }
  return crossed;
}

void addTriangle(const CrossedPart& from, std::size_t t, CrossedPart& to)
{
  to.Triangles.push_back(from.Triangles[t]);
  to.Positions.push_back(from.Positions[t]);
  const auto segments = from.Segments.begin();
  to.Segments.insert(to.Segments.end(),
    segments + std::ptrdiff_t(t == 0 ? 0 : from.SegmentEnds[t - 1]),
    segments + std::ptrdiff_t(from.SegmentEnds[t]));
  to.SegmentEnds.push_back(to.Segments.size());
}

/// For each of `segments`, whether it is complete in the part. `crossed` is crossingsOf(part,
/// segments). A segment that crosses a triangle is followed from there to both ends. It leaves a
/// triangle across an edge, then the part must have the next triangle, or at a vertex, then the
/// part must have all triangles at this vertex.
std::vector<char> findComplete(const CrossedPart& part, const CrossedTriangles& crossed,
  const std::vector<std::int64_t>& segments, const std::function<bool(std::int64_t)>& isInner)
{
  // Indices of segments, and the lower and the higher end of an edge that each crosses.
  std::vector<std::array<std::int64_t, 3>> edges;
  for (std::size_t t = 0; t < part.Triangles.size(); ++t)
  {
    const std::int64_t* const end = crossed.begin(std::int64_t(t) + 1);
    for (const std::int64_t* s = crossed.begin(std::int64_t(t)); s != end; ++s)
    {
      const SegmentTree::Item& segment = knownOf(part, segments[std::size_t(*s)]);
      std::array<int, 3> side;
      std::transform(part.Positions[t].begin(), part.Positions[t].end(), side.begin(),
        [&](Point2 p) { return orientation(segment.A, segment.B, p); });
      for (std::size_t i = 0; i < 3; ++i)
      {
        if (side[i] * side[(i + 1) % 3] < 0)
        {
          const auto [low, high] =
            std::minmax(part.Triangles[t][i], part.Triangles[t][(i + 1) % 3]);
          edges.push_back({ *s, low, high });
        }
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<char> isComplete(segments.size(), 1);
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    if (i + 1 < edges.size() && edges[i] == edges[i + 1])
    {
      ++i;
      continue; // both triangles at the edge are there
    }
    isComplete[std::size_t(edges[i][0])] = 0;
  }
  for (const CrossedPart::Touch& touch : part.Touches)
  {
    const std::size_t s = indexIn(segments, touch.Segment);
    if (s < segments.size() && segments[s] == touch.Segment && !isInner(touch.Vertex))
    {
      isComplete[s] = 0;
    }
  }
  return isComplete;
}

/// The vertices of a part. First those with numbers, sorted by these; then ends of segments that
/// are not vertices of the part.
struct PartVertices
{
  std::vector<std::int64_t> Numbers;
  std::vector<Point2> Positions;

  explicit PartVertices(const CrossedPart& part)
  {
    std::vector<std::pair<std::int64_t, Point2>> vertices;
    for (std::size_t t = 0; t < part.Triangles.size(); ++t)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        vertices.emplace_back(part.Triangles[t][i], part.Positions[t][i]);
      }
    }
    for (const CrossedPart::Touch& touch : part.Touches)
    {
      vertices.emplace_back(touch.Vertex, touch.Position);
    }
    sortUniqueBy(vertices, [](const auto& vertex) { return vertex.first; });
    for (const auto& [number, position] : vertices)
    {
      this->Numbers.push_back(number);
      this->Positions.push_back(position);
    }
    this->Index.emplace(this->Positions);
  }

  bool has(std::int64_t number) const
  {
    return std::binary_search(this->Numbers.begin(), this->Numbers.end(), number);
  }

  PointId indexOf(std::int64_t number) const { return PointId(indexIn(this->Numbers, number)); }

  /// The index of the vertex at this position. A new index is added if there is none.
  PointId indexAt(Point2 position)
  {
    const std::int64_t known = this->Index->find(position);
    if (known >= 0)
    {
      return PointId(known);
    }
    this->Positions.push_back(position);
    return PointId(this->Positions.size() - 1);
  }

private:
  std::optional<PositionIndex> Index; ///< of the vertices with numbers
};

} // namespace

void append(CrossedPart&& from, CrossedPart& to)
{
  const std::uint64_t before = to.Segments.size();
  const auto addAll = [](auto& target, const auto& source)
  { target.insert(target.end(), source.begin(), source.end()); };
  addAll(to.Triangles, from.Triangles);
  addAll(to.Positions, from.Positions);
  addAll(to.Segments, from.Segments);
  addAll(to.Known, from.Known);
  std::transform(from.SegmentEnds.begin(), from.SegmentEnds.end(),
    std::back_inserter(to.SegmentEnds), [before](std::uint64_t end) { return before + end; });
  addAll(to.FixedEdges, from.FixedEdges);
  addAll(to.Touches, from.Touches);
}

template <typename Id>
std::size_t moveCrossed(PointsView points, const ConstraintSegments& segments, std::int64_t first,
  const std::vector<CrossedTriangles::Crossing>& crossings, Id* corners, std::size_t triangles,
  CrossedPart& part)
{
  std::vector<std::int64_t> used;
  std::size_t kept = 0;
  std::size_t next = 0; // the first triangle that has not been moved yet
  const auto keepUntil = [&](std::size_t end)
  {
    if (kept < next)
    {
      std::copy(corners + 3 * next, corners + 3 * end, corners + 3 * kept);
    }
    kept += end - next;
  };
  for (auto crossing = crossings.begin(); crossing != crossings.end();)
  {
    const auto t = std::size_t(crossing->Triangle);
    keepUntil(t);
    next = t + 1;
    const Id* const ids = corners + 3 * t;
    part.Triangles.push_back({ first + ids[0], first + ids[1], first + ids[2] });
    part.Positions.push_back(cornersOf(points, corners, t));
    for (; crossing != crossings.end() && crossing->Triangle == std::int64_t(t); ++crossing)
    {
      used.push_back(crossing->Segment);
      part.Segments.push_back(segments.nameOf(crossing->Segment));
    }
    part.SegmentEnds.push_back(part.Segments.size());
  }
  keepUntil(triangles);
  sortUnique(used);
  for (const std::int64_t segment : used)
  {
    const SegmentTree::Item& item = segments.at(segment);
    part.Known.push_back({ item.A, item.B, segments.nameOf(segment) });
  }
  return kept;
}

template <typename Id>
std::size_t takeCrossed(PointsView points, const ConstraintSegments& segments, std::int64_t first,
  Id* corners, std::size_t triangles, CrossedPart& part)
{
  TriangleScan<Id> scan(points, segments.tree());
  ScannedTriangles found;
  for (std::size_t begin = 0; begin < triangles; begin += scan.MostTriangles)
  {
    const auto before = std::ptrdiff_t(found.Crossings.size());
    scan.scan(corners, begin, std::min(begin + scan.MostTriangles, triangles), found);
    std::sort(found.Crossings.begin() + before, found.Crossings.end());
  }
  for (const ScannedTriangles::Edge& edge : found.Edges) // before triangles are moved
  {
    const Id* const ids = corners + 3 * edge.Triangle;
    part.FixedEdges.push_back({ first + ids[edge.From], first + ids[(edge.From + 1) % 3] });
  }
  for (const CrossedTriangles::Touch& touch : found.Touches)
  {
    part.Touches.push_back(
      { segments.nameOf(touch.Segment), first + touch.Vertex, points[std::size_t(touch.Vertex)] });
  }
  return moveCrossed(points, segments, first, found.Crossings, corners, triangles, part);
}

CrossedPart splitIncomplete(CrossedPart& part, const std::function<bool(std::int64_t)>& isInner)
{
  removeRepeated(part);
  const std::vector<std::int64_t> used = sortedUnique(part.Segments);
  const CrossedTriangles crossed = crossingsOf(part, used);
  const std::vector<char> isComplete = findComplete(part, crossed, used, isInner);
  const std::vector<std::int64_t> jobs = jobsOfTriangles(crossed);
  std::vector<char> isLeft(used.size(), 0); // per job
  for (std::size_t t = 0; t < jobs.size(); ++t)
  {
    isLeft[std::size_t(jobs[t])] |=
      char(std::any_of(crossed.begin(std::int64_t(t)), crossed.begin(std::int64_t(t) + 1),
        [&](std::int64_t segment) { return !isComplete[std::size_t(segment)]; }));
  }
  CrossedPart whole;
  CrossedPart rest;
  for (std::size_t t = 0; t < jobs.size(); ++t)
  {
    addTriangle(part, t, isLeft[std::size_t(jobs[t])] ? rest : whole);
  }
  std::vector<std::int64_t> vertices;
  for (const CrossedPart::Corners& triangle : rest.Triangles)
  {
    vertices.insert(vertices.end(), triangle.begin(), triangle.end());
  }
  sortUnique(vertices);
  const auto isOfRest = [&](std::int64_t vertex)
  { return std::binary_search(vertices.begin(), vertices.end(), vertex); };
  std::copy_if(part.FixedEdges.begin(), part.FixedEdges.end(), std::back_inserter(rest.FixedEdges),
    [&](const auto& edge) { return isOfRest(edge[0]) && isOfRest(edge[1]); });
  // A segment that crosses no triangle of the remaining part may cross triangles of other parts.
  const std::vector<std::int64_t> done = sortedUnique(whole.Segments);
  std::copy_if(part.Touches.begin(), part.Touches.end(), std::back_inserter(rest.Touches),
    [&](const CrossedPart::Touch& touch)
    { return !std::binary_search(done.begin(), done.end(), touch.Segment); });
  for (const std::int64_t segment : sortedUnique(rest.Segments))
  {
    rest.Known.push_back(knownOf(part, segment));
  }
  whole.Known = std::move(part.Known);
  whole.FixedEdges = std::move(part.FixedEdges);
  whole.Touches = std::move(part.Touches);
  part = std::move(whole);
  return rest;
}

void retriangulate(CrossedPart& part, int threads)
{
  if (part.Triangles.empty())
  {
    return;
  }
  const std::vector<std::int64_t> used = sortedUnique(part.Segments);
  CrossedTriangles crossed = crossingsOf(part, used);
  removeRepeated(part);
  PartVertices vertices(part);
  for (const CrossedPart::Touch& touch : part.Touches)
  {
    const std::size_t index = indexIn(used, touch.Segment);
    if (index < used.size() && used[index] == touch.Segment)
    {
      crossed.Touches.push_back({ std::int64_t(index), vertices.indexOf(touch.Vertex) });
    }
  }
  std::vector<IdSegment> known;
  for (const auto& edge : part.FixedEdges)
  {
    if (vertices.has(edge[0]) && vertices.has(edge[1])) // others were moved to the rest
    {
      known.push_back({ vertices.indexOf(edge[0]), vertices.indexOf(edge[1]), 0 });
    }
  }
  std::vector<std::int64_t> corners;
  for (const CrossedPart::Corners& triangle : part.Triangles)
  {
    std::transform(triangle.begin(), triangle.end(), std::back_inserter(corners),
      [&](std::int64_t number) { return vertices.indexOf(number); });
  }
  std::vector<IdSegment> idSegments;
  for (std::size_t i = 0; i < used.size(); ++i)
  {
    const SegmentTree::Item& segment = knownOf(part, used[i]);
    const PointId a = vertices.indexAt(segment.A);
    idSegments.push_back({ a, vertices.indexAt(segment.B), std::int64_t(i) });
  }
  const PointsView view(vertices.Positions);
  const SplitSegments split = splitSegments(view, idSegments, crossed.Touches);
  retriangulateJobs(view, corners.data(), crossed, split, ConstraintEdges(known), threads);
  for (std::size_t t = 0; t < part.Triangles.size(); ++t)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto index = std::size_t(corners[3 * t + i]);
      part.Triangles[t][i] = vertices.Numbers[index];
      part.Positions[t][i] = vertices.Positions[index];
    }
  }
}

template <typename Id>
std::vector<ScannedTriangles::Edge> edgesOnSegments(
  PointsView points, const ConstraintSegments& segments, const Id* corners, std::size_t triangles)
{
  using Scan = TriangleScan<Id>;
  Scan scan(points, segments.tree(), Scan::NotedEdges::OfAll);
  ScannedTriangles found;
  for (std::size_t begin = 0; begin < triangles; begin += Scan::MostTriangles)
  {
    scan.scan(corners, begin, std::min(begin + Scan::MostTriangles, triangles), found);
  }
  return std::move(found.Edges);
}

template <typename Id>
void markEdges(PointsView points, const ConstraintSegments& segments, const Id* corners,
  std::size_t triangles, std::uint8_t* marks)
{
  std::fill_n(marks, 3 * triangles, std::uint8_t(0));
  for (const ScannedTriangles::Edge& edge : edgesOnSegments(points, segments, corners, triangles))
  {
    marks[3 * std::size_t(edge.Triangle) + (edge.From + 2) % 3] = 1;
  }
}

template <typename Id>
std::size_t cutTriangles(
  PointsView points, const ConstraintSegments& segments, Id* corners, std::size_t triangles)
{
  constexpr std::size_t most = TriangleScan<Id>::MostTriangles;
  std::vector<char> isKept(triangles, 0);
  for (std::size_t begin = 0; begin < triangles; begin += most)
  {
    const std::size_t end = std::min(begin + most, triangles);
    Box2 box = Box2::empty();
    for (std::size_t t = begin; t < end; ++t)
    {
      for (const Point2 p : cornersOf(points, corners, t))
      {
        box.extend(p);
      }
    }
    const bool isUncut = segments.isUncut(box);
    for (std::size_t t = begin; t < end; ++t)
    {
      isKept[t] =
        isUncut && t > begin ? isKept[begin] : char(segments.keeps(cornersOf(points, corners, t)));
    }
  }
  return keepTriangles(corners, triangles, [&](std::size_t t) { return isKept[t] != 0; });
}

template std::size_t moveCrossed(PointsView, const ConstraintSegments&, std::int64_t,
  const std::vector<CrossedTriangles::Crossing>&, std::int32_t*, std::size_t, CrossedPart&);
template std::size_t takeCrossed(
  PointsView, const ConstraintSegments&, std::int64_t, std::int32_t*, std::size_t, CrossedPart&);
template std::size_t takeCrossed(
  PointsView, const ConstraintSegments&, std::int64_t, std::int64_t*, std::size_t, CrossedPart&);
template std::vector<ScannedTriangles::Edge> edgesOnSegments(
  PointsView, const ConstraintSegments&, const std::int32_t*, std::size_t);
template std::vector<ScannedTriangles::Edge> edgesOnSegments(
  PointsView, const ConstraintSegments&, const std::int64_t*, std::size_t);
template void markEdges(
  PointsView, const ConstraintSegments&, const std::int32_t*, std::size_t, std::uint8_t*);
template void markEdges(
  PointsView, const ConstraintSegments&, const std::int64_t*, std::size_t, std::uint8_t*);
template std::size_t cutTriangles(
  PointsView, const ConstraintSegments&, std::int32_t*, std::size_t);
template std::size_t cutTriangles(
  PointsView, const ConstraintSegments&, std::int64_t*, std::size_t);

} // namespace tipp
