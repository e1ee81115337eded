// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGroupBoxes_h
#define tippGroupBoxes_h

#include "Resample/Lanes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A box of a lattice's samples along the two axes of triangles: at each end, the index of the last
/// sample that is not beyond it, up to rounding. It may reach beyond the lattice.
struct SampleBox
{
  int Low[2];
  int High[2];
};

/// The boxes of groups of consecutive triangles, so that all of them can be skipped at once.
class GroupBoxes
{
public:
  static constexpr std::int64_t Size = 64; ///< triangles in a group

  /// Makes all boxes unknown.
  void reset(std::int64_t cells)
  {
    this->Boxes.assign(std::size_t((cells + Size - 1) / Size), unknown());
  }
  void set(std::int64_t group, const SampleBox& box) { this->Boxes[std::size_t(group)] = box; }

  /// The box of a group; null if it is unknown.
  const SampleBox* find(std::int64_t group) const
  {
    const auto i = std::size_t(group);
    return i < this->Boxes.size() && this->Boxes[i].Low[0] != Unknown ? &this->Boxes[i] : nullptr;
  }

  static constexpr SampleBox unknown() { return { { Unknown, Unknown }, { Unknown, Unknown } }; }

private:
  static constexpr int Unknown = -2;

  std::vector<SampleBox> Boxes;
};

/// Finds the box of a group of triangles, four at a time.
class BoxLanes
{
public:
  [[gnu::always_inline]] void add(const RangeLanes& columns, const RangeLanes& rows)
  {
    this->Low[0] = least(columns.Low, this->Low[0]);
    this->Low[1] = least(rows.Low, this->Low[1]);
    this->High[0] = most(columns.High, this->High[0]);
    this->High[1] = most(rows.High, this->High[1]);
  }

  /// Adds triangles whose box is unknown. So the group's box is unknown, too.
  void addUnknown() { this->Known = false; }

  SampleBox box() const
  {
    SampleBox box = GroupBoxes::unknown();
    for (int axis = 0; axis < 2 && this->Known; ++axis)
    {
      const Lanes& low = this->Low[axis];
      const Lanes& high = this->High[axis];
      box.Low[axis] = int(std::min({ low[0], low[1], low[2], low[3] })) - 1;
      box.High[axis] = int(std::max({ high[0], high[1], high[2], high[3] })) - 1;
    }
    return box;
  }

private:
  Lanes Low[2] = { allLanes(HUGE_VAL), allLanes(HUGE_VAL) };
  Lanes High[2] = { allLanes(0), allLanes(0) };
  bool Known = true;
};

} // namespace tipp

#endif
