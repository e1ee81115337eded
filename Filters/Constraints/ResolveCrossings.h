// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResolveCrossings_h
#define tippResolveCrossings_h

#include "Constraints/ConstraintEdges.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace tipp
{

/// Thrown if segments cross that should have been split at all crossings.
struct CrossingFound : std::logic_error
{
  CrossingFound()
    : std::logic_error("A constraint crosses another one.")
  {
  }
};

enum class CrossingRule
{
  Split, ///< constraints that cross are split at a new point
  Refuse ///< constraints that cross are an error
};

/// A new point where two constraints cross.
struct CrossingPoint
{
  Point2 Position;
  PointId A;       ///< it lies between A and B, on the constraint of lower index;
  PointId B;       ///< both have lower ids than the crossing
  double Fraction; ///< the fraction of the way from A to B
};

/// Constraints that cross each other only at common points.
struct ResolvedConstraints
{
  std::vector<IdSegment> Segments;      ///< sorted by constraint, each from its A to its B
  std::vector<CrossingPoint> Crossings; ///< their ids follow those of the input's points
  std::vector<char> Crosses;            ///< by constraint: 1 if it crosses others; if resolved
  int Rounds = 0;                       ///< rounds of splitting
  std::int64_t NotFinite = 0;           ///< constraints left out: an end is not finite
};

/// The statistics of resolved constraints.
struct ConstraintFigures
{
  std::int64_t Constraints = 0; ///< number of given constraints
  std::int64_t Segments = 0;    ///< number of edges on constraints
  std::int64_t Crossings = 0;
  int Rounds = 0;             ///< rounds of splitting at crossings
  std::int64_t NotFinite = 0; ///< number of constraints left out

  ConstraintFigures() = default;
  ConstraintFigures(const ResolvedConstraints& resolved, std::size_t constraints)
    : Constraints(std::int64_t(constraints))
    , Segments(std::int64_t(resolved.Segments.size()))
    , Crossings(std::int64_t(resolved.Crossings.size()))
    , Rounds(resolved.Rounds)
    , NotFinite(resolved.NotFinite)
  {
  }

  /// Calls visit(key, array, value) for each figure. `key` is its name in JSON files and Python,
  /// `array` its name in VTK tables.
  template <typename Visit>
  void visit(const Visit& visit) const
  {
    visit("constraints", "Constraints", this->Constraints);
    visit("constraint_edges", "ConstraintEdges", this->Segments);
    visit("crossing_points", "CrossingPoints", this->Crossings);
    visit("crossing_rounds", "CrossingRounds", std::int64_t(this->Rounds));
  }
};

/// The constraints without those that have equal ends or ends that are not finite. They may cross.
/// Throws like resolveCrossings() for an invalid point id.
ResolvedConstraints takeConstraints(
  PointsView points, const std::vector<Constraint>& constraints, int threads);

/// How messages identify points and constraints; if empty, by their indices.
struct ConstraintNames
{
  std::vector<PointId> Points;
  std::vector<std::int64_t> Constraints;
};

/// After this many rounds, crossings are rounded to coarser grids than that of doubles.
constexpr int RoundsOfDoubles = 10;

/// Splits constraints where they cross. Those that cross others are first split at the points that
/// lie exactly on them; so two that cross at a point have it in common, and need no other. A
/// crossing is rounded to doubles and becomes a point of both constraints. If it rounds to the
/// position of a point, it is this point, of equal ones the first.
///
/// This is snap rounding (Hobby 1999) on the grid of doubles: a part that crosses others is led
/// through all vertices of constraints to which points on it round. So each vertex of a constraint
/// is one of its points, moved by at most half a unit in the last place of the vertex's
/// coordinates. Throws std::invalid_argument for an invalid point id and, if `rule` refuses
/// crossings, for the first crossing.
///
/// The grid of doubles is not uniform, so parts may cross again. These crossings are rounded and
/// split in further rounds, each of which may move a constraint by another half unit. The rounds
/// end: a crossing is rounded to a point in the bounding boxes of both parts, but not to an end of
/// both. So at least one part is split into parts with smaller boxes, and there are finitely many
/// boxes with doubles as corners.
///
/// This may take long if constraints are within a unit of each other over many orders of magnitude.
/// So after ten rounds, all units are those of the largest end, and they double in each further
/// round. Once they exceed all coordinates, crossings only combine existing coordinates, and few
/// rounds remain.
VTKTIPPFILTERS_EXPORT ResolvedConstraints resolveCrossings(PointsView points,
  const std::vector<Constraint>& constraints, CrossingRule rule, int threads,
  const ConstraintNames& names = {});

} // namespace tipp

#endif
