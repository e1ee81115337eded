// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintEdges_h
#define tippConstraintEdges_h

#include "Constraints/Constraint.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace tipp
{

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
