// SPDX-License-Identifier: BSD-3-Clause
#include "Check/QualityChecker.h"

#include "Check/AngleBound.h"
#include "Check/ExactVector.h"
#include "Check/InputAngles.h"
#include "Check/MeshEdges.h"
#include "Check/RoundedBorder.h"
#include "Check/SplitChains.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace tipp
{
namespace
{

using check::MeshEdges;
using check::Position;

struct Corners
{
  Position A;
  Position B;
  Position C;
};

Position positionAt(const std::vector<double>& xy, std::size_t i)
{
  return { xy[2 * i], xy[2 * i + 1] };
}

bool isExactlyLarger(const Corners& t, double area)
{
  return check::ExactVector(t.A, t.B).cross(check::ExactVector(t.A, t.C)) >
    2 * check::ExactNumber(area);
}

/// Returns whether the area of a triangle is above a limit. With e = 2^-53, differences and
/// products have a relative error of e each, so the area has an error of at most 4.01 e times the
/// sum of the products' sizes; the comparison allows for 8 e. The sum's range excludes underflow
/// and overflow.
bool isLarger(const Corners& t, double limit)
{
  const double down = (t.B.x - t.A.x) * (t.C.y - t.A.y);
  const double up = (t.B.y - t.A.y) * (t.C.x - t.A.x);
  const double size = std::fabs(down) + std::fabs(up);
  const double excess = (down - up) / 2 - limit;
  const double error = 0x1p-50 * (size / 2 + std::fabs(limit));
  constexpr double least = 0x1p-900;
  constexpr double most = 0x1p900;
  if (std::isinf(limit))
  {
    return limit < 0;
  }
  if (std::isnan(limit) || (excess > error && size >= least && size <= most))
  {
    return true;
  }
  return !(excess < -error && size >= least && size <= most) && isExactlyLarger(t, limit);
}

/// Returns the angle at `apex` in degrees, within a relative error of a few roundings of a radian.
double angleAt(Position apex, Position p, Position q)
{
  // Divided by their lengths, so that no product overflows.
  const double u = std::hypot(p.x - apex.x, p.y - apex.y);
  const double v = std::hypot(q.x - apex.x, q.y - apex.y);
  const double ux = (p.x - apex.x) / u;
  const double uy = (p.y - apex.y) / u;
  const double vx = (q.x - apex.x) / v;
  const double vy = (q.y - apex.y) / v;
  constexpr double degrees = 57.295779513082320877; // in a radian
  return degrees * std::atan2(std::fabs(ux * vy - uy * vx), ux * vx + uy * vy);
}

/// Returns the smallest angle in degrees: the one opposite to the shortest edge.
double smallestAngle(const Corners& t)
{
  const double ab = std::hypot(t.B.x - t.A.x, t.B.y - t.A.y);
  const double bc = std::hypot(t.C.x - t.B.x, t.C.y - t.B.y);
  const double ca = std::hypot(t.A.x - t.C.x, t.A.y - t.C.y);
  return ab <= bc && ab <= ca ? angleAt(t.C, t.A, t.B)
    : bc <= ca                ? angleAt(t.A, t.B, t.C)
                              : angleAt(t.B, t.C, t.A);
}

double areaOf(const Corners& t)
{
  return (t.B.x - t.A.x) / 2 * (t.C.y - t.A.y) - (t.B.y - t.A.y) / 2 * (t.C.x - t.A.x);
}

class QualityCheck
{
public:
  explicit QualityCheck(CheckedMesh&& mesh)
    : Whole(wholeMesh(std::move(mesh.XY), std::move(mesh.Triangles)))
    , Mesh(std::move(mesh))
    , Bound(this->Mesh.MinAngle)
    , Edges(this->Whole.XY, this->Whole.Triangles)
    , Angles(this->Edges)
  {
    this->Report.MinAngle = this->Mesh.MinAngle;
  }

  QualityReport run()
  {
    this->checkSegments();
    CheckOptions options;
    options.Constraints = this->Fixed;
    options.IsCut = true;        // points may be outside of the mesh
    options.BoundaryFree = true; // checkBorder() is stricter
    this->Report.Mesh = checkWhole(this->Whole, options);
    this->Report.LostPoints = this->countHeld(this->Mesh.InputXY, true);
    this->Report.FilledHoles = this->countHeld(this->Mesh.Holes, false);
    this->checkBorder();
    this->checkTriangles();
    this->checkThin();
    this->measureGrading();
    return this->Report;
  }

private:
  std::size_t triangles() const { return this->Whole.Triangles.size() / 3; }

  /// Returns whether the points of a triangle exist and are finite. Others are faults that
  /// checkDelaunay() finds.
  bool isGood(std::size_t t) const
  {
    const auto points = std::int64_t(this->Whole.XY.size() / 2);
    const std::int64_t* const corners = &this->Whole.Triangles[3 * t];
    return std::all_of(corners, corners + 3,
      [&](std::int64_t id)
      { return id >= 0 && id < points && check::isFinite(this->Edges.at(id)); });
  }

  Corners cornersOf(std::size_t t) const
  {
    const std::int64_t* const corners = &this->Whole.Triangles[3 * t];
    return { this->Edges.at(corners[0]), this->Edges.at(corners[1]), this->Edges.at(corners[2]) };
  }

  void checkSegments();
  void addChain(Position a, Position b, check::Route&& route);
  void addBorderEdges();
  void addBorderEdge(
    const check::RoundedBorder::Line& line, const check::Route& route, std::size_t i);
  QualityReport::Fault countHeld(const std::vector<double>& xy, bool unlessVertices) const;
  void checkBorder();
  void checkTriangles();
  void checkThin();
  void checkListed(std::vector<bool>& isListed);
  std::vector<bool> mayBeLarge();
  bool isForced(std::size_t triangle) const;
  bool isBelow(std::size_t triangle) const
  {
    return std::binary_search(this->Below.begin(), this->Below.end(), triangle);
  }
  std::vector<std::array<Position, 2>> hullEdges() const;
  void measureGrading();

  const CheckedPiece Whole; ///< the points and triangles of Mesh
  const CheckedMesh Mesh;   ///< without its points and triangles
  const check::AngleBound Bound;
  const MeshEdges Edges;
  check::InputAngles Angles;
  struct Chain
  {
    Position A;
    Position B;
    check::Route Way;
  };
  std::vector<Chain> Chains;
  check::RoundedBorder Border;
  std::vector<FixedEdge> Fixed; ///< the chains' edges, sorted
  /// The edges of all chains that segments may have, sorted: of segments at the distance of
  /// rounding, each may have the chain of the other.
  std::vector<FixedEdge> MayBeFixed;
  std::vector<std::size_t> Below; ///< triangles with an angle below the bound, in order
  QualityReport Report;
};

void QualityCheck::addChain(Position a, Position b, check::Route&& route)
{
  for (std::size_t i = 0; i + 1 < route.Vertices.size(); ++i)
  {
    if (!route.IsGap[i])
    {
      this->Fixed.push_back({ std::min(route.Vertices[i], route.Vertices[i + 1]),
        std::max(route.Vertices[i], route.Vertices[i + 1]) });
    }
  }
  this->Angles.add(a, b, route.Vertices);
  this->Chains.push_back({ a, b, std::move(route) });
}

/// Adds the border edges of the chains. At a crossing, which was rounded, a chain has fewer edges
/// than there are fixed ones: there the segment is bent, and its split points are on the line from
/// one such vertex to the next.
void QualityCheck::addBorderEdges()
{
  std::unordered_map<std::int64_t, std::size_t> fixedAt; // by vertex: the number of fixed edges
  for (const FixedEdge& edge : this->Fixed)
  {
    ++fixedAt[edge[0]];
    ++fixedAt[edge[1]];
  }
  for (const auto& [a, b, route] : this->Chains)
  {
    const std::size_t last = route.Vertices.size() - 1;
    const auto isBend = [&, &route = route](std::size_t i)
    {
      const std::size_t own = (route.IsGap[i - 1] ? 0U : 1U) + (route.IsGap[i] ? 0U : 1U);
      return fixedAt[route.Vertices[i]] != own;
    };
    for (std::size_t from = 0; from < last;)
    {
      std::size_t to = from + 1;
      while (to < last && !isBend(to))
      {
        ++to;
      }
      const check::RoundedBorder::Line line{ a, b, route.Positions[from], route.Positions[to] };
      for (; from < to; ++from)
      {
        this->addBorderEdge(line, route, from);
      }
    }
  }
  this->Border.finish();
}

void QualityCheck::addBorderEdge(
  const check::RoundedBorder::Line& line, const check::Route& route, std::size_t i)
{
  if (route.IsGap[i])
  {
    return;
  }
  const std::int64_t from = route.Vertices[i];
  const std::int64_t to = route.Vertices[i + 1];
  const bool isMeshLeft = this->Edges.leftOf(from, to) != MeshEdges::None;
  if (isMeshLeft != (this->Edges.leftOf(to, from) != MeshEdges::None))
  {
    this->Border.add(line, route.Positions[i], route.Positions[i + 1], isMeshLeft);
  }
}

/// Finds the chains of the segments, and of the edges of the input's convex hull: where the mesh is
/// not cut, these are segments, too.
void QualityCheck::checkSegments()
{
  check::SplitChains chains(this->Edges);
  const auto mayBeFixed = [this](std::int64_t from, std::int64_t to) {
    this->MayBeFixed.push_back({ std::min(from, to), std::max(from, to) });
  };
  const auto points = std::int64_t(this->Mesh.InputXY.size() / 2);
  for (std::size_t i = 0; i < this->Mesh.Segments.size(); ++i)
  {
    const auto [first, last] = this->Mesh.Segments[i];
    if (std::min(first, last) < 0 || std::max(first, last) >= points)
    {
      this->Report.LostSegments.add(std::int64_t(i));
      continue;
    }
    const Position a = positionAt(this->Mesh.InputXY, std::size_t(first));
    const Position b = positionAt(this->Mesh.InputXY, std::size_t(last));
    if (!check::isFinite(a) || !check::isFinite(b) || isSame(a, b))
    {
      continue; // needs no chain
    }
    auto route = chains.find(a, b, mayBeFixed);
    if (route)
    {
      this->addChain(a, b, std::move(*route));
    }
    else
    {
      this->Report.LostSegments.add(std::int64_t(i));
    }
  }
  for (const auto& [a, b] : this->hullEdges())
  {
    if (auto route = chains.find(a, b, mayBeFixed))
    {
      this->addChain(a, b, std::move(*route));
    }
  }
  for (std::vector<FixedEdge>* const edges : { &this->Fixed, &this->MayBeFixed })
  {
    std::sort(edges->begin(), edges->end());
    edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
  }
  this->Angles.finish();
  this->addBorderEdges();
}

std::vector<std::array<Position, 2>> QualityCheck::hullEdges() const
{
  std::vector<Position> points;
  for (std::size_t i = 0; i < this->Mesh.InputXY.size() / 2; ++i)
  {
    const Position p = positionAt(this->Mesh.InputXY, i);
    if (check::isFinite(p))
    {
      points.push_back(p);
    }
  }
  std::sort(points.begin(), points.end(), check::isBefore);
  points.erase(std::unique(points.begin(), points.end(), check::isSame), points.end());
  std::vector<std::array<Position, 2>> edges;
  for (const auto& half : { check::halfHull(points.begin(), points.end()),
         check::halfHull(points.rbegin(), points.rend()) })
  {
    for (std::size_t i = 1; i < half.size(); ++i)
    {
      edges.push_back({ half[i - 1], half[i] });
    }
  }
  return edges;
}

/// Counts the points that are in a triangle or on its edges. If `unlessVertices`, those that are
/// vertices do not count, nor those outside of the border's segments.
QualityReport::Fault QualityCheck::countHeld(
  const std::vector<double>& xy, bool unlessVertices) const
{
  struct Sought
  {
    Position At;
    std::size_t Index;
    bool IsHeld = false;
  };
  std::vector<Sought> sought;
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    const Position p = positionAt(xy, i);
    if (check::isFinite(p) && !(unlessVertices && this->Edges.vertexAt(p) != MeshEdges::None))
    {
      sought.push_back({ p, i });
    }
  }
  std::sort(sought.begin(), sought.end(),
    [](const Sought& a, const Sought& b) { return check::isBefore(a.At, b.At); });
  for (std::size_t t = 0; !sought.empty() && t < this->triangles(); ++t)
  {
    if (!this->isGood(t))
    {
      continue;
    }
    const auto [a, b, c] = this->cornersOf(t);
    const auto [south, north] = std::minmax({ a.y, b.y, c.y });
    const double east = std::max({ a.x, b.x, c.x });
    auto point = std::lower_bound(sought.begin(), sought.end(), std::min({ a.x, b.x, c.x }),
      [](const Sought& p, double x) { return p.At.x < x; });
    for (; point != sought.end() && point->At.x <= east; ++point)
    {
      const Position p = point->At;
      point->IsHeld = point->IsHeld ||
        (p.y >= south && p.y <= north && check::turn(a, b, p) >= 0 && check::turn(b, c, p) >= 0 &&
          check::turn(c, a, p) >= 0);
    }
  }
  std::sort(sought.begin(), sought.end(),
    [](const Sought& a, const Sought& b) { return a.Index < b.Index; });
  QualityReport::Fault fault;
  for (const Sought& point : sought)
  {
    if (point.IsHeld && !(unlessVertices && this->Border.mayCover(point.At)))
    {
      fault.add(std::int64_t(point.Index));
    }
  }
  return fault;
}

void QualityCheck::checkBorder()
{
  if (this->Mesh.InputXY.empty())
  {
    return;
  }
  std::vector<FixedEdge> open;
  this->Edges.visitBorder(
    [&](std::int64_t from, std::int64_t to)
    {
      const FixedEdge edge{ std::min(from, to), std::max(from, to) };
      if (!std::binary_search(this->MayBeFixed.begin(), this->MayBeFixed.end(), edge))
      {
        open.push_back(edge);
      }
    });
  std::sort(open.begin(), open.end());
  for (std::size_t h = 0; !open.empty() && h < this->Whole.Triangles.size(); ++h)
  {
    const auto ends =
      std::minmax({ this->Whole.Triangles[h], this->Whole.Triangles[h % 3 == 2 ? h - 2 : h + 1] });
    if (std::binary_search(open.begin(), open.end(), FixedEdge{ ends.first, ends.second }))
    {
      this->Report.OpenBorder.add(std::int64_t(h / 3));
    }
  }
}

/// Returns by triangle whether it is listed, so that it may be above the limit on areas.
std::vector<bool> QualityCheck::mayBeLarge()
{
  std::vector<bool> may(this->triangles(), false);
  for (std::size_t i = 0; i < this->Mesh.ListedLarge.size(); ++i)
  {
    const std::int64_t t = this->Mesh.ListedLarge[i];
    if (t < 0 || std::size_t(t) >= may.size())
    {
      this->Report.BadEntries.add(std::int64_t(i));
      continue;
    }
    may[std::size_t(t)] = true;
  }
  for (std::size_t i = 0; this->Mesh.Listed && i < this->Mesh.Listed->size(); ++i)
  {
    const auto t = std::size_t((*this->Mesh.Listed)[i].Triangle); // checkListed() reports bad ones
    if (t < may.size())
    {
      may[t] = true;
    }
  }
  return may;
}

/// Compares all triangles with the bounds, except whether those below the angle are excused.
void QualityCheck::checkTriangles()
{
  const std::vector<bool> mayBeLarge = this->mayBeLarge();
  for (std::size_t t = 0; t < this->triangles(); ++t)
  {
    if (!this->isGood(t))
    {
      continue;
    }
    const Corners corners = this->cornersOf(t);
    const auto [a, b, c] = corners;
    const double angle = smallestAngle(corners);
    const double bin = std::clamp(
      std::floor(angle / QualityReport::BinDegrees), 0.0, double(QualityReport::Bins - 1));
    ++this->Report.Histogram[std::isnan(angle) ? 0 : std::size_t(bin)];
    if (this->Report.LeastAngleAt < 0 || angle < this->Report.LeastAngle)
    {
      this->Report.LeastAngle = angle;
      this->Report.LeastAngleAt = std::int64_t(t);
    }
    this->Report.LargestArea = std::max(this->Report.LargestArea, areaOf(corners));
    if (this->Bound.isMissedBy(a, b, c))
    {
      this->Below.push_back(t);
    }
    if (this->Mesh.MaxArea &&
      isLarger(
        corners, this->Mesh.MaxArea({ a.x / 3 + b.x / 3 + c.x / 3, a.y / 3 + b.y / 3 + c.y / 3 })))
    {
      if (mayBeLarge[t])
      {
        ++this->Report.ExcusedLarge;
      }
      else
      {
        this->Report.TooLarge.add(std::int64_t(t));
      }
    }
  }
  this->Report.Below = std::int64_t(this->Below.size());
}

bool QualityCheck::isForced(std::size_t t) const
{
  const std::int64_t* const corners = &this->Whole.Triangles[3 * t];
  return this->Angles.explain(corners[0], corners[1], corners[2]);
}

/// Decides which of the triangles below the bound are excused.
void QualityCheck::checkThin()
{
  std::vector<bool> isListed(this->triangles(), false);
  if (this->Mesh.Listed)
  {
    this->checkListed(isListed);
  }
  for (const std::size_t t : this->Below)
  {
    if (isListed[t])
    {
      continue;
    }
    if (!this->Mesh.Listed && this->isForced(t))
    {
      ++this->Report.Excused[std::size_t(ThinReason::InputAngle)];
      continue;
    }
    this->Report.Thin.add(std::int64_t(t));
    if (this->Report.Thin.Count == 1)
    {
      this->Report.ThinAngle = smallestAngle(this->cornersOf(t));
    }
  }
}

/// Checks the list's entries. Marks each triangle that has one: what is wrong with its entry is a
/// fault of its own.
void QualityCheck::checkListed(std::vector<bool>& isListed)
{
  constexpr double tolerance = 1e-6; // degrees
  for (std::size_t i = 0; i < this->Mesh.Listed->size(); ++i)
  {
    const ListedTriangle& listed = (*this->Mesh.Listed)[i];
    const auto t = std::size_t(listed.Triangle);
    if (listed.Triangle < 0 || t >= this->triangles() || !this->isGood(t) || isListed[t])
    {
      this->Report.BadEntries.add(std::int64_t(i));
      continue;
    }
    isListed[t] = true;
    const double angle = smallestAngle(this->cornersOf(t));
    // Whoever lists it in doubles may take an angle just above the bound for one below.
    if (!this->isBelow(t) && angle > std::stod(this->Mesh.MinAngle) + tolerance)
    {
      this->Report.NotBelow.add(listed.Triangle);
    }
    else if (!(std::fabs(angle - listed.Angle) <= tolerance))
    {
      this->Report.WrongAngles.add(listed.Triangle);
    }
    else if (listed.Reason == ThinReason::InputAngle && !this->isForced(t))
    {
      this->Report.WrongReasons.add(listed.Triangle);
    }
    else
    {
      ++this->Report.Excused[std::size_t(listed.Reason)];
    }
  }
}

void QualityCheck::measureGrading()
{
  this->Edges.allEdges(
    [this](std::int64_t from, std::int64_t to)
    {
      const std::int64_t left = this->Edges.leftOf(from, to);
      const std::int64_t right = this->Edges.leftOf(to, from);
      if (from < to && left != MeshEdges::None && right != MeshEdges::None)
      {
        const Position a = this->Edges.at(from);
        const Position b = this->Edges.at(to);
        const auto [less, more] = std::minmax(
          { areaOf({ a, b, this->Edges.at(left) }), areaOf({ b, a, this->Edges.at(right) }) });
        this->Report.Grading =
          less > 0 ? std::max(this->Report.Grading, more / less) : this->Report.Grading;
      }
      return true;
    });
}

} // namespace

QualityReport checkQuality(CheckedMesh mesh)
{
  return QualityCheck(std::move(mesh)).run();
}

std::vector<std::string> QualityReport::faults() const
{
  std::vector<std::string> lines = this->Mesh.faults();
  const auto add = [&lines](const Fault& fault, const std::string& text, const std::string& first)
  {
    if (fault.Count != 0)
    {
      lines.push_back(std::to_string(fault.Count) + " " + text + "; the first is " + first + " " +
        std::to_string(fault.First));
    }
  };
  if (this->Mesh.Cells == 0)
  {
    lines.emplace_back("the mesh has no triangles");
  }
  add(this->LostSegments, "segments are not chains of edges", "segment");
  add(this->LostPoints, "points of the input are inside of the mesh, but no vertices", "point");
  add(this->FilledHoles, "points of holes are in a triangle", "hole");
  add(this->OpenBorder, "border edges are neither on segments nor on the convex hull of the input",
    "that of triangle");
  add(this->Thin,
    "triangles have an angle below " + this->MinAngle + " degrees and are not excused", "triangle");
  if (this->Thin.Count != 0)
  {
    lines.back() += ", with " + std::to_string(this->ThinAngle) + " degrees";
  }
  add(this->TooLarge, "triangles are above the limit on areas", "triangle");
  add(this->BadEntries, "entries of the list name no triangle, or one that is listed before",
    "entry");
  add(this->NotBelow, "listed triangles have no angle below " + this->MinAngle + " degrees",
    "triangle");
  add(this->WrongAngles, "listed triangles have another smallest angle", "triangle");
  add(this->WrongReasons, "listed triangles are not between segments that meet below 60 degrees",
    "triangle");
  return lines;
}

} // namespace tipp
