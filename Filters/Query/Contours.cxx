// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Queries.h"

#include "Files/IOError.h"
#include "Predicates/ExactPredicates.h"
#include "Query/RankAnswer.h"
#include "Resident/ForPieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// The bytes of a segment, and of the structures that join it to a line.
constexpr std::uint64_t bytesOfSegment = 160;

/// An edge as global ids of its points, ascending.
using Edge = std::array<std::int64_t, 2>;

/// The part of a contour line in one triangle.
struct Segment
{
  std::int32_t Level; ///< index of the level
  Edge From;
  Edge To;
  Point3 Begin;
  Point3 End;

  bool operator<(const Segment& other) const
  {
    return std::tie(this->Level, this->From, this->To) <
      std::tie(other.Level, other.From, other.To);
  }
};

struct Corner
{
  std::int64_t Id;
  Point3 Position;
  double Value;
};

/// The point on an edge where the values cross the level. Both triangles of the edge get the same
/// bits.
Point3 crossing(Corner a, Corner b, double level)
{
  if (b.Id < a.Id)
  {
    std::swap(a, b);
  }
  return between(a.Position, b.Position, (level - a.Value) / (b.Value - a.Value));
}

Edge edgeOf(const Corner& a, const Corner& b)
{
  return { std::min(a.Id, b.Id), std::max(a.Id, b.Id) };
}

/// A level's value and index.
using Level = std::pair<double, std::int32_t>;

/// Adds the segments of one triangle for the levels [level, end) that are not above `high`. Its
/// corners are counter-clockwise.
void addSegments(const Corner (&corners)[3], const Level* level, const Level* end, double high,
  std::vector<Segment>& segments)
{
  for (; level != end && level->first <= high; ++level)
  {
    // The corner that is the only one on its side of the level.
    bool above[3];
    std::transform(corners, corners + 3, above,
      [&](const Corner& corner) { return corner.Value >= level->first; });
    const int alone = above[0] == above[1] ? 2 : above[0] == above[2] ? 1 : 0;
    const Corner& a = corners[alone];
    const Corner& b = corners[(alone + 1) % 3];
    const Corner& c = corners[(alone + 2) % 3];
    Segment segment{ level->second, edgeOf(a, b), edgeOf(c, a), crossing(a, b, level->first),
      crossing(c, a, level->first) };
    if (!above[alone])
    {
      std::swap(segment.From, segment.To);
      std::swap(segment.Begin, segment.End);
    }
    segments.push_back(segment);
  }
}

/// The values of one component of an array at all points of a part, as doubles: the array's own, or
/// copies in `copied`.
const double* valuesAtPoints(
  const MeshPart& part, const PartValues& values, int component, std::vector<double>& copied)
{
  if (values.doubles())
  {
    return values.doubles();
  }
  copied.reserve(std::size_t(part.Mesh.PointCount));
  for (std::int64_t point = 0; point < part.Mesh.PointCount; ++point)
  {
    copied.push_back(values.atPoint(point, component));
  }
  return copied.data();
}

template <typename Access>
void addCells(const Access& access, const MeshPart& part, const double* values,
  const std::vector<Level>& levels, std::int64_t begin, std::int64_t end,
  std::vector<Segment>& segments)
{
  for (std::int64_t cell = begin; cell < end; ++cell)
  {
    Corner corners[3];
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    bool isUsable = !part.isHidden(cell);
    for (int i = 0; i < 3; ++i)
    {
      const auto point = std::int64_t(access.ids(cell)[i]);
      corners[i].Value = values[point];
      corners[i].Id = point;
      low = std::min(low, corners[i].Value);
      high = std::max(high, corners[i].Value);
      isUsable = isUsable && std::isfinite(corners[i].Value);
    }
    const Level* const last = levels.data() + levels.size();
    const Level* const first = std::upper_bound(
      levels.data(), last, low, [](double value, const Level& l) { return value < l.first; });
    if (!isUsable || first == last || first->first > high)
    {
      continue;
    }
    for (Corner& corner : corners)
    {
      corner.Position = access.point(corner.Id);
      corner.Id = part.pointId(corner.Id);
    }
    if (orientation(projected<2>(corners[0].Position), projected<2>(corners[1].Position),
          projected<2>(corners[2].Position)) < 0)
    {
      std::swap(corners[1], corners[2]);
    }
    addSegments(corners, first, last, high, segments);
  }
}

/// Joins segments to lines: first open lines, from their start, then closed lines, from their
/// lowest edge.
class LineJoiner
{
public:
  explicit LineJoiner(std::vector<Segment> segments)
    : Segments(std::move(segments))
    , IsUsed(Segments.size())
    , HasBefore(Segments.size())
  {
    std::sort(this->Segments.begin(), this->Segments.end());
    this->Next.reserve(this->Segments.size());
    for (const Segment& segment : this->Segments)
    {
      const std::size_t next = this->after(segment);
      this->Next.push_back(next);
      if (next < this->Segments.size())
      {
        this->HasBefore[next] = 1;
      }
    }
  }

  Contours join(const std::vector<double>& levels)
  {
    Contours lines;
    for (std::size_t begin = 0; begin < this->Segments.size();)
    {
      std::size_t end = begin;
      while (
        end < this->Segments.size() && this->Segments[end].Level == this->Segments[begin].Level)
      {
        ++end;
      }
      for (const bool isOpen : { true, false })
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          if (!this->IsUsed[i] && (!isOpen || !this->HasBefore[i]))
          {
            this->follow(i, levels[std::size_t(this->Segments[i].Level)], lines);
          }
        }
      }
      begin = end;
    }
    return lines;
  }

private:
  /// The index of the segment that starts where this one ends, or the number of segments if there
  /// is none.
  std::size_t after(const Segment& segment) const
  {
    const Segment wanted{ segment.Level, segment.To, { -1, -1 }, {}, {} };
    const auto found = std::lower_bound(this->Segments.begin(), this->Segments.end(), wanted);
    return found != this->Segments.end() && found->Level == segment.Level &&
        found->From == segment.To
      ? std::size_t(found - this->Segments.begin())
      : this->Segments.size();
  }

  void follow(std::size_t first, double level, Contours& lines)
  {
    const std::size_t begin = lines.Points.size();
    lines.Points.push_back(this->Segments[first].Begin);
    for (std::size_t at = first; at < this->Segments.size() && !this->IsUsed[at];
         at = this->Next[at])
    {
      this->IsUsed[at] = 1;
      // If a point of the mesh has exactly the level's value, several edges are crossed there.
      if (!(lines.Points.back() == this->Segments[at].End))
      {
        lines.Points.push_back(this->Segments[at].End);
      }
    }
    if (lines.Points.size() < begin + 2)
    {
      lines.Points.resize(begin);
      return;
    }
    lines.Starts.push_back(std::int64_t(lines.Points.size()));
    lines.Levels.push_back(level);
  }

  std::vector<Segment> Segments;
  std::vector<std::size_t> Next;
  std::vector<char> IsUsed;
  std::vector<char> HasBefore;
};

/// Segments, with a note of their memory: pieces leave space for it.
struct Segments
{
  std::vector<Segment> All;
  std::vector<ResidentPieces::Share> Notes;
};

/// The segments in the cells that this rank's pieces own, in any order.
Segments segmentsIn(const ResidentMesh& mesh, const std::string& array, int component,
  const std::vector<double>& levels, const Communicator* ranks)
{
  Segments segments;
  if (!canQuery(ranks, mesh))
  {
    return segments;
  }
  const StoredArray* const description = mesh.fieldOf(array, component);
  std::vector<Level> sorted;
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    if (!std::isfinite(levels[i]))
    {
      throw IOError("A level is not a finite number.");
    }
    sorted.emplace_back(levels[i], std::int32_t(i));
  }
  std::sort(sorted.begin(), sorted.end());
  // One vector for all would be copied as it grows, while pieces are in memory, too.
  std::vector<std::vector<Segment>> parts;
  std::mutex mutex;
  const std::pair<std::size_t, std::size_t> pieces = piecesOfRank(ranks, mesh);
  const bool isOne = pieces.second - pieces.first == 1;
  const int threads = threadCount(mesh.options().Threads);
  forPieceRange(mesh, pieces, mesh.needsOf({ array }), isOne ? 1 : threads,
    [&](const ResidentPiece& piece)
    {
      const MeshPart& part = *piece.Part;
      std::vector<double> copied;
      const double* const values =
        valuesAtPoints(part, PartValues(part, description), component, copied);
      forChunks(part.OwnedCells, 1 << 14, isOne ? threads : 1, {},
        [&](std::int64_t begin, std::int64_t end, int)
        {
          std::vector<Segment> own;
          withAccess(part.Mesh,
            [&](const auto& access) { addCells(access, part, values, sorted, begin, end, own); });
          own.shrink_to_fit();
          const std::lock_guard<std::mutex> lock(mutex);
          segments.Notes.push_back(mesh.pieces().note(own.size() * bytesOfSegment));
          parts.push_back(std::move(own));
        });
    });
  std::size_t count = 0;
  for (const std::vector<Segment>& part : parts)
  {
    count += part.size();
  }
  segments.All.reserve(count);
  for (std::vector<Segment>& part : parts)
  {
    segments.All.insert(segments.All.end(), part.begin(), part.end());
    part = {};
  }
  return segments;
}

} // namespace

std::pair<double, double> rangeOf(
  const ResidentMesh& mesh, const std::string& array, int component, Communicator* ranks)
{
  std::vector<double> range = { HUGE_VAL, HUGE_VAL }; // the lowest value, and minus the highest
  if (canQuery(ranks, mesh))
  {
    const StoredArray* const description = mesh.fieldOf(array, component);
    std::mutex mutex;
    forPieceRange(mesh, piecesOfRank(ranks, mesh), mesh.needsOf({ array }),
      threadCount(mesh.options().Threads),
      [&](const ResidentPiece& piece)
      {
        const PartValues values(*piece.Part, description);
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        for (std::int64_t point = 0; point < piece.Part->Mesh.PointCount; ++point)
        {
          const double value = values.atPoint(point, component);
          low = std::isfinite(value) ? std::min(low, value) : low;
          high = std::isfinite(value) ? std::max(high, value) : high;
        }
        const std::lock_guard<std::mutex> lock(mutex);
        range = { std::min(range[0], low), std::min(range[1], -high) };
      });
  }
  if (areSeveral(ranks))
  {
    ranks->minimum(range);
  }
  return { range[0], -range[1] };
}

Contours contoursOf(const ResidentMesh& mesh, const std::string& array, int component,
  const std::vector<double>& levels, Communicator* ranks)
{
  requireIds(ranks, mesh);
  Segments segments = segmentsIn(mesh, array, component, levels, ranks);
  std::vector<Segment>& all = segments.All;
  if (areSeveral(ranks))
  {
    Bytes own;
    if (!ranks->isFirst())
    {
      own = packed(all);
      all = {};
    }
    for (Bytes& message : ranks->gather(std::move(own)))
    {
      const Bytes content = std::move(message);
      const auto part =
        content.empty() ? std::vector<Segment>() : unpacked<std::vector<Segment>>(content);
      all.insert(all.end(), part.begin(), part.end());
    }
  }
  return LineJoiner(std::move(all)).join(levels);
}

} // namespace tipp
