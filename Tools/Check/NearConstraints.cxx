// SPDX-License-Identifier: BSD-3-Clause
#include "Check/NearConstraints.h"

#include <algorithm>
#include <cmath>

namespace tipp
{

using check::Position;

NearConstraints::NearConstraints(
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
    const double sum = segment.A.x + segment.A.y + segment.B.x + segment.B.y;
    if (std::isnan(sum) || std::isinf(segment.A.x) || std::isinf(segment.A.y) ||
      std::isinf(segment.B.x) || std::isinf(segment.B.y))
    {
      continue; // such constraints are left out
    }
    this->Segments.push_back(segment);
    for (const Position p : { segment.A, segment.B })
    {
      this->Low = { std::min(this->Low[0], p.x), std::min(this->Low[1], p.y) };
      this->High = { std::max(this->High[0], p.x), std::max(this->High[1], p.y) };
      largest = std::max({ largest, std::fabs(p.x), std::fabs(p.y) });
    }
  }
  constexpr double relative = 1e-10;
  this->Tolerance = relative * largest;
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
    this->visitCells(
      this->Segments[i], [&](std::size_t cell) { this->InCells[next[cell]++] = std::uint32_t(i); });
  }
}

std::int64_t NearConstraints::cellOf(double value, std::size_t axis) const
{
  // Halves, since a difference may overflow.
  const double length = this->High[axis] / 2 - this->Low[axis] / 2;
  const double part = (value / 2 - this->Low[axis] / 2) / length;
  return part > 0 ? std::min(std::int64_t(std::min(part, 1.0) * double(this->Side)), this->Side - 1)
                  : 0;
}

/// The cells of a segment and those beside them.
template <typename Visit>
void NearConstraints::visitCells(const Segment& segment, const Visit& visit) const
{
  const auto clamped = [this](std::int64_t cell)
  { return std::clamp<std::int64_t>(cell, 0, this->Side - 1); };
  const auto [bottom, top] =
    std::minmax({ this->cellOf(segment.A.y, 1), this->cellOf(segment.B.y, 1) });
  const double height = this->High[1] / 2 - this->Low[1] / 2;
  const double rise = segment.B.y / 2 - segment.A.y / 2;
  // Where the segment is when it is at the lower border of a row.
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

bool NearConstraints::isNear(Position p, const Segment& segment) const
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
  return !(off > tolerance); // also after an overflow
}

bool NearConstraints::mayHave(Position a, Position b) const
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

} // namespace tipp
