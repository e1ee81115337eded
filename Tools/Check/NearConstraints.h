// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNearConstraints_h
#define tippNearConstraints_h

#include "Check/ExactTests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{
namespace check
{

/// How far from a constraint its chain is looked for, as a part of the largest coordinate: a
/// million units in the last place. 29 rounds of snap rounding lead a constraint less far.
constexpr double relativeReach = 0x1p-32;

/// Finds the edges of a large mesh that may be parts of constraints, so that only these are kept in
/// memory. It may keep too many edges, but must not miss one, which would be reported as a lost
/// constraint.
class NearConstraints
{
public:
  /// `xy`: x and y of each point. `edges`: two indices of points each. Both are copied.
  NearConstraints(
    const std::vector<double>& xy, const std::vector<std::array<std::int64_t, 2>>& edges)
  {
    const auto at = [&xy](std::int64_t id) {
      return Position{ xy[2 * std::size_t(id)], xy[2 * std::size_t(id) + 1] };
    };
    this->Low = { HUGE_VAL, HUGE_VAL };
    this->High = { -HUGE_VAL, -HUGE_VAL };
    double largest = 0;
    for (const auto& edge : edges)
    {
      const Segment segment{ at(edge[0]), at(edge[1]) };
      if (!isFinite(segment.A) || !isFinite(segment.B))
      {
        continue; // constraints that are not finite are ignored
      }
      this->Segments.push_back(segment);
      for (const Position p : { segment.A, segment.B })
      {
        this->Low = { std::min(this->Low[0], p.x), std::min(this->Low[1], p.y) };
        this->High = { std::max(this->High[0], p.x), std::max(this->High[1], p.y) };
        largest = std::max({ largest, std::fabs(p.x), std::fabs(p.y) });
      }
    }
    this->Tolerance = relativeReach * largest;
    constexpr double most = 2048;
    this->Side = std::int64_t(std::clamp(std::sqrt(double(this->Segments.size())), 1.0, most));
    this->Starts.assign(std::size_t(this->Side * this->Side) + 1, 0);
    for (const Segment& segment : this->Segments)
    {
      this->visitCells(segment, [this](std::size_t cell) { ++this->Starts[cell + 1]; });
    }
    for (std::size_t cell = 1; cell < this->Starts.size(); ++cell)
    {
      this->Starts[cell] += this->Starts[cell - 1];
    }
    this->InCells.resize(this->Starts.back());
    std::vector<std::size_t> next = this->Starts;
    for (std::size_t i = 0; i < this->Segments.size(); ++i)
    {
      this->visitCells(this->Segments[i],
        [&](std::size_t cell) { this->InCells[next[cell]++] = std::uint32_t(i); });
    }
  }

  /// Returns whether both ends of an edge are within relativeReach of one constraint.
  bool mayHave(Position a, Position b) const
  {
    if (this->Segments.empty())
    {
      return false;
    }
    const auto cell = std::size_t(this->cellOf(a.y, 1) * this->Side + this->cellOf(a.x, 0));
    return std::any_of(this->InCells.begin() + std::ptrdiff_t(this->Starts[cell]),
      this->InCells.begin() + std::ptrdiff_t(this->Starts[cell + 1]),
      [&](std::uint32_t s)
      { return this->isNear(a, this->Segments[s]) && this->isNear(b, this->Segments[s]); });
  }

private:
  struct Segment
  {
    Position A;
    Position B;
  };

  std::int64_t cellOf(double value, std::size_t axis) const
  {
    // Halved, because the difference could overflow.
    const double length = this->High[axis] / 2 - this->Low[axis] / 2;
    const double part = (value / 2 - this->Low[axis] / 2) / length;
    return part > 0
      ? std::min(std::int64_t(std::min(part, 1.0) * double(this->Side)), this->Side - 1)
      : 0;
  }

  /// Visits the cells that a segment crosses and their neighbours.
  template <typename Visit>
  void visitCells(const Segment& segment, const Visit& visit) const
  {
    const auto clamped = [this](std::int64_t cell)
    { return std::clamp<std::int64_t>(cell, 0, this->Side - 1); };
    const auto [bottom, top] =
      std::minmax({ this->cellOf(segment.A.y, 1), this->cellOf(segment.B.y, 1) });
    const double height = this->High[1] / 2 - this->Low[1] / 2;
    const double rise = segment.B.y / 2 - segment.A.y / 2;
    // Returns the column of the segment at the lower border of a row of cells.
    const auto columnAt = [&](std::int64_t row)
    {
      const double y = this->Low[1] / 2 + height * (double(row) / double(this->Side));
      const double part = rise == 0 ? 0 : std::clamp((y - segment.A.y / 2) / rise, 0.0, 1.0);
      return this->cellOf(segment.A.x + 2 * part * (segment.B.x / 2 - segment.A.x / 2), 0);
    };
    for (std::int64_t row = clamped(bottom - 1); row <= clamped(top + 1); ++row)
    {
      const auto [left, right] = rise == 0
        ? std::minmax({ this->cellOf(segment.A.x, 0), this->cellOf(segment.B.x, 0) })
        : std::minmax({ columnAt(row - 1), columnAt(row), columnAt(row + 1), columnAt(row + 2) });
      for (std::int64_t column = clamped(left - 1); column <= clamped(right + 1); ++column)
      {
        visit(std::size_t(row * this->Side + column));
      }
    }
  }

  bool isNear(Position p, const Segment& segment) const
  {
    const Position a = segment.A;
    const Position b = segment.B;
    const double tolerance = this->Tolerance;
    if (p.x < std::min(a.x, b.x) - tolerance || p.x > std::max(a.x, b.x) + tolerance ||
      p.y < std::min(a.y, b.y) - tolerance || p.y > std::max(a.y, b.y) + tolerance)
    {
      return false;
    }
    const double dx = b.x / 2 - a.x / 2;
    const double dy = b.y / 2 - a.y / 2;
    const double length = std::hypot(dx, dy);
    const double off = std::fabs(dx / length * (p.y - a.y) - dy / length * (p.x - a.x));
    return !(off > tolerance); // true if the computation has overflowed
  }

  std::vector<Segment> Segments;
  std::array<double, 2> Low{};
  std::array<double, 2> High{};
  double Tolerance = 0;
  std::int64_t Side = 1; ///< cells of the grid along each axis
  /// By cell: the start of its entries in InCells; one more entry at the end.
  std::vector<std::size_t> Starts;
  std::vector<std::uint32_t> InCells; ///< indices of Segments, cell by cell
};

} // namespace check
} // namespace tipp

#endif
