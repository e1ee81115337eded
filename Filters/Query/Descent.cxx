// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Queries.h"

#include "Files/IOError.h"
#include "Predicates/Vectors.h"
#include "Query/RankAnswer.h"
#include "Resident/ForPieces.h"

#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// A point of the mesh, as a corner of a triangle on a path.
struct SlopeCorner
{
  std::int64_t Index; ///< local index in the piece
  std::int64_t Id;
  Point3 Position;
  double Value;
};

/// A counter-clockwise triangle, and the direction in which its values fall fastest; (0, 0) if it
/// is level.
struct Slope
{
  SlopeCorner Corners[3];
  std::int64_t Cell;
  Point2 Down;
  double Steepness;
};

Point2 apart(const Point3& a, const Point3& b)
{
  return { a.x - b.x, a.y - b.y };
}

/// A path and its current position: in a cell, at a point, or on an edge. Ids are global.
struct Walk
{
  std::int64_t Cell = -1; ///< at first the cell that contains the start; -1: the path has ended
  std::int64_t Low = -1;  ///< the point, or the edge's end of lower id; -1: in the cell
  std::int64_t High = -1; ///< the other end of the edge; -1: not on an edge
  Point3 OfLow{};         ///< position of Low, whose piece has all cells there
  Point3 Position{};
  double Value = 0;
  std::int64_t Pit = -1;
  std::vector<Point3> Points;
  std::vector<double> Values;
};

template <typename Archive>
void serialize(Archive& archive, Walk& walk)
{
  archive(walk.Cell, walk.Low, walk.High, walk.OfLow, walk.Position, walk.Value, walk.Pit,
    walk.Points, walk.Values);
}

/// Follows paths within one piece.
class PieceDescent
{
public:
  PieceDescent(const ResidentPiece& piece, const PartValues& values, int component)
    : Part(*piece.Part)
    , Topology(*piece.Topology)
    , Values(values)
    , Component(component)
  {
  }

  /// Continues until the path ends, or another piece has the cells around its position.
  void follow(Walk& walk) const
  {
    for (std::int64_t step = 0; walk.Cell >= 0 && this->isHere(walk); ++step)
    {
      pollAt(step);
      walk.Low < 0      ? this->leaveCell(walk)
        : walk.High < 0 ? this->leavePoint(walk)
                        : this->leaveEdge(walk);
    }
  }

private:
  bool isHere(const Walk& walk) const
  {
    const auto isOwned = [this](std::int64_t id)
    {
      const std::int64_t index = id >= 0 ? this->Topology.findPoint(id) : -1;
      return index >= 0 && this->Part.owns(index);
    };
    return walk.Low < 0 || isOwned(walk.Low) || isOwned(walk.High);
  }

  SlopeCorner cornerOf(std::int64_t index) const
  {
    return { index, this->Part.pointId(index), positionOf(this->Part, index),
      this->Values.atPoint(index, this->Component) };
  }

  /// Computes the slope of a cell. Returns false if its coordinates or values give none.
  bool slopeOf(std::int64_t cell, Slope& slope) const
  {
    slope.Cell = this->Part.cellId(cell);
    for (int i = 0; i < 3; ++i)
    {
      slope.Corners[i] = this->cornerOf(this->Topology.corner(cell, i));
    }
    auto& [a, b, c] = slope.Corners;
    if (cross(apart(b.Position, a.Position), apart(c.Position, a.Position)) < 0)
    {
      std::swap(b, c);
    }
    const Point2 u = apart(b.Position, a.Position);
    const Point2 v = apart(c.Position, a.Position);
    const double area = cross(u, v);
    const double toB = b.Value - a.Value;
    const double toC = c.Value - a.Value;
    slope.Down = { (toC * u.y - toB * v.y) / area, (toB * v.x - toC * u.x) / area };
    slope.Steepness = std::hypot(slope.Down.x, slope.Down.y);
    return std::isfinite(slope.Steepness);
  }

  static void append(Walk& walk)
  {
    walk.Points.push_back(walk.Position);
    walk.Values.push_back(walk.Value);
  }

  static void toPoint(Walk& walk, const SlopeCorner& corner)
  {
    walk.Low = corner.Id;
    walk.High = -1;
    walk.OfLow = walk.Position = corner.Position;
    walk.Value = corner.Value;
    append(walk);
  }

  static void end(Walk& walk)
  {
    walk.Pit = walk.High < 0 ? walk.Low : -1;
    walk.Cell = -1;
  }

  /// Continues at the lowest corner of the triangle if that is lower; otherwise ends the path.
  static void toLowest(Walk& walk, const Slope& slope)
  {
    const SlopeCorner* lowest = &slope.Corners[0];
    for (const SlopeCorner& corner : slope.Corners)
    {
      lowest =
        std::tie(corner.Value, corner.Id) < std::tie(lowest->Value, lowest->Id) ? &corner : lowest;
    }
    // Very near a point, the current value may be rounded to the point's value.
    const bool mayBeEqual = (walk.Low < 0 || walk.High >= 0) && slope.Steepness > 0;
    lowest->Value < walk.Value || (lowest->Value == walk.Value && mayBeEqual)
      ? toPoint(walk, *lowest)
      : end(walk);
  }

  /// Continues on the edge ab, where the direction of descent from `from` crosses it.
  static void toEdge(
    Walk& walk, const Slope& slope, Point3 from, SlopeCorner a, SlopeCorner b, bool isFirst = false)
  {
    if (b.Id < a.Id)
    {
      std::swap(a, b);
    }
    const double ofA = std::fabs(cross(slope.Down, apart(a.Position, from)));
    const double ofB = std::fabs(cross(slope.Down, apart(b.Position, from)));
    const double share = ofA + ofB > 0 ? ofA / (ofA + ofB) : 0;
    const double value = a.Value + share * (b.Value - a.Value);
    // Requires a lower value for each step, so that the path ends in spite of rounding.
    if (!(value < walk.Value || (isFirst && value == walk.Value)))
    {
      toLowest(walk, slope);
      return;
    }
    if (share <= 0 || share >= 1)
    {
      toPoint(walk, share <= 0 ? a : b);
      return;
    }
    walk.Low = a.Id;
    walk.High = b.Id;
    walk.OfLow = a.Position;
    walk.Position = between(a.Position, b.Position, share);
    walk.Value = value;
    append(walk);
  }

  void leaveCell(Walk& walk) const
  {
    Slope slope;
    const std::int64_t cell = this->Topology.findCell(walk.Cell);
    if (cell < 0 || !this->slopeOf(cell, slope))
    {
      walk.Value = std::numeric_limits<double>::quiet_NaN();
      append(walk);
      end(walk);
      return;
    }
    // Computes value and height at the start.
    const auto& [a, b, c] = slope.Corners;
    const double whole = cross(apart(b.Position, a.Position), apart(c.Position, a.Position));
    const double ofB =
      cross(apart(walk.Position, a.Position), apart(c.Position, a.Position)) / whole;
    const double ofC =
      cross(apart(b.Position, a.Position), apart(walk.Position, a.Position)) / whole;
    walk.Value = a.Value + ofB * (b.Value - a.Value) + ofC * (c.Value - a.Value);
    walk.Position.z =
      a.Position.z + ofB * (b.Position.z - a.Position.z) + ofC * (c.Position.z - a.Position.z);
    for (const SlopeCorner& corner : slope.Corners)
    {
      if (corner.Position.x == walk.Position.x && corner.Position.y == walk.Position.y)
      {
        toPoint(walk, corner);
        return;
      }
    }
    append(walk);
    for (int i = 0; i < 3; ++i)
    {
      const SlopeCorner& from = slope.Corners[i];
      const SlopeCorner& to = slope.Corners[(i + 1) % 3];
      if (cross(slope.Down, apart(from.Position, walk.Position)) <= 0 &&
        cross(slope.Down, apart(to.Position, walk.Position)) > 0)
      {
        toEdge(walk, slope, walk.Position, from, to, true);
        return;
      }
    }
    toLowest(walk, slope);
  }

  /// Continues in the steepest direction from a point: down a triangle, or along an edge. Of equal
  /// slopes, the lowest id is used.
  void leavePoint(Walk& walk) const
  {
    const std::int64_t point = this->Topology.findPoint(walk.Low);
    Slope best{};
    int exit = -1; // the corner of `best` where the path starts; -1: it follows an edge
    SlopeCorner next{};
    std::tuple<double, bool, std::int64_t> steepest(0, false, 0);
    const auto isSteeper = [&](double steepness, bool isEdge, std::int64_t id)
    {
      const std::tuple<double, bool, std::int64_t> found(-steepness, !isEdge, id);
      const bool isBetter = steepness > 0 && found < steepest;
      steepest = isBetter ? found : steepest;
      return isBetter;
    };
    for (const std::int32_t cell : this->Topology.cellsAt(point))
    {
      Slope slope;
      if (!this->slopeOf(cell, slope))
      {
        continue;
      }
      int at = 0;
      for (int i = 0; i < 3; ++i)
      {
        at = slope.Corners[i].Index == point ? i : at;
      }
      const SlopeCorner& from = slope.Corners[at];
      const SlopeCorner& right = slope.Corners[(at + 1) % 3];
      const SlopeCorner& left = slope.Corners[(at + 2) % 3];
      for (const SlopeCorner* const corner : { &right, &left })
      {
        const Point2 way = apart(corner->Position, from.Position);
        if (isSteeper((from.Value - corner->Value) / std::hypot(way.x, way.y), true, corner->Id))
        {
          next = *corner;
          exit = -1;
        }
      }
      if (cross(apart(right.Position, from.Position), slope.Down) > 0 &&
        cross(slope.Down, apart(left.Position, from.Position)) > 0 &&
        isSteeper(slope.Steepness, false, slope.Cell))
      {
        best = slope;
        exit = at;
      }
    }
    if (std::get<0>(steepest) == 0)
    {
      end(walk);
      return;
    }
    exit < 0 ? toPoint(walk, next)
             : toEdge(walk, best, walk.Position, best.Corners[(exit + 1) % 3],
                 best.Corners[(exit + 2) % 3]);
  }

  /// Continues from an edge, down its steepest triangle, or along the edge if no triangle descends
  /// from it.
  void leaveEdge(Walk& walk) const
  {
    const std::int64_t ends[2] = { this->Topology.findPoint(walk.Low),
      this->Topology.findPoint(walk.High) };
    if (ends[0] < 0 || ends[1] < 0)
    {
      end(walk); // happens only if the stored mesh is damaged
      return;
    }
    Slope best{};
    int bestTip = -1;
    for (const std::int32_t cell : this->Topology.cellsAt(ends[0]))
    {
      Slope slope;
      if (!this->Topology.hasCorners(cell, ends, 2) || !this->slopeOf(cell, slope))
      {
        continue;
      }
      int tip = 0;
      for (int i = 0; i < 3; ++i)
      {
        tip = slope.Corners[i].Index != ends[0] && slope.Corners[i].Index != ends[1] ? i : tip;
      }
      const Point2 along =
        apart(slope.Corners[(tip + 2) % 3].Position, slope.Corners[(tip + 1) % 3].Position);
      const bool isBetter = bestTip < 0 ||
        std::make_tuple(-slope.Steepness, slope.Cell) < std::make_tuple(-best.Steepness, best.Cell);
      if (cross(along, slope.Down) > 0 && isBetter)
      {
        best = slope;
        bestTip = tip;
      }
    }
    if (bestTip >= 0)
    {
      const SlopeCorner& tip = best.Corners[bestTip];
      const double side = cross(best.Down, apart(tip.Position, walk.Position));
      side == 0 && tip.Value < walk.Value
        ? toPoint(walk, tip)
        : toEdge(walk, best, walk.Position, tip, best.Corners[(bestTip + (side > 0 ? 2 : 1)) % 3]);
      return;
    }
    const SlopeCorner low = this->cornerOf(ends[0]);
    const SlopeCorner high = this->cornerOf(ends[1]);
    const SlopeCorner& lower = high.Value < low.Value ? high : low;
    low.Value != high.Value ? toPoint(walk, lower) : end(walk);
  }

  const MeshPart& Part;
  const PartTopology& Topology;
  const PartValues& Values;
  const int Component;
};

/// For each walk, the piece in which it continues, or -1 if it has ended.
std::vector<std::int32_t> piecesOf(const ResidentMesh& mesh, const std::vector<Walk>& walks)
{
  std::vector<std::size_t> open;
  std::vector<Point3> positions;
  for (std::size_t i = 0; i < walks.size(); ++i)
  {
    if (walks[i].Cell >= 0)
    {
      open.push_back(i);
      positions.push_back(walks[i].OfLow);
    }
  }
  const std::vector<std::int32_t> found =
    mesh.piecesOf(positions.data(), std::int64_t(positions.size()));
  std::vector<std::int32_t> pieces(walks.size(), -1);
  for (std::size_t k = 0; k < open.size(); ++k)
  {
    if (found[k] < 0)
    {
      throw IOError(mesh.mesh().Path, "has points outside of all of its pieces.");
    }
    pieces[open[k]] = found[k];
  }
  return pieces;
}

/// Continues walks as long as they are in the pieces [first, end).
void follow(const ResidentMesh& mesh, const std::string& array, int component,
  std::pair<std::size_t, std::size_t> range, std::vector<Walk>& walks)
{
  const StoredArray* const description = mesh.fieldOf(array, component);
  PieceNeeds needs = mesh.needsOf({ array });
  needs.Topology = true;
  const auto groupsOfOpen = [&]
  {
    std::vector<std::int32_t> pieces = piecesOf(mesh, walks);
    for (std::int32_t& piece : pieces)
    {
      const bool isHere = piece >= std::int64_t(range.first) && piece < std::int64_t(range.second);
      piece = isHere ? piece : -1;
    }
    return groupByPiece(pieces);
  };
  for (PieceGroups groups = groupsOfOpen(); !groups.Groups.empty(); groups = groupsOfOpen())
  {
    forPieces(mesh, groups, needs,
      [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
      {
        const PartValues values(*piece.Part, description);
        const PieceDescent descent(piece, values, component);
        for (std::int64_t i = begin; i < end; ++i)
        {
          Walk& walk = walks[std::size_t(groups.Items[std::size_t(i)])];
          const std::size_t before = walk.Points.size();
          descent.follow(walk);
          if (walk.Cell >= 0 && walk.Points.size() == before)
          {
            mesh.refuseId(walk.Low, true);
          }
        }
      });
  }
}

Descents linesOf(const std::vector<Walk>& walks)
{
  Descents result;
  for (const Walk& walk : walks)
  {
    result.Points.insert(result.Points.end(), walk.Points.begin(), walk.Points.end());
    result.Values.insert(result.Values.end(), walk.Values.begin(), walk.Values.end());
    result.Starts.push_back(std::int64_t(result.Points.size()));
    result.Pits.push_back(walk.Pit);
  }
  return result;
}

/// Sends each unfinished walk to the rank that has its piece, which continues it. Returns whether
/// there was one on any rank.
bool followOnRanks(Communicator& ranks, const ResidentMesh& mesh, const std::string& array,
  int component, std::vector<Walk>& walks)
{
  const std::vector<std::int32_t> pieces = piecesOf(mesh, walks);
  std::vector<std::size_t> open;
  std::vector<std::size_t> rankOf;
  std::vector<Walk> sent;
  for (std::size_t i = 0; i < walks.size(); ++i)
  {
    if (pieces[i] >= 0)
    {
      open.push_back(i);
      rankOf.push_back(rankOfPiece(ranks, mesh, pieces[i]));
      sent.push_back(walks[i]); // its points so far stay on this rank
      sent.back().Points.clear();
      sent.back().Values.clear();
    }
  }
  if (!isTrueOnAny(ranks, !open.empty()))
  {
    return false;
  }
  std::vector<Walk> followed = askRanks(ranks, rankOf, std::move(sent),
    [&](std::vector<Walk> received)
    {
      follow(mesh, array, component, piecesOfRank(&ranks, mesh), received);
      return received;
    });
  const auto join = [](auto& before, auto& further)
  {
    before.insert(before.end(), further.begin(), further.end());
    further.swap(before);
  };
  for (std::size_t k = 0; k < open.size(); ++k)
  {
    join(walks[open[k]].Points, followed[k].Points);
    join(walks[open[k]].Values, followed[k].Values);
    walks[open[k]] = std::move(followed[k]);
  }
  return true;
}

} // namespace

Descents descentsOf(const ResidentMesh& mesh, const std::vector<Point3>& points,
  const std::string& array, int component, Communicator* ranks)
{
  if (ranks && !mesh.isStored())
  {
    throw IOError("Each rank has only a part of the mesh; store the mesh to follow descents.");
  }
  mesh.fieldOf(array, component);
  const std::vector<std::int64_t> cells =
    answerOf(mesh, points.data(), std::int64_t(points.size()), {}, ranks).Cells;
  std::vector<Walk> walks(points.size());
  for (std::size_t i = 0; i < walks.size(); ++i)
  {
    walks[i].Cell = cells[i];
    walks[i].Position = walks[i].OfLow = { points[i].x, points[i].y, 0 };
  }
  if (!ranks)
  {
    follow(mesh, array, component, piecesOfRank(nullptr, mesh), walks);
  }
  while (ranks && followOnRanks(*ranks, mesh, array, component, walks))
  {
  }
  return linesOf(walks);
}

} // namespace tipp
