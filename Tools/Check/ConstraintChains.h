// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintChains_h
#define tippConstraintChains_h

#include "Check/DelaunayChecker.h"
#include "Check/ExactTests.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The constraints, as chains of edges of a mesh.
struct ConstraintChains
{
  std::vector<FixedEdge> Edges; ///< sorted, without duplicates
  std::int64_t Lost = 0;        ///< number of constraints without a chain
};

/// Finds for each constraint a chain of edges between its two points. Each vertex of the chain must
/// lie within two units in the last place of the constraint's coordinates, tested in exact
/// arithmetic. Constraints whose ends are equal or not finite need no chain. `xy` holds x and y of
/// each point; `triangles` (three each) and `constraints` hold indices of these points. `isCut`:
/// the mesh ends at polygons, so chains may have gaps between vertices of its border.
ConstraintChains findConstraintChains(const std::vector<double>& xy,
  const std::vector<std::int64_t>& triangles,
  const std::vector<std::array<std::int64_t, 2>>& constraints, bool isCut = false);

/// Finds the edges of a large mesh that may be parts of constraints, so that only these are kept in
/// memory. It may keep too many edges, but must not miss one, which would be reported as a lost
/// constraint.
class NearConstraints
{
public:
  /// `xy`: x and y of each point. `edges`: two indices of points each. Both are copied.
  NearConstraints(
    const std::vector<double>& xy, const std::vector<std::array<std::int64_t, 2>>& edges);

  /// Returns whether both ends of an edge are within about a million rounding errors of one
  /// constraint.
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
  std::int64_t Side = 1; ///< cells of the grid along each axis
  /// By cell: the start of its entries in InCells; one more entry at the end.
  std::vector<std::size_t> Starts;
  std::vector<std::uint32_t> InCells; ///< indices of Segments, cell by cell
};

} // namespace tipp

#endif
