// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBoxTiling_h
#define tippBoxTiling_h

#include "Predicates/Geometry.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A tiling of a closed domain by closed boxes, which share their borders: a regular grid, or the
/// leaves of a quadtree or octree. Stored as flat arrays, so that devices can use it.
///
/// Boxes are numbered from 0: in a grid x fastest, in a tree along the Morton curve (a node's lower
/// half before its upper half, x fastest). An axis along which the domain has no extent is not
/// split.
class VTKTIPPACCELERATORS_EXPORT BoxTiling
{
public:
  /// The maximum depth of a tree: its smallest boxes have 2^-24 of the domain's lengths.
  static constexpr int MaxDepth = 24;

  /// A grid of nx x ny (x nz) boxes of equal size. Throws AcceleratorError if the domain is not
  /// finite or inverted, a number is not positive, or there are 2^31 boxes or more.
  static BoxTiling grid(int dimension, const Box3& domain, const std::array<int, 3>& boxes);

  /// The leaves of a tree whose nodes are bisected along every axis with some extent. firstChild
  /// has an entry for each node, the root first: -1 for a leaf, else the index of the first of
  /// childCount() consecutive children, which is larger than the node's own. Throws
  /// AcceleratorError for an invalid tree, or if the domain is not finite or inverted.
  static BoxTiling tree(
    int dimension, const Box3& domain, const std::vector<std::int32_t>& firstChild);

  /// The number of children of an inner node: 2 for each axis with some extent, multiplied.
  static int childCount(int dimension, const Box3& domain);

  /// The box of child `which` of a node with the given box.
  static Box3 childBox(int dimension, const Box3& domain, const Box3& box, int which);

  int dimension() const { return this->Dimension; }
  const Box3& domain() const { return this->Domain; }
  std::int64_t count() const { return static_cast<std::int64_t>(this->Boxes.size()); }
  const Box3& box(std::int64_t id) const { return this->Boxes[static_cast<std::size_t>(id)]; }
  bool isGrid() const { return this->Children.empty(); }

  /// Calls visit(id) for each box of the tiling that the closed box meets, in ascending order of
  /// ids.
  template <typename Visit>
  void forEachMeeting(const Box3& box, Visit&& visit) const
  {
    if (this->isGrid())
    {
      this->visitGrid(box, visit);
    }
    else
    {
      this->visitTree(box, visit);
    }
  }

  /// @name The flat arrays
  /// @{ For a grid: the number n of boxes along each axis, and their n + 1 borders, axis after
  /// axis.
  const std::array<int, 3>& counts() const { return this->Counts; }
  const std::vector<double>& cuts() const { return this->Cuts; }
  /// For a tree, per node: the first child, or -1 - box id for a leaf; and the three coordinates of
  /// the cuts.
  const std::vector<std::int32_t>& children() const { return this->Children; }
  const std::vector<double>& middles() const { return this->Middles; }
  /// The bit mask of the axes that a tree splits.
  int axes() const { return this->Axes; }
  ///@}

private:
  struct BoxRange
  {
    int First;
    int Last;
  };

  BoxTiling(int dimension, const Box3& domain);
  void cutAxis(std::size_t axis);

  // An estimate of the box that contains the value; any result is corrected later.
  int guess(std::size_t axis, double value) const
  {
    const double position = (value - this->Domain.Min[axis]) * this->BoxesPerUnit[axis];
    const int last = this->Counts[axis] - 1;
    // The comparison is false for NaN.
    return position > 0.0 ? (position < last ? static_cast<int>(position) : last) : 0;
  }

  // The boxes along an axis that [low, high] meets; empty (First > Last) outside the domain.
  BoxRange rangeAlong(std::size_t axis, double low, double high) const
  {
    const double* cuts = this->Cuts.data() + this->CutStart[axis];
    const int n = this->Counts[axis];
    // The first box whose end is not below low.
    int first = this->guess(axis, low);
    while (first > 0 && cuts[first] >= low)
    {
      --first;
    }
    while (first < n && cuts[first + 1] < low)
    {
      ++first;
    }
    // The last box whose begin is not above high.
    int last = this->guess(axis, high);
    while (last + 1 < n && cuts[last + 1] <= high)
    {
      ++last;
    }
    while (last >= 0 && cuts[last] > high)
    {
      --last;
    }
    return { first, last };
  }

  template <typename Visit>
  void visitGrid(const Box3& box, Visit&& visit) const
  {
    const BoxRange x = this->rangeAlong(0, box.Min.x, box.Max.x);
    const BoxRange y = this->rangeAlong(1, box.Min.y, box.Max.y);
    const BoxRange z = this->rangeAlong(2, box.Min.z, box.Max.z);
    for (int k = z.First; k <= z.Last; ++k)
    {
      for (int j = y.First; j <= y.Last; ++j)
      {
        for (int i = x.First; i <= x.Last; ++i)
        {
          visit(static_cast<std::int32_t>(i + this->Counts[0] * (j + this->Counts[1] * k)));
        }
      }
    }
  }

  template <typename Visit>
  void visitTree(const Box3& box, Visit&& visit) const
  {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(this->Dimension); ++axis)
    {
      if (box.Min[axis] > this->Domain.Max[axis] || box.Max[axis] < this->Domain.Min[axis])
      {
        return;
      }
    }
    // Each level pushes at most 7 siblings.
    std::array<std::int32_t, 7 * MaxDepth + 1> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0)
    {
      const std::int32_t node = stack[--size];
      const std::int32_t child = this->Children[static_cast<std::size_t>(node)];
      if (child < 0)
      {
        visit(-1 - child);
        continue;
      }
      this->pushChildren(node, box, stack.data(), size);
    }
  }

  // Pushes the children that the box meets; since it meets the node, only the cuts matter.
  void pushChildren(
    std::int32_t node, const Box3& box, std::int32_t* stack, std::size_t& size) const
  {
    const double* middle = this->Middles.data() + 3 * static_cast<std::size_t>(node);
    // Bit masks: along which axes the box meets the lower half, and along which the upper half.
    int lower = 0;
    int upper = 0;
    int bit = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if ((this->Axes >> axis & 1) != 0)
      {
        lower |= (box.Min[axis] <= middle[axis] ? 1 : 0) << bit;
        upper |= (box.Max[axis] >= middle[axis] ? 1 : 0) << bit;
        ++bit;
      }
    }
    const std::int32_t child = this->Children[static_cast<std::size_t>(node)];
    if ((lower & upper) == 0)
    {
      stack[size++] = child + upper;
      return;
    }
    // In descending order, so that they are popped in ascending order.
    for (int which = this->ChildCount - 1; which >= 0; --which)
    {
      if ((which & ~upper) == 0 && (~which & ~lower & (this->ChildCount - 1)) == 0)
      {
        stack[size++] = child + which;
      }
    }
  }

  int Dimension;
  Box3 Domain;
  std::vector<Box3> Boxes;
  std::array<int, 3> Counts = { 1, 1, 1 };
  std::array<std::size_t, 3> CutStart = {};
  std::array<double, 3> BoxesPerUnit = {}; // for a grid
  std::vector<double> Cuts;
  std::vector<std::int32_t> Children;
  std::vector<double> Middles;
  int Axes = 0;
  int ChildCount = 1;
};

} // namespace tipp

#endif
