// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSplitChains_h
#define tippSplitChains_h

#include "Check/ConstraintRoute.h"
#include "Check/ExactTests.h"
#include "Check/MeshEdges.h"

#include <array>
#include <optional>
#include <vector>

namespace tipp
{
namespace check
{

/// Finds segments of the input in a refined mesh, where each is a chain of edges. The inner
/// vertices are split points, which were computed in doubles, and crossings.
class SplitChains
{
public:
  /// The mesh must outlive this object.
  explicit SplitChains(const MeshEdges& mesh);

  /// Returns the chain of the segment from `a` to `b`, which are finite and differ; nullopt if
  /// there is none. The chain's edges lead forwards in both coordinates, and its vertices are
  /// within reach() of the segment. Where the segment is outside of the mesh, the chain has a gap:
  /// an end that is no vertex is MeshEdges::None. Of several chains, returns the one with the most
  /// edges that are not locally Delaunay or have one triangle only.
  /// Calls visit(from, to) for the edges of all such chains.
  template <typename Visit>
  std::optional<Route> find(Position a, Position b, const Visit& visit)
  {
    this->Setting.WideReach = reach(a, b);
    const ConstraintRoutes routes(this->Setting, a, b);
    std::optional<Route> chain = routes.exist() ? this->bestOf(routes) : std::nullopt;
    if (chain)
    {
      routes.visitEdges(visit);
    }
    return chain;
  }

  /// Returns how far in x and y vertices may lie from a segment: 2^-40 of the largest coordinate of
  /// its ends along that axis.
  static Position reach(Position a, Position b);

private:
  using BorderEdge = std::array<Position, 2>; ///< the western end first

  static bool isWestOf(const BorderEdge& a, const BorderEdge& b)
  {
    return a.front().x < b.front().x;
  }
  std::optional<Route> bestOf(const ConstraintRoutes& routes) const;
  bool crossesMesh(const Route& route) const;
  bool crossesBorder(Position from, Position to, const SnappedLine& line) const;

  const MeshEdges& Mesh;
  RouteSetting Setting;
  std::vector<BorderEdge> BorderEdges; ///< sorted by their western ends
  double Widest = 0;                   ///< the largest difference of the ends' x
};

} // namespace check
} // namespace tipp

#endif
