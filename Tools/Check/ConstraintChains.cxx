// SPDX-License-Identifier: BSD-3-Clause
#include "Check/ConstraintRoute.h"
#include "Check/DelaunayChecker.h"
#include "Check/NearConstraints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace tipp
{
namespace
{

using check::ConstraintRoutes;
using check::MeshEdges;
using check::Position;
using check::Route;
using check::RoutePreference;
using check::RouteSetting;
using Ids = std::vector<std::int64_t>;

/// Chooses a route for each constraint. Where several are possible, the constraints together must
/// pass all edges that must be on constraints.
class ChainFinder
{
public:
  /// `wideReach`: as in RouteSetting.
  ChainFinder(const MeshEdges& mesh, const ConstraintsInMesh& constraints,
    std::optional<Position> wideReach = {})
    : Given(constraints)
    , Mesh(mesh)
    , Setting{ Mesh, [this](std::int64_t vertex) { return this->attracts(vertex); }, {},
      constraints.IsCut, wideReach }
  {
    if (constraints.IsCut)
    {
      this->Setting.Border = this->Mesh.borderVertices();
    }
    for (const FixedEdge& edge : constraints.Edges)
    {
      if (this->needsChain(edge))
      {
        this->Ends.push_back(this->Mesh.vertexAt(this->Mesh.at(edge[0])));
        this->Ends.push_back(this->Mesh.vertexAt(this->Mesh.at(edge[1])));
      }
    }
    sortUnique(this->Ends);
  }

  ConstraintChains find()
  {
    ConstraintChains chains;
    for (std::size_t i = 0; i < this->Given.Edges.size(); ++i)
    {
      chains.Lost += this->needsChain(this->Given.Edges[i]) && !this->findFirst(i) ? 1 : 0;
    }
    this->chooseAmongSeveral();
    this->straighten();
    chains.UndecidedEdges = this->uncovered();
    chains.UndecidedConstraints = this->countUnproved();
    for (const ChainEdge& edge : this->Edges)
    {
      chains.Edges.push_back(edge.Ends);
    }
    for (const Choice& choice : this->Choices)
    {
      visitEdges(choice.Way, [&chains](const FixedEdge& edge) { chains.Edges.push_back(edge); });
    }
    for (const auto& [edge, constraints] : this->Needed)
    {
      chains.Edges.push_back(edge);
    }
    sortUnique(chains.Edges);
    return chains;
  }

private:
  /// The route of a constraint that may have been moved.
  struct Choice
  {
    std::size_t Constraint;
    Route Way;
    bool IsOneOfSeveral;
  };

  struct ChainEdge
  {
    FixedEdge Ends;
    std::size_t Constraint;
  };

  /// A vertex on the route of a constraint.
  using Passing = std::pair<std::int64_t, std::size_t>;

  template <typename Value>
  static void sortUnique(std::vector<Value>& values)
  {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }

  static FixedEdge sorted(std::int64_t a, std::int64_t b)
  {
    return { std::min(a, b), std::max(a, b) };
  }

  template <typename Visit>
  static void visitEdges(const Route& route, const Visit& visit)
  {
    for (std::size_t i = 1; i < route.Vertices.size(); ++i)
    {
      if (!route.IsGap[i - 1])
      {
        visit(sorted(route.Vertices[i - 1], route.Vertices[i]));
      }
    }
  }

  bool attracts(std::int64_t vertex) const
  {
    return this->Given.IsAdded(vertex) ||
      std::binary_search(this->Ends.begin(), this->Ends.end(), vertex);
  }

  bool needsChain(const FixedEdge& constraint) const
  {
    const Position a = this->Mesh.at(constraint[0]);
    const Position b = this->Mesh.at(constraint[1]);
    return check::isFinite(a) && check::isFinite(b) && (a.x != b.x || a.y != b.y);
  }

  ConstraintRoutes routesOf(std::size_t constraint) const
  {
    const FixedEdge& edge = this->Given.Edges[constraint];
    return { this->Setting, this->Mesh.at(edge[0]), this->Mesh.at(edge[1]) };
  }

  /// Finds the route of a constraint, or one of several. Returns false if there is none.
  bool findFirst(std::size_t constraint)
  {
    const ConstraintRoutes routes = this->routesOf(constraint);
    if (!routes.exist())
    {
      return false;
    }
    Route route =
      routes.best([](std::int64_t, std::int64_t) { return 0; }, RoutePreference::Explained);
    const bool areSeveral = routes.areSeveral();
    if (areSeveral || route.Unexplained > 0 || routes.meetRounding())
    {
      this->Choices.push_back({ constraint, std::move(route), areSeveral });
    }
    else
    {
      visitEdges(route,
        [&](const FixedEdge& edge) {
          this->Edges.push_back({ edge, constraint });
        });
    }
    if (areSeveral)
    {
      routes.visitEdges(
        [this](std::int64_t from, std::int64_t to)
        {
          if (this->Mesh.needsConstraint(from, to, this->Given.TieRule, this->Given.IsCut))
          {
            this->Needed.emplace(sorted(from, to), 0);
          }
        });
    }
    return true;
  }

  /// Adds `change` to the number of constraints that pass an edge, if it is a needed one.
  void count(const FixedEdge& edge, std::int64_t change)
  {
    const auto found = this->Needed.find(edge);
    if (found != this->Needed.end())
    {
      found->second += change;
    }
  }

  void count(const Route& route, std::int64_t change)
  {
    visitEdges(route, [&](const FixedEdge& edge) { this->count(edge, change); });
  }

  /// Returns the number of needed edges that no constraint passes.
  std::int64_t uncovered() const
  {
    return std::count_if(this->Needed.begin(), this->Needed.end(),
      [](const auto& needed) { return needed.second == 0; });
  }

  /// Chooses again, constraint by constraint, as long as this covers more of the needed edges:
  /// first only among the routes with the fewest unexplained vertices, then among all.
  void chooseAmongSeveral()
  {
    for (const ChainEdge& edge : this->Edges)
    {
      this->count(edge.Ends, 1);
    }
    for (const Choice& choice : this->Choices)
    {
      this->count(choice.Way, 1);
    }
    constexpr int mostPasses = 16;
    for (const RoutePreference preference : { RoutePreference::Explained, RoutePreference::Gain })
    {
      std::int64_t before = std::numeric_limits<std::int64_t>::max();
      for (int pass = 0; pass < mostPasses && this->uncovered() < before; ++pass)
      {
        before = this->uncovered();
        for (std::size_t i = 0; i < this->Choices.size() && before > 0; ++i)
        {
          if (this->Choices[i].IsOneOfSeveral)
          {
            this->chooseAgain(this->Choices[i], preference);
          }
        }
      }
    }
  }

  /// Chooses the route that covers the most needed edges that no other constraint covers, if this
  /// is what `preference` says.
  void chooseAgain(Choice& choice, RoutePreference preference)
  {
    this->count(choice.Way, -1);
    const auto gain = [this](std::int64_t from, std::int64_t to) -> std::int64_t
    {
      const auto found = this->Needed.find(sorted(from, to));
      return found != this->Needed.end() && found->second == 0 ? 1 : 0;
    };
    choice.Way = this->routesOf(choice.Constraint).best(gain, preference);
    this->count(choice.Way, 1);
  }

  /// Takes the straightest routes where others are not proved, unless fewer needed edges are
  /// covered then.
  void straighten()
  {
    this->findPassings();
    const std::int64_t before = this->uncovered();
    for (Choice& choice : this->Choices)
    {
      if (choice.IsOneOfSeveral && !this->isProved(choice))
      {
        Choice other = choice;
        this->chooseAgain(other, RoutePreference::Straight);
        if (this->uncovered() > before || !this->isProved(other))
        {
          this->count(other.Way, -1);
          this->count(choice.Way, 1);
          continue;
        }
        choice = std::move(other);
      }
    }
  }

  /// Finds which constraints pass the vertices that choices pass or round to.
  void findPassings()
  {
    Ids vertices;
    for (const Choice& choice : this->Choices)
    {
      vertices.insert(vertices.end(), choice.Way.Vertices.begin(), choice.Way.Vertices.end());
      this->routesOf(choice.Constraint)
        .visitRounding([&](std::int64_t vertex, Position) { vertices.push_back(vertex); });
    }
    sortUnique(vertices);
    this->Passings.clear();
    const auto add = [&](const FixedEdge& edge, std::size_t constraint)
    {
      for (const std::int64_t end : edge)
      {
        if (std::binary_search(vertices.begin(), vertices.end(), end))
        {
          this->Passings.push_back({ end, constraint });
        }
      }
    };
    for (const ChainEdge& edge : this->Edges)
    {
      add(edge.Ends, edge.Constraint);
    }
    for (const Choice& choice : this->Choices)
    {
      visitEdges(choice.Way, [&](const FixedEdge& edge) { add(edge, choice.Constraint); });
    }
    sortUnique(this->Passings);
  }

  /// Counts the routes that are not proved to be right.
  std::int64_t countUnproved()
  {
    this->findPassings();
    return std::count_if(this->Choices.begin(), this->Choices.end(),
      [this](const Choice& choice) { return !this->isProved(choice); });
  }

  /// Calls visit(constraint) for each other constraint whose route passes a vertex. Returns true
  /// as soon as visit() does.
  template <typename Visit>
  bool anyOther(std::int64_t vertex, std::size_t constraint, const Visit& visit) const
  {
    auto passing =
      std::lower_bound(this->Passings.begin(), this->Passings.end(), Passing{ vertex, 0 });
    for (; passing != this->Passings.end() && passing->first == vertex; ++passing)
    {
      if (passing->second != constraint && visit(passing->second))
      {
        return true;
      }
    }
    return false;
  }

  /// Returns whether a route is the one that the rule of crossings prescribes. A constraint is
  /// split at the input points on it. A part that crosses another constraint passes all vertices of
  /// constraints to which it rounds; other parts are not moved.
  bool isProved(const Choice& choice) const
  {
    const Route& route = choice.Way;
    const auto attracts = [&](std::int64_t vertex)
    {
      return this->attracts(vertex) ||
        this->anyOther(vertex, choice.Constraint, [](std::size_t) { return true; });
    };
    if (route.hasGap()) // crossings may be outside of the mesh
    {
      return route.Unexplained == 0;
    }
    if (!check::isExplained(route, attracts))
    {
      return false;
    }
    const ConstraintRoutes routes = this->routesOf(choice.Constraint);
    Ids passed = route.Vertices;
    std::sort(passed.begin(), passed.end());
    std::vector<Position> leftOut;
    routes.visitRounding(
      [&](std::int64_t vertex, Position at)
      {
        const bool isPassed = std::binary_search(passed.begin(), passed.end(), vertex);
        // Added points may have been added later.
        if (!isPassed && !this->Given.IsAdded(vertex) && attracts(vertex))
        {
          leftOut.push_back(at);
        }
      });
    const check::SnappedLine line(route.Positions.front(), route.Positions.back());
    std::sort(leftOut.begin(), leftOut.end(),
      [&line](Position p, Position q) { return line.isBefore(p, q); });
    std::size_t first = 0;
    for (std::size_t i = 1; i < route.Vertices.size(); ++i)
    {
      const bool isLast = i + 1 == route.Vertices.size();
      if (isLast || (line.holds(route.Positions[i]) && !this->Given.IsAdded(route.Vertices[i])))
      {
        if (!this->isPartProved(choice, line, leftOut, first, i))
        {
          return false;
        }
        first = i;
      }
    }
    return true;
  }

  /// Whether a part of a route, between its vertices `first` and `last`, is proved. `near`: the
  /// input points at ends of constraints to which the constraint rounds, but which it does not
  /// pass, in its order.
  bool isPartProved(const Choice& choice, const check::SnappedLine& line,
    const std::vector<Position>& near, std::size_t first, std::size_t last) const
  {
    const std::vector<Position>& at = choice.Way.Positions;
    const auto isCrossed = [&](bool byParts)
    {
      for (std::size_t i = first + 1; i < last; ++i)
      {
        const bool isFound = this->anyOther(choice.Way.Vertices[i], choice.Constraint,
          [&](std::size_t other) { return this->crosses(other, byParts, at[first], at[last]); });
        if (isFound)
        {
          return true;
        }
      }
      return false;
    };
    const bool isMoved = std::any_of(at.begin() + std::ptrdiff_t(first) + 1,
      at.begin() + std::ptrdiff_t(last), [&](Position p) { return !line.holds(p); });
    const auto next = std::upper_bound(near.begin(), near.end(), at[first],
      [&line](Position p, Position q) { return line.isBefore(p, q); });
    const bool leavesOut = next != near.end() && line.isBefore(*next, at[last]);
    return (!isMoved || isCrossed(true)) && (!leavesOut || !isCrossed(false));
  }

  /// Returns whether a constraint crosses the segment from p to q. With `byParts` also whether a
  /// part of it between two vertices of its route does.
  bool crosses(std::size_t constraint, bool byParts, Position p, Position q) const
  {
    const auto doCross = [&](Position a, Position b)
    {
      return check::turn(a, b, p) * check::turn(a, b, q) < 0 &&
        check::turn(p, q, a) * check::turn(p, q, b) < 0;
    };
    const FixedEdge& edge = this->Given.Edges[constraint];
    if (doCross(this->Mesh.at(edge[0]), this->Mesh.at(edge[1])))
    {
      return true;
    }
    const auto choice = std::lower_bound(this->Choices.begin(), this->Choices.end(), constraint,
      [](const Choice& one, std::size_t wanted) { return one.Constraint < wanted; });
    constexpr std::size_t most = 64; // pairs of more would take long
    if (!byParts || choice == this->Choices.end() || choice->Constraint != constraint ||
      choice->Way.Positions.size() > most)
    {
      return false;
    }
    const std::vector<Position>& at = choice->Way.Positions;
    for (std::size_t i = 0; i < at.size(); ++i)
    {
      for (std::size_t k = i + 1; k < at.size(); ++k)
      {
        if (doCross(at[i], at[k]))
        {
          return true;
        }
      }
    }
    return false;
  }

  const ConstraintsInMesh& Given;
  const MeshEdges& Mesh;
  RouteSetting Setting;
  Ids Ends; ///< the vertices at ends of constraints, sorted
  std::vector<ChainEdge> Edges;
  std::vector<Choice> Choices;   ///< sorted by constraint
  std::vector<Passing> Passings; ///< at vertices that choices pass or round to, sorted
  /// The edges of several routes that must be on constraints, and how many constraints pass them.
  std::map<FixedEdge, std::int64_t> Needed;
};

/// How far 29 rounds of rounding can lead a constraint in x and y: 2^20 units in the last place of
/// the largest coordinate of constraints.
Position reachOfManyRounds(const MeshEdges& mesh, const std::vector<FixedEdge>& constraints)
{
  Position largest{ 0, 0 };
  for (const FixedEdge& edge : constraints)
  {
    for (const std::int64_t end : edge)
    {
      const Position p = mesh.at(end);
      largest = check::isFinite(p)
        ? Position{ std::max(largest.x, std::fabs(p.x)), std::max(largest.y, std::fabs(p.y)) }
        : largest;
    }
  }
  return { check::relativeReach * largest.x, check::relativeReach * largest.y };
}

/// Returns whether no constraint is lost, and the chains have all edges that must be constraints.
bool areComplete(
  const ConstraintChains& chains, const MeshEdges& mesh, const ConstraintsInMesh& constraints)
{
  return chains.Lost == 0 &&
    mesh.allEdges(
      [&](std::int64_t a, std::int64_t b)
      {
        return std::binary_search(chains.Edges.begin(), chains.Edges.end(),
                 FixedEdge{ std::min(a, b), std::max(a, b) }) ||
          !mesh.needsConstraint(a, b, constraints.TieRule, false);
      });
}

} // namespace

ConstraintChains findConstraintChains(const std::vector<double>& xy,
  const std::vector<std::int64_t>& triangles, const ConstraintsInMesh& constraints)
{
  const MeshEdges mesh(xy, triangles);
  ConstraintChains chains = ChainFinder(mesh, constraints).find();
  const bool hasCrossings = std::any_of(
    triangles.begin(), triangles.end(), [&](std::int64_t p) { return constraints.IsAdded(p); });
  return !hasCrossings || areComplete(chains, mesh, constraints)
    ? chains
    : ChainFinder(mesh, constraints, reachOfManyRounds(mesh, constraints.Edges)).find();
}

ConstraintChains findConstraintChains(std::size_t pieces,
  const std::function<CheckedPiece(std::size_t)>& read, const std::vector<double>& constraintXY,
  const ConstraintsInMesh& constraints)
{
  const check::NearConstraints near(constraintXY, constraints.Edges);
  std::vector<double> xy;
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> triangles;
  for (std::size_t number = 0; number < pieces; ++number)
  {
    const CheckedPiece piece = read(number);
    const auto at = [&piece](std::int64_t point)
    {
      const auto i = 2 * std::size_t(point);
      return Position{ piece.XY.at(i), piece.XY.at(i + 1) };
    };
    std::unordered_map<std::int64_t, std::int64_t> known;
    for (std::size_t t = 0; t < 3 * std::size_t(piece.OwnTriangles); t += 3)
    {
      const std::int64_t* const corners = &piece.Triangles[t];
      bool isNear = false;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const Position from = at(corners[i]);
        isNear = isNear || near.mayHave(from, constraints.IsCut ? from : at(corners[(i + 1) % 3]));
      }
      for (std::size_t i = 0; isNear && i < 3; ++i)
      {
        const auto [found, isNew] = known.emplace(corners[i], std::int64_t(ids.size()));
        if (isNew)
        {
          xy.insert(xy.end(), { at(corners[i]).x, at(corners[i]).y });
          ids.push_back(piece.Ids[std::size_t(corners[i])]);
        }
        triangles.push_back(found->second);
      }
    }
  }
  // A point may be in several pieces. The first one with its coordinates represents all.
  std::map<std::pair<double, double>, std::int64_t> positions;
  for (std::int64_t& corner : triangles)
  {
    const auto i = 2 * std::size_t(corner);
    corner = positions.emplace(std::make_pair(xy[i], xy[i + 1]), corner).first->second;
  }
  const auto own = std::int64_t(xy.size() / 2);
  xy.insert(xy.end(), constraintXY.begin(), constraintXY.end());
  ConstraintsInMesh among = constraints;
  for (FixedEdge& edge : among.Edges)
  {
    edge = { edge[0] + own, edge[1] + own };
  }
  among.IsAdded = [&](std::int64_t vertex)
  { return constraints.IsAdded(ids[std::size_t(vertex)]); };
  ConstraintChains chains = findConstraintChains(xy, triangles, among);
  for (FixedEdge& edge : chains.Edges)
  {
    const auto [low, high] = std::minmax({ ids[std::size_t(edge[0])], ids[std::size_t(edge[1])] });
    edge = { low, high };
  }
  std::sort(chains.Edges.begin(), chains.Edges.end());
  return chains;
}

} // namespace tipp
