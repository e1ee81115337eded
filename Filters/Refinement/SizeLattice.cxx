// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/SizeLattice.h"

#include "Predicates/Angles.h"
#include "Predicates/SensibleRange.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace tipp
{
namespace
{

double unitOfLongitude(double latitude)
{
  constexpr double leastCosine = 0.01;
  return SizeLattice::MetresPerDegree * std::max(cosineOfDegrees(latitude), leastCosine);
}

void requireBox(const Box2& box, PlaneKind kind)
{
  if (!isFinite(box) || !std::isfinite(box.width(0)) || !std::isfinite(box.width(1)))
  {
    throw std::invalid_argument(
      "The domain has no finite width and height, so there are no sizes in it; give lines with "
      "finite coordinates.");
  }
  if (kind == PlaneKind::Geographic && (box.Min.y < -90 || box.Max.y > 90))
  {
    throw std::invalid_argument("The domain, " + inWords(inSpace(box)) +
      ", has latitudes beyond 90 degrees; give longitudes as x and latitudes as y, or leave out "
      "that they are.");
  }
}

/// Returns the least spacing, `wanted` or more, for which nodes on `width` x `height` are at most
/// `most`.
double fittingSpacing(double width, double height, double wanted, double most)
{
  // With t nodes per unit of length, there are at most (t w + 2) (t h + 2). Both lengths are
  // divided by the larger one, so that products do not overflow.
  const double scale = std::max(width, height);
  if (!(scale > 0))
  {
    return wanted;
  }
  const double w = width / scale;
  const double h = height / scale;
  const double t = (most - 4) / (w + h + std::sqrt((w + h) * (w + h) + w * h * (most - 4)));
  return std::max(wanted, scale / t);
}

/// Returns the number of steps of at most `spacing` that cover a width.
int stepsOf(double width, double spacing)
{
  return std::max(int(std::ceil(width / spacing)), 1);
}

Lattice nodesOf(
  const Box2& box, const std::array<double, 2>& units, double spacing, double most, PlaneKind kind)
{
  requireBox(box, kind);
  const std::array<double, 2> lengths = { box.width(0) * units[0], box.width(1) * units[1] };
  const double step = fittingSpacing(lengths[0], lengths[1], spacing, most);
  Lattice nodes;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const int steps = stepsOf(lengths[axis], step);
    nodes.Min[axis] = box.Min[axis];
    nodes.Delta[axis] = lengths[axis] > 0 ? box.width(axis) / steps : step / units[axis];
    nodes.Extent[2 * axis + 1] = steps;
  }
  return nodes;
}

} // namespace

SizeLattice::SizeLattice(const Box2& box, double spacing, std::int64_t mostNodes, PlaneKind kind)
  : UnitY(kind == PlaneKind::Geographic ? MetresPerDegree : 1)
  , MiddleUnitX(kind == PlaneKind::Geographic ? unitOfLongitude(box.center().y) : 1)
  , Nodes(nodesOf(box, { MiddleUnitX, UnitY }, spacing, double(mostNodes), kind))
  , X(this->Nodes, 0)
  , Y(this->Nodes, 1)
{
  for (int row = 0; row < this->rows(); ++row)
  {
    this->UnitX.push_back(kind == PlaneKind::Geographic ? unitOfLongitude(this->Y[row]) : 1);
  }
}

} // namespace tipp
