// SPDX-License-Identifier: BSD-3-Clause
#include "ConstrainedOracle.h"

#include "Comparison.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace tipp
{
namespace test
{
namespace
{

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using InfoVertex = CGAL::Triangulation_vertex_base_with_info_2<std::int64_t, Epick>;
using Face = CGAL::Constrained_triangulation_face_base_2<Epick>;
using FaceStructure = CGAL::Triangulation_data_structure_2<InfoVertex, Face>;
using Constrained = CGAL::Constrained_Delaunay_triangulation_2<Epick, FaceStructure,
  CGAL::No_constraint_intersection_tag>;
using Edge = std::pair<std::int64_t, std::int64_t>;

Epick::Point_2 pointOf(const Coordinates& xy, std::int64_t id)
{
  return { xy[std::size_t(2 * id)], xy[std::size_t(2 * id + 1)] };
}

/// Applies the tie rule: flips an edge of four co-circular points if the lexicographically largest
/// of them is one of its ends.
class TieBreaker
{
public:
  TieBreaker(const Coordinates& xy, const Constrained& mesh)
    : XY(xy)
  {
    for (auto face = mesh.finite_faces_begin(); face != mesh.finite_faces_end(); ++face)
    {
      for (int i = 0; i < 3; ++i)
      {
        const std::int64_t a = face->vertex((i + 1) % 3)->info();
        const std::int64_t b = face->vertex((i + 2) % 3)->info();
        this->Apex[{ a, b }] = face->vertex(i)->info();
        if (face->is_constrained(i))
        {
          this->Fixed.insert({ std::min(a, b), std::max(a, b) });
        }
        this->Suspects.push_back({ a, b });
      }
    }
  }

  Triangles run()
  {
    while (!this->Suspects.empty())
    {
      const Edge edge = this->Suspects.back();
      this->Suspects.pop_back();
      this->check(edge);
    }
    Triangles triangles;
    for (const auto& [edge, apex] : this->Apex)
    {
      if (apex < edge.first && apex < edge.second)
      {
        triangles.push_back(canonical(apex, edge.first, edge.second));
      }
    }
    return sorted(std::move(triangles));
  }

private:
  void check(const Edge& edge)
  {
    const auto [a, b] = edge;
    const auto left = this->Apex.find({ a, b });
    const auto right = this->Apex.find({ b, a });
    if (left == this->Apex.end() || right == this->Apex.end() ||
      this->Fixed.count({ std::min(a, b), std::max(a, b) }))
    {
      return;
    }
    const std::int64_t c = left->second;
    const std::int64_t d = right->second;
    const auto p = [this](std::int64_t id) { return pointOf(this->XY, id); };
    if (CGAL::side_of_oriented_circle(p(a), p(b), p(c), p(d)) != CGAL::ON_ORIENTED_BOUNDARY ||
      std::max(p(c), p(d)) > std::max(p(a), p(b)))
    {
      return;
    }
    this->Apex.erase(left);
    this->Apex.erase(right);
    for (const auto& [u, v, w] : { Triangle{ a, d, c }, Triangle{ d, b, c } })
    {
      this->Apex[{ u, v }] = w;
      this->Apex[{ v, w }] = u;
      this->Apex[{ w, u }] = v;
    }
    for (const Edge& next : { Edge{ a, d }, Edge{ d, b }, Edge{ b, c }, Edge{ c, a } })
    {
      this->Suspects.push_back(next);
    }
  }

  const Coordinates& XY;
  std::map<Edge, std::int64_t> Apex; ///< apex of the triangle on the left of a directed edge
  std::set<Edge> Fixed;
  std::vector<Edge> Suspects;
};

double oracleUnit(double value)
{
  const double size = std::fabs(value);
  const double above = std::nextafter(size, HUGE_VAL);
  return std::isfinite(above) ? above - size : size - std::nextafter(size, 0);
}

/// Whether a point lies on a constraint within rounding errors. In each of the first ten rounds the
/// error may grow by half a unit in the last place of the constraint's coordinates, and in later
/// rounds by half of 1, 2, 4 ... units of the largest coordinate.
bool isNearLine(const Coordinates& xy, const Constraint& constraint, std::int64_t id, int rounds)
{
  const auto x = [&](std::int64_t i) { return mpq_class(xy[std::size_t(2 * i)]); };
  const auto y = [&](std::int64_t i) { return mpq_class(xy[std::size_t(2 * i + 1)]); };
  constexpr int roundsOfDoubles = 10;
  const bool isCoarse = rounds > roundsOfDoubles;
  const auto unit = [&](std::size_t axis)
  {
    double largest = std::max(std::fabs(xy[std::size_t(2 * constraint.A) + axis]),
      std::fabs(xy[std::size_t(2 * constraint.B) + axis]));
    for (std::size_t i = axis; isCoarse && i < xy.size(); i += 2)
    {
      largest = std::max(largest, std::isfinite(xy[i]) ? std::fabs(xy[i]) : 0);
    }
    return mpq_class(oracleUnit(largest));
  };
  const mpq_class dx = x(constraint.B) - x(constraint.A);
  const mpq_class dy = y(constraint.B) - y(constraint.A);
  const mpq_class off = dx * (y(id) - y(constraint.A)) - dy * (x(id) - x(constraint.A));
  const double all = std::min(rounds, roundsOfDoubles) +
    (isCoarse ? std::ldexp(1, std::min(rounds - roundsOfDoubles, 1000)) : 0);
  const mpq_class units = mpq_class(all) * mpq_class(0.500001); // > 1/2, since units are rounded
  return abs(off) <= units * (abs(dx) * unit(1) + abs(dy) * unit(0));
}

/// Whether a point lies exactly on a constraint, between its ends.
bool isOnLine(const Coordinates& xy, const Constraint& constraint, std::int64_t id)
{
  const Epick::Point_2 a = pointOf(xy, constraint.A);
  const Epick::Point_2 b = pointOf(xy, constraint.B);
  const Epick::Point_2 p = pointOf(xy, id);
  const auto isWithin = [](double value, double one, double other)
  { return std::min(one, other) <= value && value <= std::max(one, other); };
  return isWithin(p.x(), a.x(), b.x()) && isWithin(p.y(), a.y(), b.y()) &&
    CGAL::collinear(a, p, b) && CGAL::collinear_are_strictly_ordered_along_line(a, p, b);
}

/// Points in the order of x, so that those on a constraint are found without looking at all.
class PointsByX
{
public:
  PointsByX(const Coordinates& xy, std::size_t count)
    : XY(xy)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      if (std::isfinite(xy[2 * i]))
      {
        this->Ids.push_back(std::int64_t(i));
      }
    }
    std::sort(this->Ids.begin(), this->Ids.end(),
      [this](std::int64_t a, std::int64_t b) { return this->x(a) < this->x(b); });
  }

  std::vector<std::int64_t> onLine(const Constraint& constraint) const
  {
    const double left = std::min(this->x(constraint.A), this->x(constraint.B));
    const double right = std::max(this->x(constraint.A), this->x(constraint.B));
    auto id = std::lower_bound(this->Ids.begin(), this->Ids.end(), left,
      [this](std::int64_t i, double value) { return this->x(i) < value; });
    std::vector<std::int64_t> found;
    for (; id != this->Ids.end() && this->x(*id) <= right; ++id)
    {
      if (isOnLine(this->XY, constraint, *id))
      {
        found.push_back(*id);
      }
    }
    return found;
  }

private:
  double x(std::int64_t id) const { return this->XY[std::size_t(2 * id)]; }

  const Coordinates& XY;
  std::vector<std::int64_t> Ids;
};

std::set<Edge> edgesOf(const Triangles& triangles)
{
  std::set<Edge> edges;
  for (const Triangle& t : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
    }
  }
  return edges;
}

/// Whether each constraint's segments form a chain of edges from its first point to its second,
/// with all points on it, and no crossing is at a point.
testing::AssertionResult areChains(const Coordinates& all,
  const std::vector<Constraint>& constraints, const ResolvedConstraints& resolved,
  const Ids& representative, const std::set<Edge>& edges)
{
  const std::size_t points = all.size() / 2 - resolved.Crossings.size();
  for (std::size_t i = points; i < representative.size(); ++i)
  {
    if (representative[i] != std::int64_t(i))
    {
      return testing::AssertionFailure()
        << "crossing " << i << " is at point " << representative[i];
    }
  }
  const PointsByX byX(all, points);
  std::size_t next = 0;
  std::int64_t omitted = 0;
  for (std::size_t c = 0; c < constraints.size(); ++c)
  {
    const std::int64_t first = representative[std::size_t(constraints[c].A)];
    const std::int64_t last = representative[std::size_t(constraints[c].B)];
    std::int64_t at = first;
    std::set<std::int64_t> vertices{ first };
    bool isEmpty = true;
    for (; next < resolved.Segments.size() && resolved.Segments[next].Constraint == std::int64_t(c);
         ++next)
    {
      const IdSegment& segment = resolved.Segments[next];
      isEmpty = false;
      if (segment.A != at)
      {
        return testing::AssertionFailure() << "constraint " << c << " is interrupted at " << at;
      }
      at = segment.B;
      vertices.insert(at);
      if (!edges.count(std::minmax(segment.A, segment.B)))
      {
        return testing::AssertionFailure()
          << "constraint " << c << ": " << segment.A << ", " << segment.B << " is no edge";
      }
      if (!isNearLine(all, { first, last }, at, resolved.Rounds))
      {
        return testing::AssertionFailure() << "constraint " << c << " bends away at " << at;
      }
    }
    if (isEmpty && (first < 0 || last < 0))
    {
      ++omitted;
    }
    else if (at != last)
    {
      return testing::AssertionFailure() << "constraint " << c << " ends at " << at;
    }
    if (first < 0 || last < 0 || first == last)
    {
      continue;
    }
    for (const std::int64_t id : byX.onLine({ first, last }))
    {
      if (!vertices.count(representative[std::size_t(id)]))
      {
        return testing::AssertionFailure() << "constraint " << c << " omits point " << id;
      }
    }
  }
  return omitted == resolved.NotFinite
    ? testing::AssertionSuccess()
    : testing::AssertionFailure() << omitted << " constraints are left out";
}

} // namespace

Coordinates withCrossings(const Coordinates& xy, const ConstrainedTriangulation& result)
{
  Coordinates all = xy;
  for (const CrossingPoint& crossing : result.Constraints.Crossings)
  {
    all.insert(all.end(), { crossing.Position.x, crossing.Position.y });
  }
  return all;
}

Triangles constrainedDelaunay(const Coordinates& xy, const std::vector<Constraint>& segments)
{
  const Reference plain = reference(xy);
  if (plain.Mesh.empty())
  {
    return {};
  }
  Constrained mesh;
  std::vector<Constrained::Vertex_handle> vertices(xy.size() / 2);
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    if (plain.Representative[i] == std::int64_t(i))
    {
      vertices[i] = mesh.insert(pointOf(xy, std::int64_t(i)));
      vertices[i]->info() = std::int64_t(i);
    }
  }
  std::set<Edge> edges; // a set, because CGAL reports a repeated segment as a crossing
  for (const Constraint& segment : segments)
  {
    edges.insert(std::minmax(
      plain.Representative[std::size_t(segment.A)], plain.Representative[std::size_t(segment.B)]));
  }
  for (const auto& [a, b] : edges)
  {
    if (a >= 0 && a != b)
    {
      mesh.insert_constraint(vertices[std::size_t(a)], vertices[std::size_t(b)]);
    }
  }
  return TieBreaker(xy, mesh).run();
}

testing::AssertionResult isConstrained(const Coordinates& xy,
  const std::vector<Constraint>& constraints, const ConstrainedTriangulation& result)
{
  const Coordinates all = withCrossings(xy, result);
  const Triangles triangles = trianglesOf(result.Mesh);
  const Reference plain = reference(all);
  if (plain.Mesh.empty())
  {
    return triangles.empty() ? testing::AssertionSuccess()
                             : testing::AssertionFailure() << "triangles of points on a line";
  }
  const auto chains =
    areChains(all, constraints, result.Constraints, plain.Representative, edgesOf(triangles));
  if (!chains)
  {
    return chains;
  }
  std::vector<Constraint> segments;
  for (const IdSegment& segment : result.Constraints.Segments)
  {
    segments.push_back({ segment.A, segment.B });
  }
  try
  {
    return sameTriangles(all, triangles, constrainedDelaunay(all, segments));
  }
  catch (const std::exception& error) // CGAL's Intersection_of_constraints_exception
  {
    return testing::AssertionFailure() << "the segments cross: " << error.what();
  }
}

} // namespace test
} // namespace tipp
