// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNearConstraints_h
#define tippNearConstraints_h

#include "Check/ExactTests.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Tells which edges of a large mesh may be parts of constraints, so that only these are kept. Too
/// many may be; too few would be reported as lost constraints.
class NearConstraints
{
public:
  /// xy: x and y of points; edges: two indices each.
  NearConstraints(
    const std::vector<double>& xy, const std::vector<std::array<std::int64_t, 2>>& edges);

  /// Whether both ends of an edge lie within about a million rounding errors of one constraint.
  bool mayHave(check::Position a, check::Position b) const;

private:
  struct Segment
  {
    check::Position A;
    check::Position B;
  };
  template <typename Visit>
  void visitCells(const Segment& segment, const Visit& visit) const;
  std::int64_t cellOf(double value, std::size_t axis) const;
  bool isNear(check::Position p, const Segment& segment) const;

  std::vector<Segment> Segments;
  std::array<double, 2> Low{};
  std::array<double, 2> High{};
  double Tolerance = 0;
  std::int64_t Side = 1;              ///< cells along each axis
  std::vector<std::size_t> Starts;    ///< of each cell's, and the end
  std::vector<std::uint32_t> InCells; ///< segments
};

} // namespace tipp

#endif
