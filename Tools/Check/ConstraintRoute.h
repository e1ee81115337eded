// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintRoute_h
#define tippConstraintRoute_h

#include "Check/MeshEdges.h"
#include "Check/SnappedLine.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

namespace tipp
{
namespace check
{

/// What all constraints of a mesh have in common.
struct RouteSetting
{
  const MeshEdges& Mesh;
  /// Whether a point attracts constraints that round to it: an end of a constraint, or a point that
  /// the mesh has more than the input, where constraints cross. Others must be on the line.
  std::function<bool(std::int64_t)> Attracts;
  /// If the mesh is cut: the vertices of its border, sorted by position; else empty.
  std::vector<std::int64_t> Border;
  bool IsCut = false;
  /// How far rounding may have led a constraint, in x and y; by default as far as 16 rounds can.
  std::optional<Position> WideReach = {};
  /// Whether a constraint passes each vertex that is so near, even if it does not round to it and
  /// the vertex does not attract it.
  bool PassesAllNear = false;
};

/// A way along edges of the mesh.
struct Route
{
  std::vector<std::int64_t> Vertices; ///< from end to end; MeshEdges::None: an end outside of it
  std::vector<Position> Positions;    ///< of the vertices
  /// Whether a gap follows the vertex, instead of an edge: the constraint is outside of the mesh.
  std::vector<bool> IsGap;
  /// The number of vertices to which the constraint does not round, and of border vertices that
  /// gaps leave out.
  std::int64_t Unexplained = 0;

  bool hasGap() const
  {
    return std::find(this->IsGap.begin(), this->IsGap.end(), true) != this->IsGap.end();
  }
};

/// Which of several routes is the best. Ties are broken in favour of the most vertices.
enum class RoutePreference
{
  Explained, ///< the fewest unexplained vertices, then the largest gain
  Gain,      ///< the largest gain, then the fewest unexplained vertices
  Straight   ///< the fewest vertices that are not on the constraint, then the largest gain
};

/// All ways along edges of the mesh on which rounding may have led a constraint. They lead forwards
/// in both coordinates, so they are an acyclic graph, and a search takes time in proportion to its
/// size.
class ConstraintRoutes
{
public:
  using Gain = std::function<std::int64_t(std::int64_t, std::int64_t)>;

  /// `a` and `b`: the ends, which are finite and differ. They need not be vertices in a cut mesh.
  ConstraintRoutes(const RouteSetting& setting, Position a, Position b);

  bool exist() const { return !this->Nodes.empty() && this->Nodes.front().LeadsToEnd; }
  /// Returns whether there are several routes.
  bool areSeveral() const;

  /// Calls visit(from, to) for each edge of the mesh on a route.
  template <typename Visit>
  void visitEdges(const Visit& visit) const
  {
    for (const Node& node : this->Nodes)
    {
      for (const Step& step : node.Steps)
      {
        if (!step.IsGap && this->Nodes[step.To].LeadsToEnd)
        {
          visit(node.Vertex, this->Nodes[step.To].Vertex);
        }
      }
    }
  }

  /// Returns whether the constraint rounds to a vertex that is not on it.
  bool meetRounding() const
  {
    return std::any_of(this->Nodes.begin(), this->Nodes.end(),
      [](const Node& node) { return node.Rounds && !node.IsOn; });
  }

  /// Calls visit(vertex, position) for each vertex found to which the constraint rounds.
  template <typename Visit>
  void visitRounding(const Visit& visit) const
  {
    for (const Node& node : this->Nodes)
    {
      if (node.Rounds)
      {
        visit(node.Vertex, node.At);
      }
    }
  }

  /// Returns the best route. Routes must exist. `gain(from, to)`: of an edge, to be summed.
  Route best(const Gain& gain, RoutePreference preference) const;

private:
  struct Step
  {
    std::size_t To; ///< index of a node
    bool IsGap;
    std::int64_t Skipped; ///< border vertices that the gap leaves out
  };

  struct Node
  {
    std::int64_t Vertex; ///< None: an end outside of the mesh
    Position At;
    bool IsOn;        ///< the constraint
    bool Rounds;      ///< the constraint rounds to it
    bool IsExplained; ///< and it attracts constraints, or the setting says that it is passed
    bool LeadsToEnd = false;
    std::vector<Step> Steps = {};
  };

  bool isBetween(Position p) const;
  Node makeNode(std::int64_t vertex, Position at) const;
  bool areBeside(Position p, Position q) const;
  std::size_t nodeOf(std::int64_t vertex);
  void addEdges(std::size_t from);
  bool isAtBorder(std::int64_t vertex, Position p) const;
  void addGaps(std::size_t from, const std::vector<std::int64_t>& border);
  std::vector<std::int64_t> borderNear() const;
  void markNodesThatReachEnd();

  static constexpr std::int64_t None = MeshEdges::None;

  const RouteSetting& Setting;
  const Position A;
  const Position B;
  const SnappedLine Line;
  std::vector<Node> Nodes; ///< the first one is the start, the second the end
  std::unordered_map<std::int64_t, std::size_t> NodeOf; ///< by vertex
  std::vector<std::size_t> Order; ///< indices of the nodes, in the order of the constraint
};

/// Returns whether rounding explains a route, in any number of rounds: the constraint rounds to
/// some of the vertices, each part between two of these to some of those between them, and so on
/// until each part is an edge. `attracts(vertex)`: whether a part that rounds to the vertex passes
/// it.
bool isExplained(const Route& route, const std::function<bool(std::int64_t)>& attracts);

} // namespace check
} // namespace tipp

#endif
