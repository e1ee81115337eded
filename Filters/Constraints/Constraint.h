// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraint_h
#define tippConstraint_h

#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// A segment between two points that has to be an edge of the triangulation, or a chain of edges.
struct Constraint
{
  PointId A;
  PointId B;
};

/// A part of a constraint between two points, in the constraint's direction.
struct ConstraintPiece
{
  PointId A;
  PointId B;
  std::int64_t Constraint; ///< its number
};

/// Those of constraints begin to end - 1.
VTKTIPPFILTERS_EXPORT std::vector<ConstraintPiece> piecesOf(
  const std::vector<ConstraintPiece>& pieces, std::size_t begin, std::size_t end);

/// The edges of constraints, to be looked up.
class ConstraintEdges
{
public:
  explicit ConstraintEdges(const std::vector<ConstraintPiece>& pieces);

  bool contains(PointId a, PointId b) const;

  /// How many more constraints go from a to b than from b to a.
  int balance(PointId a, PointId b) const;

  /// How many constraints join the two.
  int count(PointId a, PointId b) const;

private:
  using Ends = std::pair<PointId, PointId>; ///< the lower first
  struct Edge
  {
    Ends Ids;
    int Direction; ///< 1 if the constraint goes from the lower end to the higher, else -1
  };

  bool mayContain(PointId lower) const
  {
    return this->IsLower[std::size_t(lower) % this->IsLower.size()] != 0;
  }
  std::vector<Edge>::const_iterator find(const Ends& ends) const;

  std::vector<Edge> Edges;   ///< by their ends
  std::vector<char> IsLower; ///< of ids, by their last digits: whether an edge has it as lower end
};

} // namespace tipp

#endif
