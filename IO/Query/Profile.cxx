// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Lines.h"

#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

Point2 flat(const Point3& p)
{
  return { p.x, p.y };
}

double distance(const Point3& a, const Point3& b)
{
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// Where a segment of the polyline crosses an edge, or a point, of the mesh.
struct Crossing
{
  double Share;      ///< of the segment
  std::int64_t Low;  ///< the edge's point with the lower global id
  std::int64_t High; ///< the other one; the same for a point
  Point3 At;
  std::vector<double> Values; ///< of the arrays of points, component by component

  bool operator<(const Crossing& other) const
  {
    return std::tie(this->Share, this->Low, this->High) <
      std::tie(other.Share, other.Low, other.High);
  }
  bool operator==(const Crossing& other) const
  {
    return this->Low == other.Low && this->High == other.High;
  }
};

/// The crossings of one segment with the cells of a piece.
class SegmentCrossings
{
public:
  SegmentCrossings(const Point3& begin, const Point3& end, const std::vector<PartValues>& values,
    const MeshPart& part, std::vector<Crossing>& crossings)
    : Begin(begin)
    , End(end)
    , Values(values)
    , Part(part)
    , Crossings(crossings)
  {
  }

  template <typename Access>
  void addCell(const Access& access, std::int64_t cell)
  {
    std::int64_t points[3];
    Point3 at[3];
    int sides[3];
    for (int i = 0; i < 3; ++i)
    {
      points[i] = access.ids(cell)[i];
      at[i] = access.point(points[i]);
    }
    if (!this->meetsBox(at))
    {
      return;
    }
    for (int i = 0; i < 3; ++i)
    {
      sides[i] = orientation(flat(this->Begin), flat(this->End), flat(at[i]));
    }
    for (int i = 0; i < 3; ++i)
    {
      const int k = (i + 1) % 3;
      sides[i] == 0 ? this->addPoint(points[i], at[i]) : void();
      sides[i] * sides[k] < 0 ? this->addEdge(points[i], points[k], at[i], at[k]) : void();
    }
  }

private:
  bool meetsBox(const Point3 (&at)[3]) const
  {
    const auto apart = [&](double a, double b, double c, double p, double q) {
      return std::max({ a, b, c }) < std::min(p, q) || std::min({ a, b, c }) > std::max(p, q);
    };
    return std::isfinite(at[0].x + at[0].y + at[1].x + at[1].y + at[2].x + at[2].y) &&
      !apart(at[0].x, at[1].x, at[2].x, this->Begin.x, this->End.x) &&
      !apart(at[0].y, at[1].y, at[2].y, this->Begin.y, this->End.y);
  }

  double shareOf(const Point3& p) const
  {
    const double dx = this->End.x - this->Begin.x;
    const double dy = this->End.y - this->Begin.y;
    return ((p.x - this->Begin.x) * dx + (p.y - this->Begin.y) * dy) / (dx * dx + dy * dy);
  }

  /// A point on the segment's line: it lies on the segment if it is in its box.
  void addPoint(std::int64_t point, const Point3& at)
  {
    const Point3 twice[3] = { at, at, at };
    if (this->meetsBox(twice))
    {
      const std::int64_t id = this->Part.pointId(point);
      Crossing crossing{ this->shareOf(at), id, id, { at.x, at.y, 0 }, {} };
      this->forValues([&](const PartValues& values, int k)
        { crossing.Values.push_back(values.atPoint(point, k)); });
      this->Crossings.push_back(std::move(crossing));
    }
  }

  /// An edge whose ends are on different sides of the segment's line.
  void addEdge(std::int64_t a, std::int64_t b, Point3 atA, Point3 atB)
  {
    if (this->Part.pointId(b) < this->Part.pointId(a))
    {
      std::swap(a, b);
      std::swap(atA, atB);
    }
    if (orientation(flat(atA), flat(atB), flat(this->Begin)) *
        orientation(flat(atA), flat(atB), flat(this->End)) >
      0)
    {
      return;
    }
    // By the distances of the ends from the line, in doubles; the same bits for both cells.
    const double dx = this->End.x - this->Begin.x;
    const double dy = this->End.y - this->Begin.y;
    const double ofA = std::fabs(dx * (atA.y - this->Begin.y) - dy * (atA.x - this->Begin.x));
    const double ofB = std::fabs(dx * (atB.y - this->Begin.y) - dy * (atB.x - this->Begin.x));
    const double t = ofA + ofB > 0 ? ofA / (ofA + ofB) : 0.5;
    const Point3 at{ atA.x + t * (atB.x - atA.x), atA.y + t * (atB.y - atA.y), 0 };
    Crossing crossing{ std::clamp(this->shareOf(at), 0.0, 1.0), this->Part.pointId(a),
      this->Part.pointId(b), at, {} };
    this->forValues(
      [&](const PartValues& values, int k)
      {
        const double first = values.atPoint(a, k);
        crossing.Values.push_back(first + t * (values.atPoint(b, k) - first));
      });
    this->Crossings.push_back(std::move(crossing));
  }

  template <typename Visit>
  void forValues(const Visit& visit) const
  {
    for (const PartValues& values : this->Values)
    {
      for (int k = 0; values.description().OfPoints && k < values.description().Components; ++k)
      {
        visit(values, k);
      }
    }
  }

  const Point3& Begin;
  const Point3& End;
  const std::vector<PartValues>& Values;
  const MeshPart& Part;
  std::vector<Crossing>& Crossings;
};

/// Whether a segment may meet a box: their bounds meet, and the box's corners are not all strictly
/// on one side of the segment's line.
bool mayMeet(const Bounds& box, const Point3& a, const Point3& b)
{
  if (std::max(a.x, b.x) < box[0] || std::min(a.x, b.x) > box[1] || std::max(a.y, b.y) < box[2] ||
    std::min(a.y, b.y) > box[3])
  {
    return false;
  }
  int sides[4];
  for (int i = 0; i < 4; ++i)
  {
    const Point2 corner{ box[std::size_t(i % 2)], box[std::size_t(2 + i / 2)] };
    sides[i] = orientation(flat(a), flat(b), corner);
  }
  return std::abs(sides[0] + sides[1] + sides[2] + sides[3]) != 4;
}

/// The crossings of all segments, each list sorted and without repetitions.
std::vector<std::vector<Crossing>> crossingsOf(const ResidentMesh& mesh,
  const std::vector<Point3>& polyline, const std::vector<std::string>& arrays)
{
  std::vector<std::vector<Crossing>> result(polyline.size() - 1);
  std::mutex mutex;
  const auto pieces = std::int64_t(mesh.mesh().Pieces.size());
  forChunks(pieces, 1, pieces > 1 ? threadCount(mesh.options().Threads) : 1, {},
    [&](std::int64_t number, std::int64_t, int)
    {
      poll();
      std::vector<std::size_t> met;
      for (std::size_t s = 0; s < result.size(); ++s)
      {
        const bool isMet = !mesh.isStored() ||
          mayMeet(mesh.mesh().Pieces[std::size_t(number)].Box, polyline[s], polyline[s + 1]);
        isMet ? met.push_back(s) : void();
      }
      if (met.empty())
      {
        return;
      }
      const ResidentPieces::Lease piece =
        mesh.pieces().get(std::size_t(number), mesh.needsOf(arrays));
      const MeshPart& part = *piece->Part;
      std::vector<PartValues> values;
      for (const std::string& name : arrays)
      {
        values.emplace_back(part, mesh.find(name));
      }
      for (const std::size_t s : met)
      {
        std::vector<Crossing> own;
        SegmentCrossings crossings(polyline[s], polyline[s + 1], values, part, own);
        withAccess(part.Mesh,
          [&](const auto& access)
          {
            // A cell that another piece owns may cross the segment in this box alone.
            for (std::int64_t cell = 0; cell < part.Mesh.Cells; ++cell)
            {
              part.Mesh.Hidden&& part.Mesh.Hidden[cell] ? void() : crossings.addCell(access, cell);
            }
          });
        const std::lock_guard<std::mutex> lock(mutex);
        result[s].insert(result[s].end(), own.begin(), own.end());
      }
    });
  for (std::vector<Crossing>& list : result)
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return result;
}

/// Puts a number into an array of the answer, in its type.
void put(MeshAnswer::Array& array, std::size_t at, double value)
{
  withScalar(array.Type,
    [&](auto zero)
    {
      using Value = decltype(zero);
      array.Values.as<Value>()[at] = toScalar<Value>(value);
    });
}

void addSamples(const Point3& a, const Point3& b, double before, double spacing, Profile& profile)
{
  const double length = distance(a, b);
  // The multiples of the spacing that lie inside of the segment.
  for (auto i = std::int64_t(std::floor(before / spacing)) + 1;
       double(i) * spacing < before + length; ++i)
  {
    const double along = double(i) * spacing - before;
    const double share = along / length;
    profile.Distances.push_back(double(i) * spacing);
    profile.Points.push_back({ a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), 0 });
  }
}

void requirePolyline(const ResidentMesh& mesh, const std::vector<Point3>& polyline, double spacing)
{
  const std::string name = mesh.isStored() ? mesh.mesh().Path : "the mesh";
  if (mesh.mesh().CellSize != 3)
  {
    throw IOError(name, "has tetrahedra; a profile needs a mesh of triangles.");
  }
  double length = 0;
  for (std::size_t i = 0; i < polyline.size(); ++i)
  {
    if (!std::isfinite(polyline[i].x) || !std::isfinite(polyline[i].y))
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

} // namespace

Profile profileOf(const ResidentMesh& mesh, const std::vector<Point3>& given, double spacing,
  const std::vector<std::string>& arrays)
{
  requirePolyline(mesh, given, spacing);
  std::vector<Point3> polyline;
  for (const Point3& p : given)
  {
    const Point3 corner{ p.x, p.y, 0 };
    polyline.empty() || !(polyline.back() == corner) ? polyline.push_back(corner) : void();
  }
  Profile profile;
  std::vector<std::vector<Crossing>> crossings(polyline.size());
  if (spacing == 0 && polyline.size() > 1)
  {
    crossings = crossingsOf(mesh, polyline, arrays);
    crossings.emplace_back();
  }
  std::vector<const Crossing*> found; // of each point of the profile; null: none
  double before = 0;
  for (std::size_t i = 0; i < polyline.size(); ++i)
  {
    profile.Distances.push_back(before);
    profile.Points.push_back(polyline[i]);
    found.push_back(nullptr);
    const double length = i + 1 < polyline.size() ? distance(polyline[i], polyline[i + 1]) : 0;
    for (const Crossing& crossing : crossings[i])
    {
      // The corners of the polyline are there anyway.
      if (!(crossing.At == polyline[i]) && !(crossing.At == polyline[i + 1]))
      {
        profile.Distances.push_back(before + crossing.Share * length);
        profile.Points.push_back(crossing.At);
        found.push_back(&crossing);
      }
    }
    length > 0 && spacing > 0 ? addSamples(polyline[i], polyline[i + 1], before, spacing, profile)
                              : void();
    before += length;
  }
  AnswerOptions options;
  options.Arrays = arrays;
  const auto count = std::int64_t(profile.Points.size());
  if (spacing > 0)
  {
    profile.Answer = mesh.answer(profile.Points.data(), count, options);
    return profile;
  }
  // The cells between the points, and their values; values of points are those of the crossings.
  std::vector<Point3> middles = profile.Points;
  for (std::size_t i = 0; i + 1 < middles.size(); ++i)
  {
    const Point3& next = profile.Points[i + 1];
    middles[i] = { (middles[i].x + next.x) / 2, (middles[i].y + next.y) / 2, 0 };
  }
  profile.Answer = mesh.answer(middles.data(), count, options);
  const MeshAnswer corners = mesh.answer(profile.Points.data(), count, options);
  for (std::size_t i = 0; i < profile.Points.size(); ++i)
  {
    std::size_t k = 0;
    for (std::size_t a = 0; a < arrays.size(); ++a)
    {
      const StoredArray* const array = mesh.find(arrays[a]);
      MeshAnswer::Array& values = profile.Answer.Arrays[a];
      if (array && !array->OfPoints)
      {
        continue;
      }
      const auto components = std::size_t(values.Components);
      for (std::size_t c = 0; c < components && found[i]; ++c)
      {
        put(values, i * components + c, found[i]->Values[k + c]);
      }
      k += components;
      if (!found[i])
      {
        const std::size_t bytes = values.tupleBytes();
        std::memcpy(
          values.Values.data() + i * bytes, corners.Arrays[a].Values.data() + i * bytes, bytes);
      }
    }
  }
  return profile;
}

} // namespace tipp
