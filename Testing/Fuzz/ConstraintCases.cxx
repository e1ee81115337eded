// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintCases.h"

#include "Check/DelaunayChecker.h"
#include "ConstrainedOracle.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace tipp
{
namespace test
{
namespace
{

/// Pairs of points, the segments of a star, a chain of segments, or constraints that follow each
/// other back and forth: overlapping ones, where points are on a line.
std::vector<Constraint> drawConstraints(Engine& random, std::size_t points)
{
  std::vector<Constraint> constraints;
  if (points == 0)
  {
    return constraints;
  }
  enum class Kind
  {
    Pairs,
    Star,
    Chain,
    BackAndForth
  };
  const Kind kinds[] = { Kind::Pairs, Kind::Pairs, Kind::Star, Kind::Chain, Kind::BackAndForth };
  const Kind kind = kinds[random() % 5];
  const std::size_t mosts[] = { 5, 5, 12, 25 };
  const std::size_t count = random() % mosts[random() % 4];
  const auto draw = [&] { return PointId(random() % points); };
  PointId from = draw();
  for (std::size_t i = 0; i < count; ++i)
  {
    const PointId to = draw();
    constraints.push_back({ from, to });
    if (kind == Kind::BackAndForth)
    {
      constraints.push_back({ to, draw() });
    }
    from = kind == Kind::Star ? from : kind == Kind::Chain ? to : draw();
  }
  return constraints;
}

/// Appends the edges of a closed polygon.
void addPolygon(Engine& random, std::size_t points, std::vector<Constraint>& constraints)
{
  const std::size_t corners = 3 + random() % 4;
  const auto first = PointId(random() % points);
  PointId from = first;
  for (std::size_t i = 1; i < corners; ++i)
  {
    const auto to = PointId(random() % points);
    constraints.push_back({ from, to });
    from = to;
  }
  constraints.push_back({ from, first });
}

/// Adds points on or beside constraints, and copies of points.
void addPoints(Engine& random, const std::vector<Constraint>& constraints, Coordinates& xy)
{
  const std::size_t count = xy.empty() ? 0 : random() % 16;
  for (std::size_t i = 0; i < count; ++i)
  {
    Point2 p{};
    if (constraints.empty() || random() % 3 == 0)
    {
      const std::size_t copied = random() % (xy.size() / 2);
      p = { xy[2 * copied], xy[2 * copied + 1] };
    }
    else
    {
      const Constraint& constraint = constraints[random() % constraints.size()];
      const double part = double(random() % 7) / (random() % 2 == 0 ? 8 : 6);
      const auto at = [&](std::size_t axis)
      {
        const double a = xy[2 * std::size_t(constraint.A) + axis];
        const double b = xy[2 * std::size_t(constraint.B) + axis];
        const double value = a * (1 - part) + b * part;
        const int beside = int(random() % 6) - 3;
        return beside < -1 ? std::nextafter(value, -HUGE_VAL)
          : beside > 1     ? std::nextafter(value, HUGE_VAL)
                           : value;
      };
      p.x = at(0);
      p.y = at(1);
    }
    xy.insert(xy.end(), { p.x, p.y });
  }
}

/// Gives the constraints points of their own: those of their ends, with other heights.
ConstraintTable withOwnPoints(const std::vector<Constraint>& constraints, const Coordinates& xy)
{
  ConstraintTable table;
  for (const Constraint& constraint : constraints)
  {
    for (const PointId id : { constraint.A, constraint.B })
    {
      const auto at = 2 * std::size_t(id);
      table.XY.insert(table.XY.end(), { xy[at], xy[at + 1] });
      table.Height.push_back(1000 + double(table.Height.size()));
    }
    const auto next = std::int64_t(table.XY.size() / 2);
    table.Edges.push_back({ next - 2, next - 1 });
  }
  return table;
}

ConstraintTable betweenIds(const std::vector<Constraint>& constraints)
{
  ConstraintTable table;
  for (const Constraint& constraint : constraints)
  {
    table.Edges.push_back({ constraint.A, constraint.B });
  }
  return table;
}

/// Removes some of the points that constraints start or end at from the input.
void dropEnds(Engine& random, const std::vector<Constraint>& constraints, Coordinates& xy)
{
  std::vector<char> isDropped(xy.size() / 2, 0);
  for (const Constraint& constraint : constraints)
  {
    isDropped[std::size_t(constraint.A)] |= char(random() % 2);
  }
  Coordinates kept;
  for (std::size_t i = 0; i < isDropped.size(); ++i)
  {
    if (!isDropped[i])
    {
      kept.insert(kept.end(), { xy[2 * i], xy[2 * i + 1] });
    }
  }
  xy = std::move(kept);
}

class TableStream : public PointStream
{
public:
  explicit TableStream(PointTable points)
    : Points(std::move(points))
  {
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    const std::size_t count = std::min(most, this->Points.size() - this->Next);
    const auto part = [&](const std::vector<double>& from, std::size_t width)
    {
      const auto begin = from.begin() + std::ptrdiff_t(width * this->Next);
      return std::vector<double>(begin, begin + std::ptrdiff_t(width * count));
    };
    block.First = std::int64_t(this->Next);
    block.XY = part(this->Points.XY, 2);
    block.Columns = { part(this->Points.Columns.front().Values, 1) };
    this->Next += count;
    return count > 0;
  }
  void rewind() override { this->Next = 0; }
  void limitTo(std::int64_t, std::int64_t) override {}
  std::vector<std::string> columns() const override { return { "z" }; }
  std::string identity() const override { return "a case"; }

private:
  const PointTable Points;
  std::size_t Next = 0;
};

bool isFinite(double x, double y)
{
  return std::isfinite(x) && std::isfinite(y); // x + y may overflow
}

/// The constraints' ends as indices of the points in memory: of equal ones, the first.
std::vector<Constraint> constraintsOf(const ConstraintCase& drawn, const Coordinates& xy)
{
  const ConstraintTable& lines = drawn.Constraints.Lines;
  const auto find = [&](std::int64_t own)
  {
    if (lines.XY.empty())
    {
      return own;
    }
    const double x = lines.XY[2 * std::size_t(own)];
    const double y = lines.XY[2 * std::size_t(own) + 1];
    PointId i = 0;
    // A point that is not finite equals none; any other such point is as good.
    const auto matches = [&](double atX, double atY)
    { return isFinite(x, y) ? atX == x && atY == y : !isFinite(atX, atY); };
    while (!matches(xy[2 * std::size_t(i)], xy[2 * std::size_t(i) + 1]))
    {
      ++i;
    }
    return i;
  };
  std::vector<Constraint> constraints;
  for (const auto& [a, b] : lines.Edges)
  {
    constraints.push_back({ find(a), find(b) });
  }
  return constraints;
}

/// Whether `tipp check --constraints --tie-rule` finds no fault in the result; it may be unable to
/// decide. `given`: the number of points of the input.
testing::AssertionResult isNotFaulty(const Coordinates& all, std::size_t given,
  const std::vector<Constraint>& constraints, const Triangles& triangles)
{
  std::vector<std::int64_t> corners;
  for (const Triangle& triangle : triangles)
  {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  CheckOptions options;
  options.TieRule = true;
  ConstraintsInMesh inMesh;
  for (const Constraint& constraint : constraints)
  {
    inMesh.Edges.push_back({ constraint.A, constraint.B });
  }
  inMesh.IsAdded = [given](std::int64_t id) { return id >= std::int64_t(given); };
  inMesh.TieRule = options.TieRule;
  ConstraintChains chains;
  if (!triangles.empty())
  {
    chains = findConstraintChains(all, corners, inMesh);
  }
  options.Constraints = std::move(chains.Edges);
  CheckReport report = checkDelaunay(all, corners, options);
  report.LostConstraints = chains.Lost;
  const std::vector<std::string> faults = report.faults();
  return faults.empty() ? testing::AssertionSuccess()
                        : testing::AssertionFailure() << "the checker says: " << faults.front();
}

bool isSameBits(double a, double b)
{
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

} // namespace

PointTable ConstraintCase::table() const
{
  PointTable points;
  points.XY = this->XY;
  points.Columns.push_back({ "z", this->Heights });
  return points;
}

std::unique_ptr<PointStream> ConstraintCase::stream() const
{
  return std::make_unique<TableStream>(this->table());
}

void ConstraintCase::print() const
{
  for (std::size_t i = 0; i < this->points(); ++i)
  {
    std::printf("  %a, %a, // %zu: %.17g %.17g\n", this->XY[2 * i], this->XY[2 * i + 1], i,
      this->XY[2 * i], this->XY[2 * i + 1]);
  }
  const ConstraintTable& lines = this->Constraints.Lines;
  for (const auto& [a, b] : lines.Edges)
  {
    if (lines.XY.empty())
    {
      std::printf("  { %lld, %lld },\n", (long long)a, (long long)b);
      continue;
    }
    const double* const from = &lines.XY[2 * std::size_t(a)];
    const double* const to = &lines.XY[2 * std::size_t(b)];
    std::printf("  { %a, %a } to { %a, %a },\n", from[0], from[1], to[0], to[1]);
  }
}

ConstraintCase drawConstraintCase(Engine& random)
{
  ConstraintCase drawn;
  drawn.XY = drawDegeneratePoints(random);
  std::vector<Constraint> constraints = drawConstraints(random, drawn.points());
  const std::size_t lines = constraints.size();
  for (std::size_t i = drawn.XY.empty() || random() % 3 > 0 ? 0 : 1 + random() % 2; i > 0; --i)
  {
    addPolygon(random, drawn.points(), constraints);
    drawn.PolygonEnds.push_back(constraints.size());
  }
  addPoints(random, constraints, drawn.XY);
  if (random() % 2 == 0)
  {
    drawn.Constraints.Lines = withOwnPoints(constraints, drawn.XY);
    dropEnds(random, constraints, drawn.XY);
  }
  else
  {
    drawn.Constraints.Lines = betweenIds(constraints);
  }
  drawn.Constraints.Lines.PolygonBegin = lines;
  drawn.Constraints.Crossings = random() % 8 == 0 ? CrossingRule::Refuse : CrossingRule::Split;
  for (std::size_t i = 0; i < drawn.points(); ++i)
  {
    drawn.Heights.push_back(double(random() % 100));
  }
  const int sides[] = { 0, 1, 2, 5 };
  drawn.Options.Columns = drawn.Options.Rows = sides[random() % 4];
  drawn.Options.Threads = random() % 8 == 0 ? 2 : 1;
  const int pieces[] = { 0, 1, 2, 3, 4 };
  drawn.OnDisk.Columns = pieces[random() % 5];
  drawn.OnDisk.Rows = drawn.OnDisk.Columns == 0 ? 0 : pieces[1 + random() % 4];
  drawn.OnDisk.PiecePoints = 4 + std::int64_t(random() % 16);
  drawn.OnDisk.PartitionPoints = 3 + std::int64_t(random() % 8);
  drawn.OnDisk.Threads = 1;
  return drawn;
}

MadeInMemory makeInMemory(const ConstraintCase& drawn)
{
  MadeInMemory made;
  made.Points = drawn.table();
  try
  {
    made.Result = triangulateTable(made.Points, drawn.Constraints, drawn.Options);
  }
  catch (const std::invalid_argument& error)
  {
    if (drawn.Constraints.Crossings == CrossingRule::Split && drawn.PolygonEnds.empty())
    {
      throw;
    }
    made.Refused = error.what();
  }
  return made;
}

testing::AssertionResult isRight(const ConstraintCase& drawn, const MadeInMemory& made)
{
  if (!made.Refused.empty() || !drawn.PolygonEnds.empty())
  {
    return testing::AssertionSuccess();
  }
  const std::size_t crossings = made.Result.Constraints.Crossings.size();
  Coordinates xy = made.Points.XY;
  xy.resize(xy.size() - 2 * crossings);
  const std::vector<Constraint> constraints = constraintsOf(drawn, xy);
  const auto outcome = isConstrained(xy, constraints, made.Result);
  return outcome
    ? isNotFaulty(made.Points.XY, drawn.points(), constraints, trianglesOf(made.Result.Mesh))
    : outcome;
}

testing::AssertionResult isSameMesh(const std::string& path, const MadeInMemory& made)
{
  const PartitionedMesh mesh = openPartitionedMesh(path);
  const Coordinates& xy = made.Points.XY;
  std::vector<char> isFound(xy.size() / 2, 0);
  Triangles triangles;
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    PieceOptions options;
    options.Borrowed = false;
    const Piece piece = readPiece(mesh, number, options);
    const auto* const ids = piece.PointIds.as<std::int64_t>();
    const auto* const xyz = piece.Coordinates.as<double>();
    for (std::int64_t i = 0; i < piece.Points; ++i)
    {
      const auto id = std::size_t(ids[i]);
      if (id >= isFound.size() || !isSameBits(xyz[3 * i], xy[2 * id]) ||
        !isSameBits(xyz[3 * i + 1], xy[2 * id + 1]))
      {
        return testing::AssertionFailure() << "point " << id << " is elsewhere";
      }
      if (!isSameBits(xyz[3 * i + 2], made.Points.Columns.front().Values[id]))
      {
        return testing::AssertionFailure()
          << "point " << id << " has the height " << xyz[3 * i + 2];
      }
      isFound[id] = 1;
    }
    for (std::int64_t cell = 0; cell < piece.Cells; ++cell)
    {
      triangles.push_back(canonical(
        ids[piece.corner(cell, 0)], ids[piece.corner(cell, 1)], ids[piece.corner(cell, 2)]));
    }
  }
  for (std::size_t i = 0; i < isFound.size(); ++i)
  {
    if (isFound[i] != char(std::isfinite(xy[2 * i]) && std::isfinite(xy[2 * i + 1])))
    {
      return testing::AssertionFailure() << "point " << i << " is missing, or is not finite";
    }
  }
  return sameTriangles(xy, sorted(std::move(triangles)), trianglesOf(made.Result.Mesh));
}

} // namespace test
} // namespace tipp
