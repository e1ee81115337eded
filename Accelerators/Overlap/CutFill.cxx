// SPDX-License-Identifier: BSD-3-Clause
#include "Overlap/CutFill.h"

#include "Overlap/ConvexPart.h"
#include "Overlap/OverlapVisitor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace tipp
{
namespace
{

/// A part of two triangles and of the bounds, whose value is the difference of the heights. It is
/// cut three times by a triangle, four times by the bounds, and once where the value is 0.
using DifferencePart = ConvexPart<1, 64>;
using DifferenceCorner = DifferencePart::Corner;

/// Cuts parts at the sides of a box.
class BoundsCutter
{
public:
  explicit BoundsCutter(const std::optional<Box2>& bounds)
    : Bounds(bounds)
  {
  }

  /// Returns the part within the bounds: `part` itself, or one that is valid until the next call.
  /// `origin`: what the part's positions are relative to.
  const DifferencePart& cut(const DifferencePart& part, Point2 origin)
  {
    const DifferencePart* rest = &part;
    if (!this->Bounds)
    {
      return *rest;
    }
    int next = 0;
    for (const int axis : { 0, 1 })
    {
      for (const int sign : { 1, -1 })
      {
        const Point2 side = sign > 0 ? this->Bounds->Min : this->Bounds->Max;
        const double at = side[std::size_t(axis)] - origin[std::size_t(axis)];
        rest->cut([axis, sign, at](const DifferenceCorner& corner)
          { return sign * (corner.At[std::size_t(axis)] - at); },
          [axis, at](DifferenceCorner& corner) { (axis == 0 ? corner.At.x : corner.At.y) = at; },
          this->Parts[next], nullptr);
        rest = &this->Parts[next];
        next = 1 - next;
      }
    }
    return *rest;
  }

  bool isBounded() const { return this->Bounds.has_value(); }

private:
  const std::optional<Box2>& Bounds;
  DifferencePart Parts[2];
};

/// The squared length of a triangle's diameter, up to a factor of 2.
double squaredSize(const PlaneTriangle& triangle)
{
  const Box2 box = triangle.box();
  const double length = std::max(box.width(0), box.width(1));
  return length * length;
}

/// The area within the bounds of each triangle; 0 for those that are left out.
std::vector<double> areasWithin(
  const SimplexMesh& mesh, const std::optional<Box2>& bounds, int threads)
{
  std::vector<double> areas(std::size_t(mesh.Cells), 0);
  const TriangleReader reader(mesh);
  forIndices(
    mesh.Cells,
    [&](std::int64_t i)
    {
      PlaneTriangle triangle;
      if (reader.read(i, triangle))
      {
        DifferencePart whole;
        for (const Point2 corner : triangle.At)
        {
          whole.add({ corner - triangle.At[0], { 0 } });
        }
        BoundsCutter cutter(bounds);
        areas[std::size_t(i)] = cutter.cut(whole, triangle.At[0]).area();
      }
    },
    threads);
  return areas;
}

/// Whether a triangle of this area is certainly covered more than once.
bool isCoveredTwice(double covered, double area, double squaredSize)
{
  constexpr double rounding = 1e-8;
  return covered - area > 100 * rounding * area + rounding * squaredSize;
}

/// The area of each triangle of a mesh that is covered, as a fixed-point share of the square of its
/// size: integers, whose sum does not depend on the order in which threads add them.
class CoveredShares
{
public:
  explicit CoveredShares(std::int64_t cells)
    : Shares(std::size_t(cells))
  {
  }

  void add(const PlaneTriangle& triangle, double area)
  {
    const double size =
      squaredSize(triangle); // 0 or infinite if its numbers are very small or large
    const double share = size > 0 ? area / size : 0;
    this->Shares[std::size_t(triangle.Cell)].fetch_add(
      std::uint64_t(std::llround(share * Unit)), std::memory_order_relaxed);
  }
  double areaOf(const PlaneTriangle& triangle) const
  {
    return double(this->Shares[std::size_t(triangle.Cell)].load()) / Unit * squaredSize(triangle);
  }

private:
  static constexpr double Unit = 70368744177664; // 2^46: a triangle may be covered 2^18 times
  std::vector<std::atomic<std::uint64_t>> Shares;
};

/// Adds the differences over the common parts of one triangle after another to its sums.
class DifferenceCollector
{
public:
  DifferenceCollector(const OverlapVisitor<6>& visitor, const std::optional<Box2>& bounds,
    OverlapSums& sums, CoveredShares& covered)
    : Visitor(visitor)
    , Cutter(bounds)
    , Sums(sums)
    , Covered(covered)
  {
  }

  void begin(const PlaneTriangle& target)
  {
    this->Target = this->Sums.of(target.Cell);
    this->Origin = target.At[0];
    for (int i = 0; i < 3; ++i)
    {
      this->First[i] =
        this->Visitor.targets().height(this->Visitor.targets().id(target.Cell, target.cornerOf(i)));
    }
  }

  void add(const PlaneTriangle& source, const CommonPart<6>& common, double area)
  {
    for (int i = 0; i < 3; ++i)
    {
      this->Second[i] = this->Visitor.sources().height(this->Visitor.sources().id(source.Cell, i));
    }
    this->Whole.clear();
    for (int i = 0; i < common.size(); ++i)
    {
      this->Whole.add({ common[i].At, { this->difference(common[i].Value) } });
    }
    const DifferencePart& part = this->Cutter.cut(this->Whole, this->Origin);
    const double within = this->Cutter.isBounded() ? part.area() : area;
    if (within > 0)
    {
      this->Covered.add(source, within);
      this->Target[0].add(within);
      this->addVolumes(part);
    }
  }

  void end() {}

private:
  /// The second height minus the first one, for values of a CommonPart. The large part that all
  /// heights of a terrain have in common costs no digits.
  double difference(const double (&value)[6]) const
  {
    // value[k] is the distance from the edge of the corners k and k + 1, so it is the weight of the
    // third corner.
    const double sum = value[0] + value[1] + value[2];
    const double scale = sum > 0 ? 1 / sum : 0;
    const double first = (value[0] * scale) * (this->First[2] - this->First[0]) +
      (value[2] * scale) * (this->First[1] - this->First[0]);
    const double second = value[4] * (this->Second[1] - this->Second[0]) +
      value[5] * (this->Second[2] - this->Second[0]);
    return (this->Second[0] - this->First[0]) + (second - first);
  }

  /// Adds the integrals of the positive and of the negative values of a part.
  void addVolumes(const DifferencePart& part)
  {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (int i = 0; i < part.size(); ++i)
    {
      low = std::fmin(low, part[i].Value[0]);
      high = std::fmax(high, part[i].Value[0]);
    }
    if (low < 0 && high > 0)
    {
      this->Below.clear();
      part.cut([](const DifferenceCorner& corner) { return corner.Value[0]; },
        [](DifferenceCorner& corner) { corner.Value[0] = 0; }, this->Above, &this->Below);
      this->addTo(this->Above, 2, 1);
      this->addTo(this->Below, 1, -1);
    }
    else
    {
      this->addTo(part, low < 0 ? 1 : 2, low < 0 ? -1 : 1);
    }
  }

  void addTo(const DifferencePart& part, int sum, int sign)
  {
    double volume = 0;
    part.integrate(0, 1, &volume);
    this->Target[sum].add(sign * volume);
  }

  const OverlapVisitor<6>& Visitor;
  BoundsCutter Cutter;
  OverlapSums& Sums;
  CoveredShares& Covered;
  RunningSum* Target = nullptr;
  Point2 Origin{};
  double First[3] = {};  ///< heights of the target's corners
  double Second[3] = {}; ///< heights of the corners of the source's cell, in its order
  DifferencePart Whole;
  DifferencePart Above;
  DifferencePart Below;
};

/// The difference of two areas; 0 if rounding alone can make it.
double areaBeyond(double whole, double common)
{
  constexpr double rounding = 1e-12;
  const double beyond = whole - common;
  return beyond > rounding * whole ? beyond : 0;
}

} // namespace

CutFillSums::CutFillSums(const SimplexMesh& first, const std::optional<Box2>& bounds, int threads)
  : First(first)
  , Bounds(bounds)
  , Threads(threads)
  , Areas(areasWithin(first, bounds, threads))
  , Sums(first.Cells, 2)
{
}

bool CutFillSums::add(const SimplexMesh& second, const Report& report)
{
  const OverlapVisitor<6> visitor(this->First, second, this->Threads);
  CoveredShares covered(second.Cells);
  const bool isDone = visitor.visit(
    [&](int) { return DifferenceCollector(visitor, this->Bounds, this->Sums, covered); }, report);
  const std::vector<double> areas = areasWithin(second, this->Bounds, this->Threads);
  for (std::int64_t i = 0; i < second.Cells && isDone; ++i)
  {
    const double area = areas[std::size_t(i)];
    PlaneTriangle triangle;
    this->SecondArea.add(area);
    if (area > 0 && visitor.sources().read(i, triangle))
    {
      this->SecondCoveredTwice +=
        int(isCoveredTwice(covered.areaOf(triangle), area, squaredSize(triangle)));
    }
  }
  return isDone;
}

CutFill CutFillSums::result() const
{
  CutFill result;
  RunningSum totals[3];
  RunningSum firstArea;
  const TriangleReader reader(this->First);
  for (std::int64_t i = 0; i < this->First.Cells; ++i)
  {
    const RunningSum* const sums = this->Sums.of(i);
    const double area = this->Areas[std::size_t(i)];
    for (int k = 0; k < 3; ++k)
    {
      totals[k].add(sums[k]);
    }
    firstArea.add(area);
    PlaneTriangle triangle;
    if (area > 0 && sums[0].value() > area && reader.read(i, triangle))
    {
      result.CoveredTwice[0] += int(isCoveredTwice(sums[0].value(), area, squaredSize(triangle)));
    }
  }
  result.CoveredTwice[1] = this->SecondCoveredTwice;
  result.Area = totals[0].value();
  result.Cut = totals[1].value();
  result.Fill = totals[2].value();
  result.OnlyFirst = areaBeyond(firstArea.value(), result.Area);
  result.OnlySecond = areaBeyond(this->SecondArea.value(), result.Area);
  if (!std::isfinite(result.Cut + result.Fill + result.Area + result.OnlyFirst + result.OnlySecond))
  {
    throw std::runtime_error("the volumes are too large for a number: the surfaces' coordinates "
                             "or heights are not what they should be.");
  }
  return result;
}

} // namespace tipp
