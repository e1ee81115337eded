// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTableConstraints_h
#define tippTableConstraints_h

#include "Constraints/ReadConstraintFile.h"
#include "Constraints/TriangulateConstrained.h"
#include "Duplicates/ResolveDuplicates.h"
#include "Points/PointTable.h"
#include "vtkTIPPFiltersModule.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// What constrains the triangulation of a table of points, as files give it.
struct TableConstraints
{
  ConstraintTable Lines;    ///< with polygons and holes; perhaps none
  ConstraintTable Boundary; ///< closed lines, which are constraints, too; perhaps none
  CrossingRule Crossings = CrossingRule::Split;
  /// If it is given, new points have the values of the surface of the others where no height is
  /// given: of its triangle there, or NaN outside of it; at coincident points it has those of the
  /// rule. Else these are NaN.
  std::optional<DuplicateRule> Surface;
};

/// Whether a column of this name has the heights of constraints: z, Z or elevation.
bool isHeightColumn(const std::string& name);

/// The constrained Delaunay triangulation of the points and those of the constraints, which are
/// appended to the table unless they are there already, and then the crossings.
///
/// Triangles are removed outside of polygons, in holes, and outside of the boundary: a triangle is
/// inside if a way out of it crosses the boundary's lines an odd number of times. Throws
/// std::invalid_argument.
VTKTIPPFILTERS_EXPORT ConstrainedTriangulation triangulateTable(
  PointTable& points, const TableConstraints& constraints, const TriangulationOptions& options);

/// Files of constraints, and how they are used.
struct ConstraintFiles
{
  std::string Lines;    ///< a path; empty: none
  std::string Boundary; ///< the same
  std::vector<std::pair<double, double>>
    Holes; ///< x and y of points in holes, beside those of Lines
  CrossingRule Crossings = CrossingRule::Split;

  bool areGiven() const { return !this->Lines.empty() || !this->Boundary.empty(); }
  /// For messages.
  const std::string& name() const { return this->Lines.empty() ? this->Boundary : this->Lines; }
};

/// Throws IOError.
VTKTIPPFILTERS_EXPORT TableConstraints readConstraints(const ConstraintFiles& files);

/// Reads the closed lines of a boundary. Throws IOError.
VTKTIPPFILTERS_EXPORT ConstraintTable readBoundary(const std::string& path);

/// Throws std::invalid_argument unless the lines of a boundary are closed.
VTKTIPPFILTERS_EXPORT void requireClosedBoundary(const ConstraintTable& boundary);

} // namespace tipp

#endif
