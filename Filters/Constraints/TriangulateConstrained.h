// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulateConstrained_h
#define tippTriangulateConstrained_h

#include "Constraints/ConstraintPieces.h"
#include "Constraints/ReadConstraintFile.h"
#include "Points/ReadPoints.h"
#include "Triangulation/ResolveDuplicates.h"
#include "vtkTIPPFiltersModule.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

struct ConstrainedTriangulation
{
  Triangulation Mesh; ///< of the points and, after them, the crossings
  /// The constraints as chains of edges between representatives of their vertices.
  ResolvedConstraints Constraints;
};

/// Computes the constrained Delaunay triangulation of the distinct finite points. Every constraint
/// is a chain of edges. A triangle's circumdisk contains no vertex that is visible from the
/// triangle's interior, where constraints block the view. Ties are broken as without constraints.
/// The set of triangles does not depend on the options or on the order. Throws like
/// resolveCrossings(). `cut` may remove triangles, for example outside polygons; it is called
/// before triangles with too long edges are removed.
VTKTIPPFILTERS_EXPORT ConstrainedTriangulation triangulateConstrained(PointsView points,
  const std::vector<Constraint>& constraints, CrossingRule crossings = CrossingRule::Split,
  const TriangulationOptions& options = {},
  const std::function<void(ConstrainedTriangulation&)>& cut = {});

/// The constraints of a triangulation of a table of points, as read from files.
struct TableConstraints
{
  ConstraintTable Lines;    ///< with polygons and holes; may be empty
  ConstraintTable Boundary; ///< closed lines, which are constraints too; may be empty
  CrossingRule Crossings = CrossingRule::Split;
  /// If set, new points without a given height get the value of the surface of the other points: of
  /// the triangle there, or NaN outside the surface. At equal points, the rule chooses the value.
  /// If not set, their values are NaN.
  std::optional<DuplicateRule> Surface;
};

/// Whether a column with this name has heights for constraints: z, Z or elevation.
bool isHeightColumn(const std::string& name);

/// Computes the constrained Delaunay triangulation of the points and of the constraints' points.
/// The latter are appended to the table unless they exist already, followed by the crossings.
///
/// Removes triangles outside polygons, in holes, and outside the boundary: a triangle is inside the
/// boundary if a path to it from outside crosses the boundary's lines an odd number of times.
/// Throws std::invalid_argument.
VTKTIPPFILTERS_EXPORT ConstrainedTriangulation triangulateTable(
  PointTable& points, const TableConstraints& constraints, const TriangulationOptions& options);

/// Files of constraints, and options for their use.
struct ConstraintFiles
{
  std::string Lines;    ///< path, or empty
  std::string Boundary; ///< path, or empty
  std::vector<std::pair<double, double>>
    Holes; ///< x and y of points in holes, in addition to those of Lines
  CrossingRule Crossings = CrossingRule::Split;
  int Wrap = 0; ///< PointOptions::Wrap

  bool areGiven() const { return !this->Lines.empty() || !this->Boundary.empty(); }
  /// The name of a file, for messages.
  const std::string& name() const { return this->Lines.empty() ? this->Boundary : this->Lines; }
};

/// Reads both files. Throws IOError.
VTKTIPPFILTERS_EXPORT TableConstraints readConstraints(const ConstraintFiles& files);

/// Reads the closed lines of a boundary. `wrap`: PointOptions::Wrap. Throws IOError.
VTKTIPPFILTERS_EXPORT ConstraintTable readBoundary(const std::string& path, int wrap = 0);

/// Throws std::invalid_argument unless all lines of a boundary are closed.
VTKTIPPFILTERS_EXPORT void requireClosedBoundary(const ConstraintTable& boundary);

} // namespace tipp

#endif
