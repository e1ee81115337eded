// SPDX-License-Identifier: BSD-3-Clause
#include "Check/ConstraintRoute.h"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace tipp
{
namespace check
{
namespace
{

constexpr std::size_t start = 0;
constexpr std::size_t end = 1;

} // namespace

ConstraintRoutes::ConstraintRoutes(const RouteSetting& setting, Position a, Position b)
  : Setting(setting)
  , A(a)
  , B(b)
  , Line(a, b, setting.WideReach)
{
  for (const Position p : { a, b })
  {
    const std::int64_t vertex = setting.Mesh.vertexAt(p);
    if (vertex == None && !setting.IsCut)
    {
      this->Nodes.clear();
      return;
    }
    this->Nodes.push_back({ vertex, p, true, true, true });
    if (vertex != None)
    {
      this->NodeOf.emplace(vertex, this->Nodes.size() - 1);
    }
  }
  for (std::size_t i = 0; i < this->Nodes.size(); ++i)
  {
    this->addEdges(i);
  }
  this->markNodesThatReachEnd();
  if (!this->exist() && setting.IsCut)
  {
    const std::vector<std::int64_t> border = this->borderNear();
    const std::size_t found = this->Nodes.size();
    for (std::size_t i = 0; i < this->Nodes.size(); ++i)
    {
      if (i >= found)
      {
        this->addEdges(i);
      }
      this->addGaps(i, border);
    }
    this->markNodesThatReachEnd();
  }
}

bool ConstraintRoutes::isBetween(Position p) const
{
  return (isSame(p, this->A) || this->Line.isBefore(this->A, p)) &&
    (isSame(p, this->B) || this->Line.isBefore(p, this->B));
}

ConstraintRoutes::Node ConstraintRoutes::makeNode(std::int64_t vertex, Position at) const
{
  const bool isOn = this->Line.holds(at);
  const bool rounds = isOn || this->Line.roundsTo(at);
  const bool isExplained =
    isOn || this->Setting.PassesAllNear || (rounds && this->Setting.Attracts(vertex));
  return { vertex, at, isOn, rounds, isExplained };
}

bool ConstraintRoutes::areBeside(Position p, Position q) const
{
  // More than rounding moves a point: 4,096 units in the last place of the largest coordinate.
  constexpr double part = 0x1p-40;
  const double largest = std::max(
    { std::fabs(this->A.x), std::fabs(this->A.y), std::fabs(this->B.x), std::fabs(this->B.y) });
  return std::fabs(p.x - q.x) <= part * largest && std::fabs(p.y - q.y) <= part * largest;
}

std::size_t ConstraintRoutes::nodeOf(std::int64_t vertex)
{
  const auto [found, isNew] = this->NodeOf.emplace(vertex, this->Nodes.size());
  if (isNew)
  {
    this->Nodes.push_back(this->makeNode(vertex, this->Setting.Mesh.at(vertex)));
  }
  return found->second;
}

void ConstraintRoutes::addEdges(std::size_t from)
{
  const std::int64_t vertex = this->Nodes[from].Vertex;
  if (vertex == None)
  {
    return;
  }
  const Position here = this->Setting.Mesh.at(vertex);
  this->Setting.Mesh.visitNeighbors(vertex,
    [&](std::int64_t next)
    {
      const Position there = this->Setting.Mesh.at(next);
      if (this->Line.isBefore(here, there) && this->isBetween(there) && this->Line.reaches(there))
      {
        const std::size_t to = this->nodeOf(next); // may move the nodes
        this->Nodes[from].Steps.push_back({ to, false, 0 });
      }
    });
}

/// Returns the border vertices that the constraint may pass, in its order.
std::vector<std::int64_t> ConstraintRoutes::borderNear() const
{
  const MeshEdges& mesh = this->Setting.Mesh;
  const auto [west, east] = std::minmax({ this->A.x, this->B.x });
  auto vertex = std::lower_bound(this->Setting.Border.begin(), this->Setting.Border.end(), west,
    [&mesh](std::int64_t v, double x) { return mesh.at(v).x < x; });
  std::vector<std::int64_t> near;
  for (; vertex != this->Setting.Border.end() && mesh.at(*vertex).x <= east; ++vertex)
  {
    const Position p = mesh.at(*vertex);
    if (this->isBetween(p) && this->Line.reaches(p))
    {
      near.push_back(*vertex);
    }
  }
  std::sort(near.begin(), near.end(),
    [&](std::int64_t p, std::int64_t q) { return this->Line.isBefore(mesh.at(p), mesh.at(q)); });
  return near;
}

/// Returns whether a position, outside of the mesh, may be on its inner side only because rounding
/// has led an edge of the border at the vertex beyond it.
bool ConstraintRoutes::isAtBorder(std::int64_t vertex, Position p) const
{
  const MeshEdges& mesh = this->Setting.Mesh;
  const Position from = mesh.at(vertex);
  bool isAt = false;
  mesh.visitNeighbors(vertex,
    [&](std::int64_t next)
    {
      const bool isBorder = mesh.leftOf(vertex, next) == None || mesh.leftOf(next, vertex) == None;
      isAt =
        isAt || (isBorder && SnappedLine(from, mesh.at(next), this->Setting.WideReach).reaches(p));
    });
  return isAt;
}

/// Adds steps over gaps, in which the constraint is outside of the mesh. `border`: borderNear().
void ConstraintRoutes::addGaps(std::size_t from, const std::vector<std::int64_t>& border)
{
  const MeshEdges& mesh = this->Setting.Mesh;
  const std::int64_t vertex = this->Nodes[from].Vertex;
  const Position here = this->Nodes[from].At;
  const auto canLead = [&](std::int64_t next, Position there)
  {
    return (vertex == None || !mesh.entersMesh(vertex, there) ||
             (next == None && this->isAtBorder(vertex, there))) &&
      (next == None || !mesh.entersMesh(next, here) ||
        (vertex == None && this->isAtBorder(next, here)));
  };
  // A gap may leave out border vertices only beside its ends, where the constraint may have been
  // led through the others.
  std::optional<Position> leftOut; // the first one that is not beside the beginning
  std::int64_t skipped = 0;
  const auto reaches = [&](Position there) { return !leftOut || this->areBeside(*leftOut, there); };
  for (const std::int64_t next : border)
  {
    const Position there = mesh.at(next);
    if (!this->Line.isBefore(here, there))
    {
      continue;
    }
    if (!reaches(there))
    {
      return;
    }
    if (canLead(next, there))
    {
      const std::size_t to = this->nodeOf(next);
      this->Nodes[from].Steps.push_back({ to, true, skipped });
    }
    const bool isSkipped = this->makeNode(next, there).IsExplained;
    skipped += isSkipped ? 1 : 0;
    leftOut = isSkipped && !leftOut && !this->areBeside(here, there) ? there : leftOut;
  }
  if (from != end && this->Nodes[end].Vertex == None && reaches(this->B) && canLead(None, this->B))
  {
    this->Nodes[from].Steps.push_back({ end, true, skipped });
  }
}

void ConstraintRoutes::markNodesThatReachEnd()
{
  this->Order.resize(this->Nodes.size());
  std::iota(this->Order.begin(), this->Order.end(), std::size_t(0));
  const double signX = this->B.x < this->A.x ? -1 : 1;
  const double signY = this->B.y < this->A.y ? -1 : 1;
  std::sort(this->Order.begin(), this->Order.end(),
    [&](std::size_t i, std::size_t k)
    {
      const Position p = this->Nodes[i].At;
      const Position q = this->Nodes[k].At;
      return std::make_pair(signX * p.x, signY * p.y) < std::make_pair(signX * q.x, signY * q.y);
    });
  this->Nodes[end].LeadsToEnd = true;
  for (auto i = this->Order.rbegin(); i != this->Order.rend(); ++i)
  {
    Node& node = this->Nodes[*i];
    node.LeadsToEnd = node.LeadsToEnd ||
      std::any_of(node.Steps.begin(), node.Steps.end(),
        [this](const Step& step) { return this->Nodes[step.To].LeadsToEnd; });
  }
}

bool ConstraintRoutes::areSeveral() const
{
  return std::any_of(this->Nodes.begin(), this->Nodes.end(),
    [this](const Node& node)
    {
      return std::count_if(node.Steps.begin(), node.Steps.end(),
               [this](const Step& step) { return this->Nodes[step.To].LeadsToEnd; }) > 1;
    });
}

Route ConstraintRoutes::best(const Gain& gain, RoutePreference preference) const
{
  struct Way
  {
    bool IsKnown = false;
    std::int64_t Unexplained = 0;
    std::int64_t Off = 0; ///< number of vertices that are not on the constraint
    std::int64_t Gain = 0;
    std::int64_t Vertices = 0;
    std::size_t From = start;
    bool IsGap = false; ///< the last step
  };
  const auto rank = [preference](const Way& way) -> std::array<std::int64_t, 3>
  {
    return preference == RoutePreference::Gain
      ? std::array{ -way.Gain, way.Unexplained, -way.Vertices }
      : preference == RoutePreference::Straight
      ? std::array{ way.Off, -way.Gain, -way.Vertices }
      : std::array{ way.Unexplained, -way.Gain, -way.Vertices };
  };
  std::vector<Way> ways(this->Nodes.size());
  ways[start].IsKnown = true;
  for (const std::size_t i : this->Order)
  {
    for (const Step& step : this->Nodes[i].Steps)
    {
      const Node& next = this->Nodes[step.To];
      if (!ways[i].IsKnown || !next.LeadsToEnd)
      {
        continue;
      }
      Way way = ways[i];
      way.Unexplained += step.Skipped + (next.IsExplained ? 0 : 1);
      way.Off += next.IsOn ? 0 : 1;
      way.Gain += step.IsGap ? 0 : gain(this->Nodes[i].Vertex, next.Vertex);
      ++way.Vertices;
      way.From = i;
      way.IsGap = step.IsGap;
      if (!ways[step.To].IsKnown || rank(way) < rank(ways[step.To]))
      {
        ways[step.To] = way;
      }
    }
  }
  Route route;
  route.Unexplained = ways[end].Unexplained;
  bool isGap = false;
  for (std::size_t i = end;; i = ways[i].From)
  {
    route.Vertices.push_back(this->Nodes[i].Vertex);
    route.Positions.push_back(this->Nodes[i].At);
    route.IsGap.push_back(isGap);
    isGap = ways[i].IsGap;
    if (i == start)
    {
      break;
    }
  }
  std::reverse(route.Vertices.begin(), route.Vertices.end());
  std::reverse(route.Positions.begin(), route.Positions.end());
  std::reverse(route.IsGap.begin(), route.IsGap.end());
  return route;
}

bool isExplained(const Route& route, const std::function<bool(std::int64_t)>& attracts)
{
  std::vector<std::pair<std::size_t, std::size_t>> parts{ { 0, route.Vertices.size() - 1 } };
  while (!parts.empty())
  {
    const auto [first, last] = parts.back();
    parts.pop_back();
    const SnappedLine line(route.Positions[first], route.Positions[last]);
    std::size_t from = first;
    for (std::size_t i = first + 1; i < last; ++i)
    {
      const Position p = route.Positions[i];
      const std::int64_t vertex = route.Vertices[i];
      if (line.holds(p) || (line.roundsTo(p) && attracts(vertex)))
      {
        parts.push_back({ from, i });
        from = i;
      }
    }
    if (from == first && last - first > 1)
    {
      return false;
    }
    if (from != first)
    {
      parts.push_back({ from, last });
    }
  }
  return true;
}

} // namespace check
} // namespace tipp
