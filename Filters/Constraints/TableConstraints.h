// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTableConstraints_h
#define tippTableConstraints_h

#include "Constraints/ReadConstraintFile.h"
#include "Constraints/ResolveCrossings.h"
#include "Triangulation/ResolveDuplicates.h"
#include "vtkTIPPFiltersModule.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

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
