// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRefinementRules_h
#define tippRefinementRules_h

#include "Predicates/Angles.h"
#include "Predicates/Geometry.h"
#include "Predicates/Vectors.h"
#include "Refinement/RefinementMesh.h"
#include "Refinement/RefinementOptions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace tipp
{

/// What a triangle must be like, and which of the triangles that are not goes first.
class RefinementRules
{
public:
  using Index = RefinementMesh::Index;

  /// Why a triangle must go.
  enum class Need
  {
    None,
    Segment, ///< its vertex encroaches upon a subsegment
    Thin,    ///< an angle is below the bound
    Large    ///< its area is above the limit
  };
  struct Verdict
  {
    Need Why;
    /// Among thin triangles the one with the shortest edge goes first, among large ones that with
    /// the largest circumcircle, both relative to the size of triangles there: the lower, the
    /// sooner. Other orders need more points.
    double Rank;
  };

  double MinimumAngle = 30; ///< degrees
  double LargestArea = std::numeric_limits<double>::infinity();
  std::function<double(Point2, double)> AreaAt; ///< as in RefinementOptions; empty: none
  double LeastArea = std::numeric_limits<double>::infinity(); ///< lower bound of all limits
  std::vector<double> RegionAreas;                            ///< by region: further limit
  double ShortestEdge = 0;
  bool KeepsBorder = false;   ///< no subsegment of the border is split
  bool KeepsSegments = false; ///< no subsegment at all

  /// Call this after the members above are set. All area limits are multiplied by `coarser`.
  void prepare(double coarser)
  {
    this->Coarser = coarser;
    this->LeastTwice = 2 * this->LeastArea * coarser;
    const double sine = sineOfDegrees(this->MinimumAngle);
    // A little above the bound, so that rounding here never accepts an angle below it.
    this->SineSquared = sine * sine * (1 + 1e-10);
    // Without a bound on angles, 20 degrees keep triangles at subsegments from becoming flat.
    const double lens = cosineOfDegrees(2 * std::clamp(this->MinimumAngle, 20.0, 45.0));
    this->LensCosineSquared = lens * lens;
    // Üngör's off-center, shortened by Shewchuk's 0.95 / 2.
    this->OffCenter =
      0.475 * cosineOfDegrees(this->MinimumAngle / 2) / sineOfDegrees(this->MinimumAngle / 2);
  }

  /// Whether p encroaches upon the subsegment ab: it lies in its diametral lens, from where the
  /// subsegment is seen at more than 180 degrees less twice the bound (Shewchuk 2002, Delaunay
  /// refinement algorithms for triangular mesh generation).
  bool isEncroached(Point2 a, Point2 b, Point2 p) const
  {
    const Point2 u = a - p;
    const Point2 v = b - p;
    return this->isInLens(u.x * v.x + u.y * v.y, u.x * u.x + u.y * u.y, v.x * v.x + v.y * v.y);
  }

  /// The limit of the area of a triangle.
  double areaLimit(const std::array<Point2, 3>& p, Index region) const
  {
    double limit = this->LargestArea;
    if (this->AreaAt)
    {
      limit = std::min(limit, areaAt(this->AreaAt, p));
    }
    if (!this->RegionAreas.empty())
    {
      limit = std::min(limit, this->RegionAreas[std::size_t(region)]);
    }
    return limit * this->Coarser;
  }

  Verdict judge(const RefinementMesh& mesh, const RefinementMesh::Triangle& triangle) const
  {
    const auto [a, b, c] = mesh.cornersOf(triangle);
    const Point2 ab = b - a;
    const Point2 ac = c - a;
    const Point2 bc = c - b;
    return this->judge(mesh, triangle,
      { bc.x * bc.x + bc.y * bc.y, ac.x * ac.x + ac.y * ac.y, ab.x * ab.x + ab.y * ab.y },
      cross(ab, ac));
  }

  /// What most triangles meet. A copy of it stays in registers.
  struct Limits
  {
    double SineSquared;
    double LeastTwice;

    /// Returns false only if judge() returns Need::None for a triangle without subsegments.
    bool areMissed(const std::array<double, 3>& squares, double twice) const
    {
      return twice > this->LeastTwice || isThin(squares, twice, this->SineSquared);
    }
  };
  Limits limits() const { return { this->SineSquared, this->LeastTwice }; }

  /// `squares`: of the lengths of the edges opposite to the corners; `twice`: twice the area.
  Verdict judge(const RefinementMesh& mesh, const RefinementMesh::Triangle& triangle,
    const std::array<double, 3>& squares, double twice) const
  {
    const RefinementMesh::Link anySegment =
      (triangle.Across[0] | triangle.Across[1] | triangle.Across[2]) & RefinementMesh::IsSegment;
    if (anySegment != 0 && (triangle.State & RefinementMesh::KeepsSegments) == 0 &&
      this->hasEncroached(triangle, squares))
    {
      return { Need::Segment, 0 };
    }
    const double shortest = std::min(std::min(squares[0], squares[1]), squares[2]);
    const bool isThin = RefinementRules::isThin(squares, twice, this->SineSquared);
    if ((!isThin && twice <= this->LeastTwice) || (triangle.State & RefinementMesh::IsGivenUp) != 0)
    {
      return { Need::None, 0 };
    }
    const double limit = this->areaLimit(
      mesh.cornersOf(triangle), Index(triangle.State >> RefinementMesh::RegionShift));
    const double unit = std::isfinite(limit) ? limit : 1;
    const int s = squares[0] == shortest ? 0 : squares[1] == shortest ? 1 : 2;
    if (isThin && !this->isForced(mesh, triangle, s))
    {
      return { Need::Thin, shortest / unit };
    }
    if (twice > 2 * limit)
    {
      // The square of the diameter is the product of the squares over the square of twice the area.
      return { Need::Large, unit * (twice * twice) / (squares[0] * squares[1] * squares[2]) };
    }
    return { Need::None, 0 };
  }

  /// Whether a thin triangle cannot be improved: its shortest edge joins two input segments that
  /// meet at less than 60 degrees, at equal distance from there. So it is where shells around that
  /// point cut them.
  bool isForced(
    const RefinementMesh& mesh, const RefinementMesh::Triangle& triangle, int shortest) const
  {
    const Index a = triangle.Corner[std::size_t(RefinementMesh::next(shortest))];
    const Index b = triangle.Corner[std::size_t(RefinementMesh::previous(shortest))];
    const Index originA = mesh.Origins[std::size_t(a)];
    const Index originB = mesh.Origins[std::size_t(b)];
    if (!RefinementMesh::isOnSegment(originA) || !RefinementMesh::isOnSegment(originB) ||
      originA == originB)
    {
      return false;
    }
    const InputSegment& s = mesh.Segments[std::size_t(RefinementMesh::segmentNumber(originA))];
    const InputSegment& t = mesh.Segments[std::size_t(RefinementMesh::segmentNumber(originB))];
    for (std::size_t i = 0; i < 2; ++i)
    {
      if (s.Ids[i] == t.Ids[0] || s.Ids[i] == t.Ids[1])
      {
        const Point2 u = mesh.Points[std::size_t(a)] - s.Ends[i];
        const Point2 v = mesh.Points[std::size_t(b)] - s.Ends[i];
        const double x = u.x * u.x + u.y * u.y;
        const double y = v.x * v.x + v.y * v.y;
        const double product = u.x * v.x + u.y * v.y;
        constexpr double equal = 1.002;
        return x < equal * y && y < equal * x && product > 0 && 4 * product * product > x * y;
      }
    }
    return false;
  }

  /// The point to insert for a triangle: its circumcentre, or the point on the bisector of its
  /// shortest edge that makes a triangle of good shape with that edge, if that is nearer: Üngör's
  /// off-center (Off-centers: a new type of Steiner points, 2004).
  Point2 pointFor(const std::array<Point2, 3>& p) const
  {
    const Point2 ab = p[1] - p[0];
    const Point2 bc = p[2] - p[1];
    const Point2 ca = p[0] - p[2];
    const double squareA = bc.x * bc.x + bc.y * bc.y;
    const double squareB = ca.x * ca.x + ca.y * ca.y;
    const double squareC = ab.x * ab.x + ab.y * ab.y;
    const bool isB = squareB < squareA;
    const bool isC = squareC < (isB ? squareB : squareA);
    const Point2 from = isC ? p[0] : isB ? p[2] : p[1];
    const Point2 edge = isC ? ab : isB ? ca : bc;
    // The centre is half the edge's length times the cotangent of the angle opposite to it away.
    const double product = (squareA + squareB + squareC) / 2 -
      (isC      ? squareC
          : isB ? squareB
                : squareA);
    const double away = std::min(product / (2 * cross(ab, bc)), this->OffCenter);
    return { from.x + (edge.x / 2 - edge.y * away), from.y + (edge.y / 2 + edge.x * away) };
  }

  /// The same for the product of the vectors from p to both ends, and their squares.
  bool isInLens(double product, double u, double v) const
  {
    return product < 0 && product * product >= this->LensCosineSquared * u * v;
  }

private:
  double Coarser = 1;
  double LeastTwice = 0; ///< twice a lower bound of all limits

  /// The angle between the two longer edges is the smallest one: its sine is twice the area over
  /// the product of their lengths.
  static bool isThin(const std::array<double, 3>& squares, double twice, double sineSquared)
  {
    const double shortest = std::min(std::min(squares[0], squares[1]), squares[2]);
    const double own = twice * twice * shortest;
    const double least = sineSquared * (squares[0] * squares[1] * squares[2]);
    // Both are 0 if they underflow, as for a needle.
    return own < least || (own == 0 && sineSquared > 0);
  }

  bool hasEncroached(
    const RefinementMesh::Triangle& triangle, const std::array<double, 3>& squares) const
  {
    for (int i = 0; i < 3; ++i)
    {
      const double u = squares[std::size_t(RefinementMesh::next(i))];
      const double v = squares[std::size_t(RefinementMesh::previous(i))];
      if (RefinementMesh::isSegment(triangle.Across[std::size_t(i)]) &&
        this->isInLens((u + v - squares[std::size_t(i)]) / 2, u, v))
      {
        return true;
      }
    }
    return false;
  }

  double SineSquared = 0;
  double LensCosineSquared = 0;
  double OffCenter = 0;
};

} // namespace tipp

#endif
