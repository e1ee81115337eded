// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Queries.h"

#include "Files/IOError.h"
#include "Parallel/Sort.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/ExactPredicates3.h"
#include "Predicates/Vectors.h"
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

/// A point where a segment crosses an edge of triangles, or a face of tetrahedra.
struct Crossing
{
  double Share; ///< fraction of the segment's length
  /// Ascending global ids of the points of the crossed face, edge or point. If there are fewer than
  /// three, the last is repeated.
  std::array<std::int64_t, 3> Ids;
  Point3 Position;            ///< z is 0 for triangles
  std::vector<double> Values; ///< all components of each point array

  bool operator<(const Crossing& other) const
  {
    return std::tie(this->Share, this->Ids) < std::tie(other.Share, other.Ids);
  }
  bool operator==(const Crossing& other) const { return this->Ids == other.Ids; }
};

template <typename Archive>
void serialize(Archive& archive, Crossing& crossing)
{
  archive(crossing.Share, crossing.Ids, crossing.Position, crossing.Values);
}

/// The crossings of each segment of a polyline.
using CrossingLists = std::vector<std::vector<Crossing>>;

/// A corner of a cell.
struct CellCorner
{
  std::int64_t Index; ///< local index in the piece
  std::int64_t Id;    ///< global id
  Point3 Position;
};

/// Finds where one segment crosses the cells of a piece. Crossings at its ends may be left out.
class SegmentCrossings
{
public:
  SegmentCrossings(const Point3& begin, const Point3& end, const std::vector<PartValues>& values,
    std::vector<Crossing>& crossings)
    : Begin(begin)
    , End(end)
    , Along(end - begin)
    , Values(values)
    , Crossings(crossings)
  {
  }

  void addCell(const CellCorner (&corners)[3])
  {
    int sides[3];
    for (int i = 0; i < 3; ++i)
    {
      sides[i] = orientation(
        projected<2>(this->Begin), projected<2>(this->End), projected<2>(corners[i].Position));
    }
    for (int i = 0; i < 3; ++i)
    {
      const CellCorner& a = corners[i];
      const CellCorner& b = corners[(i + 1) % 3];
      if (sides[i] == 0 && this->meetsBox(&corners[i], 1))
      {
        this->addPoint(a);
      }
      if (sides[i] * sides[(i + 1) % 3] < 0 &&
        orientation(projected<2>(a.Position), projected<2>(b.Position), projected<2>(this->Begin)) *
            orientation(
              projected<2>(a.Position), projected<2>(b.Position), projected<2>(this->End)) <
          0)
      {
        this->addEdge(a, b);
      }
    }
  }

  /// If the segment is in the plane of a face, its crossings with the face's edges are found in the
  /// cell's other faces.
  void addCell(const CellCorner (&corners)[4])
  {
    for (int face = 0; face < 4; ++face)
    {
      const CellCorner& a = corners[(face + 1) % 4];
      const CellCorner& b = corners[(face + 2) % 4];
      const CellCorner& c = corners[(face + 3) % 4];
      if (orientation3(a.Position, b.Position, c.Position, this->Begin) *
          orientation3(a.Position, b.Position, c.Position, this->End) <
        0)
      {
        this->addFace(a, b, c);
      }
    }
  }

  bool meetsBox(const CellCorner* corners, int count) const
  {
    for (double Point3::*const axis : { &Point3::x, &Point3::y, &Point3::z })
    {
      double low = HUGE_VAL;
      double high = -HUGE_VAL;
      for (int i = 0; i < count; ++i)
      {
        if (!std::isfinite(corners[i].Position.*axis))
        {
          return false;
        }
        low = std::min(low, corners[i].Position.*axis);
        high = std::max(high, corners[i].Position.*axis);
      }
      if (low > std::max(this->Begin.*axis, this->End.*axis) ||
        high < std::min(this->Begin.*axis, this->End.*axis))
      {
        return false;
      }
    }
    return true;
  }

private:
  double shareOf(const Point3& p) const
  {
    return std::clamp(dot(p - this->Begin, this->Along) / dot(this->Along, this->Along), 0.0, 1.0);
  }

  void addPoint(const CellCorner& point)
  {
    const double one = 1;
    this->add(point.Position, &point, &one, 1);
  }

  /// The position is weighted by the distances of the edge's ends from the line, in doubles. All
  /// cells at the edge compute the same bits.
  void addEdge(CellCorner a, CellCorner b)
  {
    if (b.Id < a.Id)
    {
      std::swap(a, b);
    }
    const Point3 ofA = cross(this->Along, a.Position - this->Begin);
    const Point3 ofB = cross(this->Along, b.Position - this->Begin);
    const double distanceA = std::sqrt(dot(ofA, ofA));
    const double distanceB = std::sqrt(dot(ofB, ofB));
    const double sum = distanceA + distanceB;
    const double share = sum > 0 ? distanceA / sum : 0.5;
    const CellCorner ends[2] = { a, b };
    const double weights[2] = { 1 - share, share };
    this->add(between(a.Position, b.Position, share), ends, weights, 2);
  }

  /// The ends of the segment are on different sides of the face's plane.
  void addFace(CellCorner a, CellCorner b, CellCorner c)
  {
    if (b.Id < a.Id)
    {
      std::swap(a, b);
    }
    if (c.Id < b.Id)
    {
      std::swap(b, c);
    }
    if (b.Id < a.Id)
    {
      std::swap(a, b);
    }
    const int ofA = orientation3(this->Begin, this->End, b.Position, c.Position);
    const int ofB = orientation3(this->Begin, this->End, c.Position, a.Position);
    const int ofC = orientation3(this->Begin, this->End, a.Position, b.Position);
    const auto [low, high] = std::minmax({ ofA, ofB, ofC });
    if (low < 0 && high > 0)
    {
      return; // the segment passes beside the face
    }
    const int zeros = (ofA == 0) + (ofB == 0) + (ofC == 0);
    if (zeros == 2)
    {
      this->addPoint(ofA != 0 ? a : ofB != 0 ? b : c);
    }
    else if (zeros == 1)
    {
      this->addEdge(ofA == 0 ? b : a, ofC == 0 ? b : c);
    }
    else if (zeros == 0)
    {
      const CellCorner corners[3] = { a, b, c };
      double weights[3];
      for (int i = 0; i < 3; ++i)
      {
        weights[i] = std::fabs(dot(this->Along,
          cross(corners[(i + 1) % 3].Position - this->Begin,
            corners[(i + 2) % 3].Position - this->Begin)));
      }
      const double sum = weights[0] + weights[1] + weights[2];
      Point3 at{ 0, 0, 0 };
      for (int i = 0; i < 3; ++i)
      {
        weights[i] = sum > 0 ? weights[i] / sum : 1.0 / 3;
        at.x += weights[i] * corners[i].Position.x;
        at.y += weights[i] * corners[i].Position.y;
        at.z += weights[i] * corners[i].Position.z;
      }
      this->add(at, corners, weights, 3);
    }
  }

  /// Adds a crossing. `corners`: the corners of the crossed face, edge or point, by ascending ids.
  void add(const Point3& at, const CellCorner* corners, const double* weights, int count)
  {
    Crossing crossing{ this->shareOf(at),
      { corners[0].Id, corners[std::min(1, count - 1)].Id, corners[count - 1].Id }, at, {} };
    for (const PartValues& values : this->Values)
    {
      for (int k = 0; values.description().OfPoints && k < values.description().Components; ++k)
      {
        const double first = values.atPoint(corners[0].Index, k);
        double value = first;
        for (int i = 1; i < count; ++i)
        {
          value += weights[i] * (values.atPoint(corners[i].Index, k) - first);
        }
        crossing.Values.push_back(value);
      }
    }
    this->Crossings.push_back(std::move(crossing));
  }

  const Point3& Begin;
  const Point3& End;
  const Point3 Along;
  const std::vector<PartValues>& Values;
  std::vector<Crossing>& Crossings;
};

template <typename Access>
void addCells(const Access& access, const MeshPart& part, SegmentCrossings& crossings)
{
  constexpr int corners = Access::Corners;
  // Includes borrowed cells, since only in this piece's box may they meet the segment.
  for (std::int64_t cell = 0; cell < part.Mesh.Cells; ++cell)
  {
    if (part.isHidden(cell))
    {
      continue;
    }
    CellCorner of[corners];
    for (int i = 0; i < corners; ++i)
    {
      of[i].Index = access.ids(cell)[i];
      of[i].Position = access.point(of[i].Index);
      of[i].Position.z = corners == 4 ? of[i].Position.z : 0;
    }
    if (crossings.meetsBox(of, corners))
    {
      std::for_each(of, of + corners, [&part](CellCorner& c) { c.Id = part.pointId(c.Index); });
      crossings.addCell(of);
    }
  }
}

/// For each segment of a polyline, its crossings with the cells of the pieces [first, end): in the
/// segment's direction, each once, and decided exactly. Crossings at the ends of a segment may be
/// left out. Results do not depend on pieces and threads. Throws IOError and WorkAborted.
CrossingLists crossingsIn(const ResidentMesh& mesh, const std::vector<Point3>& polyline,
  const std::vector<std::string>& arrays, std::size_t first, std::size_t end)
{
  CrossingLists result(polyline.empty() ? 0 : polyline.size() - 1);
  std::mutex mutex;
  const auto pieces = std::int64_t(end - first);
  forChunks(pieces, 1, pieces > 1 ? threadCount(mesh.options().Threads) : 1, {},
    [&](std::int64_t i, std::int64_t, int)
    {
      poll();
      const std::size_t number = first + std::size_t(i);
      std::vector<std::size_t> met;
      const bool inSpace = mesh.mesh().CellSize == 4;
      const Box3 box = boundedBox(mesh.mesh().Pieces[number].Box, inSpace ? 3 : 2);
      for (std::size_t s = 0; s < result.size(); ++s)
      {
        const Point3& from = polyline[s];
        const Point3& to = polyline[s + 1];
        const bool isMet = !mesh.isStored() ||
          (inSpace ? tetrahedronMeetsBox(from, to, to, to, box)
                   : triangleMeetsBox(projected<2>(from), projected<2>(to), projected<2>(to), box));
        if (isMet)
        {
          met.push_back(s);
        }
      }
      if (met.empty())
      {
        return;
      }
      const ResidentPieces::Lease piece = mesh.pieces().get(number, mesh.needsOf(arrays));
      const MeshPart& part = *piece->Part;
      std::vector<PartValues> values;
      values.reserve(arrays.size());
      for (const std::string& name : arrays)
      {
        values.emplace_back(part, mesh.find(name));
      }
      for (const std::size_t s : met)
      {
        std::vector<Crossing> own;
        SegmentCrossings crossings(polyline[s], polyline[s + 1], values, own);
        withAccess(part.Mesh, [&](const auto& access) { addCells(access, part, crossings); });
        const std::lock_guard<std::mutex> lock(mutex);
        result[s].insert(result[s].end(), own.begin(), own.end());
      }
    });
  std::for_each(result.begin(), result.end(), sortUnique<Crossing>);
  return result;
}

double distance(const Point3& a, const Point3& b)
{
  return a.z == b.z ? std::hypot(b.x - a.x, b.y - a.y)
                    : std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
}

void addSamples(const Point3& a, const Point3& b, double before, double spacing, Profile& profile)
{
  const double length = distance(a, b);
  // The multiples of the spacing inside the segment.
  for (auto i = std::int64_t(std::floor(before / spacing)) + 1;
       double(i) * spacing < before + length; ++i)
  {
    const double along = double(i) * spacing - before;
    const double share = along / length;
    profile.Distances.push_back(double(i) * spacing);
    profile.Points.push_back(between(a, b, share));
  }
}

void requirePolyline(const std::vector<Point3>& polyline, double spacing)
{
  double length = 0;
  for (std::size_t i = 0; i < polyline.size(); ++i)
  {
    if (!isFinite(polyline[i]))
    {
      throw IOError("Point " + std::to_string(i) + " of the polyline is not finite.");
    }
    length += i > 0 ? distance(polyline[i - 1], polyline[i]) : 0;
  }
  constexpr double most = 1e9;
  if (!(spacing >= 0) || (spacing > 0 && !(length / spacing < most)))
  {
    throw IOError("The spacing of the profile, " + std::to_string(spacing) +
      ", is negative or would give more than 1e9 samples; give a larger one, or 0 for all "
      "crossings.");
  }
}

/// The crossings of a polyline with the meshes of all ranks.
CrossingLists crossingsOf(const ResidentMesh& mesh, const std::vector<Point3>& own,
  const std::vector<std::string>& arrays, Communicator* ranks)
{
  const auto [first, end] = piecesOfRank(ranks, mesh);
  if (!ranks)
  {
    return crossingsIn(mesh, own, arrays, first, end);
  }
  std::vector<CrossingLists> replies;
  for (const std::vector<Point3>& corners : ranks->allGather(own))
  {
    replies.push_back(
      canQuery(ranks, mesh) ? crossingsIn(mesh, corners, arrays, first, end) : CrossingLists());
  }
  CrossingLists result(own.size());
  for (const CrossingLists& part : ranks->allToAll(replies))
  {
    for (std::size_t i = 0; i < part.size(); ++i)
    {
      result[i].insert(result[i].end(), part[i].begin(), part[i].end());
    }
  }
  std::for_each(result.begin(), result.end(), sortUnique<Crossing>);
  return result;
}

} // namespace

Profile profileOf(const ResidentMesh& mesh, const std::vector<Point3>& given, double spacing,
  const std::vector<std::string>& arrays, Communicator* ranks)
{
  requireIds(ranks, mesh);
  const bool inSpace = RankParts(ranks, mesh, arrays).Common.CellSize == 4;
  AnswerOptions options;
  options.Arrays = arrays;
  const auto answer = [&](const std::vector<Point3>& points)
  { return answerOf(mesh, points.data(), std::int64_t(points.size()), options, ranks); };
  std::vector<Point3> polyline;
  for (const Point3& p : given)
  {
    const Point3 corner{ p.x, p.y, inSpace ? p.z : 0 };
    if (polyline.empty() || !(polyline.back() == corner))
    {
      polyline.push_back(corner);
    }
  }
  requirePolyline(polyline, spacing);
  Profile profile;
  CrossingLists crossings =
    spacing == 0 ? crossingsOf(mesh, polyline, arrays, ranks) : CrossingLists();
  crossings.resize(polyline.size());
  std::vector<const Crossing*> found; // per point of the profile; null for others
  double before = 0;
  for (std::size_t i = 0; i < polyline.size(); ++i)
  {
    profile.Distances.push_back(before);
    profile.Points.push_back(polyline[i]);
    found.push_back(nullptr);
    const double length = i + 1 < polyline.size() ? distance(polyline[i], polyline[i + 1]) : 0;
    for (const Crossing& crossing : crossings[i])
    {
      // Corners of the polyline are added anyway.
      if (!(crossing.Position == polyline[i]) && !(crossing.Position == polyline[i + 1]))
      {
        profile.Distances.push_back(before + crossing.Share * length);
        profile.Points.push_back(crossing.Position);
        found.push_back(&crossing);
      }
    }
    if (length > 0 && spacing > 0)
    {
      addSamples(polyline[i], polyline[i + 1], before, spacing, profile);
    }
    before += length;
  }
  if (spacing > 0)
  {
    profile.Answer = answer(profile.Points);
    return profile;
  }
  // Cells and cell values are those at the middles between points; point values are those of the
  // crossings.
  std::vector<Point3> middles = profile.Points;
  for (std::size_t i = 0; i + 1 < middles.size(); ++i)
  {
    const Point3& a = profile.Points[i];
    const Point3& b = profile.Points[i + 1];
    middles[i] = { (a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2 };
  }
  profile.Answer = answer(middles);
  MeshAnswer atPoints = answer(profile.Points);
  std::size_t first = 0; // index of the array's first component in Crossing::Values
  for (std::size_t a = 0; a < profile.Answer.Arrays.size(); ++a) // none if no rank has cells
  {
    MeshAnswer::Array& values = profile.Answer.Arrays[a];
    if (!values.OfPoints)
    {
      continue;
    }
    values = std::move(atPoints.Arrays[a]);
    const auto components = std::size_t(values.Components);
    withScalar(values.Type,
      [&](auto zero)
      {
        using Value = decltype(zero);
        for (std::size_t i = 0; i < found.size(); ++i)
        {
          for (std::size_t c = 0; c < components && found[i]; ++c)
          {
            values.Values.as<Value>()[i * components + c] =
              toScalar<Value>(found[i]->Values[first + c]);
          }
        }
      });
    first += components;
  }
  return profile;
}

} // namespace tipp
