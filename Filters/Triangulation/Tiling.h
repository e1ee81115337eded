// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTiling_h
#define tippTiling_h

#include "Predicates/Box2.h"
#include "Predicates/CircumdiskBox.h"
#include "Predicates/Point2.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

using PartitionIndex = std::int32_t;

/// The partitions' boxes: a domain cut in two again and again. Every point belongs to exactly one
/// (on a cut, to the upper one); the boxes themselves are closed and share their borders.
class VTKTIPPFILTERS_EXPORT Tiling
{
public:
  /// Equal boxes, columns x rows.
  static Tiling grid(const Box2& domain, int columns, int rows);

  /// About `count` boxes that hold equally many of the sample's points.
  static Tiling balanced(const Box2& domain, std::vector<Point2> sample, int count);

  PartitionIndex size() const { return static_cast<PartitionIndex>(this->Boxes.size()); }
  const Box2& box(PartitionIndex i) const { return this->Boxes[static_cast<std::size_t>(i)]; }
  const Box2& domain() const { return this->Domain; }

  PartitionIndex locate(Point2 p) const
  {
    const double coordinates[2] = { p.x, p.y };
    std::int32_t at = this->Root;
    while (at >= 0)
    {
      const Cut& cut = this->Cuts[static_cast<std::size_t>(at)];
      at = cut.Below[coordinates[cut.Axis] >= cut.At];
    }
    return ~at;
  }

  /// visit(partition) for every box that the closed disk meets.
  template <typename Visit>
  void visitMet(const Circumdisk& disk, Visit&& visit) const
  {
    const Box2 bounds = disk.bounds();
    const double low[2] = { bounds.xmin, bounds.ymin };
    const double high[2] = { bounds.xmax, bounds.ymax };
    std::array<std::int32_t, MaximumDepth> pending;
    std::size_t size = 0;
    pending[size++] = this->Root;
    while (size > 0)
    {
      std::int32_t at = pending[--size];
      while (at >= 0)
      {
        const Cut& cut = this->Cuts[static_cast<std::size_t>(at)];
        const bool below = low[cut.Axis] <= cut.At;
        const bool above = high[cut.Axis] >= cut.At;
        if (below && above)
        {
          pending[size++] = cut.Below[1];
        }
        at = cut.Below[!below];
      }
      if (disk.meets(this->box(~at)))
      {
        visit(~at);
      }
    }
  }

private:
  struct Cut
  {
    double At;
    std::int32_t Axis;
    std::int32_t Below[2]; ///< a cut, or ~partition
  };
  // Every cut halves the number of boxes, which fits 31 bits.
  static constexpr std::size_t MaximumDepth = 64;

  std::int32_t cutGrid(const Box2& box, int columns, int rows);
  std::int32_t cutSample(const Box2& box, Point2* begin, Point2* end, int count);
  std::int32_t addBox(const Box2& box);

  Box2 Domain{};
  std::int32_t Root = 0;
  std::vector<Cut> Cuts;
  std::vector<Box2> Boxes;
};

} // namespace tipp

#endif
