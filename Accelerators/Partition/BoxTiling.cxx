// SPDX-License-Identifier: BSD-3-Clause
#include "Partition/BoxTiling.h"

#include "OpenCL/Devices.h"

#include <cmath>
#include <limits>
#include <string>

namespace tipp
{
namespace
{

int axesOf(int dimension, const Box3& domain)
{
  int axes = 0;
  for (int axis = 0; axis < dimension; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    axes |= (domain.Min[a] < domain.Max[a] ? 1 : 0) << axis;
  }
  return axes;
}

int childCountOf(int axes)
{
  return (axes & 1 ? 2 : 1) * (axes & 2 ? 2 : 1) * (axes & 4 ? 2 : 1);
}

// The midpoint: always within [low, high], and does not overflow.
double middleOf(double low, double high)
{
  const double sum = low + high;
  const double middle = std::isfinite(sum) ? 0.5 * sum : 0.5 * low + 0.5 * high;
  return std::min(std::max(middle, low), high);
}

Box3 childOf(int axes, const Box3& box, int which)
{
  Box3 child = box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if ((axes >> axis & 1) != 0)
    {
      const double middle = middleOf(box.Min[axis], box.Max[axis]);
      ((which & 1) != 0 ? child.Min : child.Max)[axis] = middle;
      which >>= 1;
    }
  }
  return child;
}

[[noreturn]] void failTree()
{
  throw AcceleratorError("The nodes of the partitions' tree do not make a tree of at most " +
    std::to_string(BoxTiling::MaxDepth) + " levels.");
}

} // namespace

BoxTiling::BoxTiling(int dimension, const Box3& domain)
  : Dimension(dimension)
  , Domain(domain)
{
  if (dimension != 2 && dimension != 3)
  {
    throw AcceleratorError(
      "Partitions have 2 or 3 dimensions, not " + std::to_string(dimension) + ".");
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (axis >= static_cast<std::size_t>(dimension))
    {
      this->Domain.Min[axis] = 0.0;
      this->Domain.Max[axis] = 0.0;
    }
    const double low = this->Domain.Min[axis];
    const double high = this->Domain.Max[axis];
    if (!std::isfinite(low) || !std::isfinite(high) || low > high)
    {
      throw AcceleratorError(
        "The domain to partition has no finite bounds along axis " + std::to_string(axis) + ".");
    }
  }
  this->Axes = axesOf(dimension, this->Domain);
}

BoxTiling BoxTiling::grid(int dimension, const Box3& domain, const std::array<int, 3>& boxes)
{
  BoxTiling tiling(dimension, domain);
  std::int64_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (axis < static_cast<std::size_t>(dimension) && boxes[axis] < 1)
    {
      throw AcceleratorError("A grid of partitions needs at least one along each axis, not " +
        std::to_string(boxes[axis]) + ".");
    }
    tiling.Counts[axis] = (tiling.Axes >> axis & 1) != 0 ? boxes[axis] : 1;
    count *= tiling.Counts[axis];
    if (count > std::numeric_limits<std::int32_t>::max())
    {
      throw AcceleratorError("A grid has fewer than 2^31 partitions; ask for fewer.");
    }
    tiling.cutAxis(axis);
  }
  const double* x = tiling.Cuts.data() + tiling.CutStart[0];
  const double* y = tiling.Cuts.data() + tiling.CutStart[1];
  const double* z = tiling.Cuts.data() + tiling.CutStart[2];
  for (int k = 0; k < tiling.Counts[2]; ++k)
  {
    for (int j = 0; j < tiling.Counts[1]; ++j)
    {
      for (int i = 0; i < tiling.Counts[0]; ++i)
      {
        tiling.Boxes.push_back({ { x[i], y[j], z[k] }, { x[i + 1], y[j + 1], z[k + 1] } });
      }
    }
  }
  return tiling;
}

void BoxTiling::cutAxis(std::size_t axis)
{
  const double low = this->Domain.Min[axis];
  const double high = this->Domain.Max[axis];
  const int n = this->Counts[axis];
  const double boxesPerUnit = n / (high - low);
  this->BoxesPerUnit[axis] = std::isfinite(boxesPerUnit) ? boxesPerUnit : 0.0;
  this->CutStart[axis] = this->Cuts.size();
  this->Cuts.push_back(low);
  for (int i = 1; i < n; ++i)
  {
    const double part = static_cast<double>(i) / n;
    const double extent = high - low;
    const double cut =
      std::isfinite(extent) ? low + extent * part : low * (1.0 - part) + high * part;
    this->Cuts.push_back(std::min(std::max(cut, this->Cuts.back()), high));
  }
  this->Cuts.push_back(high);
}

BoxTiling BoxTiling::tree(
  int dimension, const Box3& domain, const std::vector<std::int32_t>& firstChild)
{
  BoxTiling tiling(dimension, domain);
  tiling.ChildCount = childCountOf(tiling.Axes);
  struct Pending
  {
    std::int32_t Node;
    int Depth;
    Box3 Box;
  };
  if (firstChild.empty())
  {
    failTree();
  }
  tiling.Children.assign(firstChild.size(), 0);
  tiling.Middles.assign(3 * firstChild.size(), 0.0);
  // Depth-first, which numbers the leaves along the Morton curve.
  std::vector<Pending> stack = { { 0, 0, tiling.Domain } };
  // If a node is reached twice, there are more visits than nodes.
  std::size_t visits = 0;
  while (!stack.empty())
  {
    const Pending pending = stack.back();
    stack.pop_back();
    const auto node = static_cast<std::size_t>(pending.Node);
    const std::int32_t child = firstChild[node];
    if (++visits > firstChild.size())
    {
      failTree();
    }
    if (child < 0)
    {
      tiling.Children[node] = static_cast<std::int32_t>(-1 - tiling.count());
      tiling.Boxes.push_back(pending.Box);
      continue;
    }
    if (child <= pending.Node || pending.Depth == MaxDepth ||
      static_cast<std::size_t>(child) + static_cast<std::size_t>(tiling.ChildCount) >
        firstChild.size())
    {
      failTree();
    }
    tiling.Children[node] = child;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      tiling.Middles[3 * node + axis] = middleOf(pending.Box.Min[axis], pending.Box.Max[axis]);
    }
    for (int which = tiling.ChildCount - 1; which >= 0; --which)
    {
      stack.push_back(
        { child + which, pending.Depth + 1, childOf(tiling.Axes, pending.Box, which) });
    }
  }
  if (visits != firstChild.size())
  {
    failTree();
  }
  return tiling;
}

int BoxTiling::childCount(int dimension, const Box3& domain)
{
  return childCountOf(axesOf(dimension, domain));
}

Box3 BoxTiling::childBox(int dimension, const Box3& domain, const Box3& box, int which)
{
  return childOf(axesOf(dimension, domain), box, which);
}

} // namespace tipp
