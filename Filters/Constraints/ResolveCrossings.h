// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResolveCrossings_h
#define tippResolveCrossings_h

#include "Constraints/Constraint.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

enum class CrossingRule
{
  Split, ///< two constraints that cross are split at a new point
  Refuse ///< an error
};

/// A new point where two constraints cross.
struct CrossingPoint
{
  Point2 Position;
  PointId A;       ///< It lies between these two, which come before it, on the constraint
  PointId B;       ///< of lower number,
  double Fraction; ///< this far from A to B.
  std::array<std::int64_t, 2> Constraints; ///< the lower first
};

/// Constraints none of which crosses another, except at points of both.
struct ResolvedConstraints
{
  std::vector<ConstraintPiece> Pieces;  ///< constraint by constraint, each from its A to its B
  std::vector<CrossingPoint> Crossings; ///< their ids follow those of the input's points
  int Rounds = 0;                       ///< of splitting
  std::int64_t NotFinite = 0;           ///< constraints left out: an end that is NaN or infinite
  std::int64_t ZeroLength = 0;          ///< left out: both ends at one position
};

/// The statistics of resolved constraints.
struct ConstraintFigures
{
  std::int64_t Constraints = 0; ///< as given
  std::int64_t Segments = 0;    ///< edges of constraints
  std::int64_t Crossings = 0;
  int Rounds = 0;             ///< of splitting crossings
  std::int64_t NotFinite = 0; ///< constraints left out

  ConstraintFigures() = default;
  ConstraintFigures(const ResolvedConstraints& resolved, std::size_t constraints)
    : Constraints(std::int64_t(constraints))
    , Segments(std::int64_t(resolved.Pieces.size()))
    , Crossings(std::int64_t(resolved.Crossings.size()))
    , Rounds(resolved.Rounds)
    , NotFinite(resolved.NotFinite)
  {
  }

  /// Calls visit(key, array, value) for each figure: `key` is its name in JSON files and Python,
  /// `array` that in VTK tables.
  template <typename Visit>
  void visit(const Visit& visit) const
  {
    visit("constraints", "Constraints", this->Constraints);
    visit("constraint_edges", "ConstraintEdges", this->Segments);
    visit("crossing_points", "CrossingPoints", this->Crossings);
    visit("crossing_rounds", "CrossingRounds", std::int64_t(this->Rounds));
  }
};

/// The constraints without those of length zero and those with ends that are not finite; they may
/// cross. Throws as resolveCrossings() for an id that no point has.
ResolvedConstraints takeConstraints(
  PointsView points, const std::vector<Constraint>& constraints, int threads);

/// What points and constraints are called in messages; empty: by their numbers.
struct ConstraintNames
{
  std::vector<PointId> Points;
  std::vector<std::int64_t> Constraints;
};

/// Rounds of splitting in which crossings are rounded to doubles, then to coarser grids.
constexpr int RoundsOfDoubles = 10;

/// Splits constraints where they cross: a crossing, rounded to doubles, becomes a point of both.
/// This is snap rounding (Hobby 1999) on the grid of doubles: a constraint that crosses others is
/// led through all ends and crossings of constraints that points of it would be rounded to, so that
/// it moves by half a unit in the last place of its coordinates at most. Throws
/// std::invalid_argument for an id that no point has and, where crossings are refused, for the
/// first one.
///
/// The grid of doubles is not uniform, so that parts may still cross; these crossings are rounded
/// and split too, in further rounds, each of which may move a constraint by half a unit more. It
/// ends: a crossing is rounded to a point in the bounding boxes of both parts that cross, so that
/// it is not an end of both, and a part that it splits becomes parts with smaller boxes; and there
/// are finitely many boxes whose corners are doubles.
///
/// That could take long where constraints are within a unit of each other over many orders of
/// magnitude. So after ten rounds units are those of the largest end, and twice as large in each
/// further round. When they are larger than all coordinates, crossings only combine coordinates
/// that are there: few rounds are left.
VTKTIPPFILTERS_EXPORT ResolvedConstraints resolveCrossings(PointsView points,
  const std::vector<Constraint>& constraints, CrossingRule rule, int threads,
  const ConstraintNames& names = {});

} // namespace tipp

#endif
