// SPDX-License-Identifier: BSD-3-Clause
// The check of a mesh in pieces finds the same errors as the check of a whole mesh.
#include "Check/DelaunayChecker.h"

#include "Triangulation/Triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>

namespace
{

using namespace tipp;

struct Mesh
{
  std::vector<double> XY;
  std::vector<std::int64_t> Triangles;

  std::size_t count() const { return this->Triangles.size() / 3; }
};

Mesh makeMesh(std::size_t count, bool isLattice)
{
  std::mt19937 random(5);
  Mesh mesh;
  for (std::size_t i = 0; i < count; ++i)
  {
    mesh.XY.push_back(isLattice ? double(i % 20) : double(random()) / 4294967296.0 * 20);
    mesh.XY.push_back(isLattice ? double(i / 20) : double(random()) / 4294967296.0 * 20);
  }
  const Triangulation result = triangulate(PointsView(mesh.XY.data(), count, 2));
  mesh.Triangles.assign(result.Ids32.begin(), result.Ids32.end());
  return mesh;
}

/// The column of a point, of four. A triangle belongs to the lowest column of its points.
std::size_t columnOf(const Mesh& mesh, std::int64_t point)
{
  return std::min<std::size_t>(3, std::size_t(mesh.XY[2 * std::size_t(point)] / 5));
}

CheckedPiece pieceOf(const Mesh& mesh, std::size_t column)
{
  CheckedPiece piece;
  std::map<std::int64_t, std::int64_t> numbers;
  const auto numberOf = [&](std::int64_t id)
  {
    const auto [found, isNew] = numbers.emplace(id, std::int64_t(piece.Ids.size()));
    if (isNew)
    {
      piece.Ids.push_back(id);
      piece.XY.push_back(mesh.XY[2 * std::size_t(id)]);
      piece.XY.push_back(mesh.XY[2 * std::size_t(id) + 1]);
      piece.IsOwn.push_back(columnOf(mesh, id) == column);
    }
    return found->second;
  };
  for (std::size_t id = 0; id < mesh.XY.size() / 2; ++id)
  {
    if (columnOf(mesh, std::int64_t(id)) == column)
    {
      numberOf(std::int64_t(id));
    }
  }
  for (const bool isOwn : { true, false })
  {
    for (std::size_t t = 0; t < mesh.count(); ++t)
    {
      const std::int64_t* const ids = &mesh.Triangles[3 * t];
      std::size_t columns[3];
      std::transform(ids, ids + 3, columns, [&](std::int64_t id) { return columnOf(mesh, id); });
      const std::size_t owner = *std::min_element(columns, columns + 3);
      const bool isHere = std::count(columns, columns + 3, column) > 0;
      if (isHere && isOwn == (owner == column))
      {
        std::transform(ids, ids + 3, std::back_inserter(piece.Triangles), numberOf);
        piece.OwnTriangles += isOwn ? 1 : 0;
      }
    }
  }
  return piece;
}

CheckReport checkInPieces(const Mesh& mesh, const CheckOptions& options = {})
{
  PieceChecker checker(options);
  for (std::size_t column = 0; column < 4; ++column)
  {
    checker.add(pieceOf(mesh, column));
  }
  return checker.finish();
}

void expectAsWhole(const Mesh& mesh, bool isCorrect, const CheckOptions& options = {})
{
  const CheckReport whole = checkDelaunay(mesh.XY, mesh.Triangles, options);
  const CheckReport pieces = checkInPieces(mesh, options);
  EXPECT_EQ(isCorrect, whole.isCorrect());
  EXPECT_EQ(whole.faults(), pieces.faults());
  EXPECT_EQ(whole.Points, pieces.Points);
  EXPECT_EQ(whole.DistinctPoints, pieces.DistinctPoints);
  EXPECT_EQ(whole.Cells, pieces.Cells);
  EXPECT_EQ(whole.BoundaryFacets, pieces.BoundaryFacets);
  EXPECT_EQ(whole.Ties, pieces.Ties);
}

TEST(PieceChecker, AcceptsADelaunayTriangulation)
{
  expectAsWhole(makeMesh(300, false), true);
}

TEST(PieceChecker, AcceptsALatticeWithTheTieRule)
{
  CheckOptions options;
  options.TieRule = true;
  expectAsWhole(makeMesh(300, true), true, options);
}

TEST(PieceChecker, FindsAnyMissingTriangle)
{
  const Mesh mesh = makeMesh(300, false);
  for (std::size_t t = 0; t < mesh.count(); t += 7)
  {
    Mesh holed = mesh;
    holed.Triangles.erase(holed.Triangles.begin() + std::ptrdiff_t(3 * t),
      holed.Triangles.begin() + std::ptrdiff_t(3 * t + 3));
    expectAsWhole(holed, false);
  }
}

TEST(PieceChecker, FindsAnyClockwiseTriangle)
{
  const Mesh mesh = makeMesh(300, false);
  for (std::size_t t = 0; t < mesh.count(); t += 7)
  {
    Mesh turned = mesh;
    std::swap(turned.Triangles[3 * t], turned.Triangles[3 * t + 1]);
    expectAsWhole(turned, false);
  }
}

TEST(PieceChecker, FindsEdgesThatAreNotLocallyDelaunay)
{
  Mesh mesh = makeMesh(300, false);
  std::mt19937 random(7);
  for (double& value : mesh.XY)
  {
    value = std::min(19.9, value + double(random() % 100) / 200);
  }
  EXPECT_GT(checkInPieces(mesh).BadSpheres, 0);
}

TEST(PieceChecker, FindsARepeatedTriangle)
{
  Mesh mesh = makeMesh(300, false);
  for (std::size_t i = 0; i < 3; ++i)
  {
    mesh.Triangles.push_back(mesh.Triangles[i]);
  }
  EXPECT_GT(checkInPieces(mesh).BadFacets, 0);
}

TEST(PieceChecker, FindsAPointWithOtherCoordinatesInAnotherPiece)
{
  const Mesh mesh = makeMesh(300, false);
  PieceChecker checker({});
  for (std::size_t column = 0; column < 4; ++column)
  {
    CheckedPiece piece = pieceOf(mesh, column);
    const auto ghost = std::find(piece.IsOwn.begin(), piece.IsOwn.end(), false);
    if (column == 0)
    {
      ASSERT_TRUE(ghost != piece.IsOwn.end());
      piece.XY[2 * std::size_t(ghost - piece.IsOwn.begin())] += 1e-9;
    }
    checker.add(piece);
  }
  EXPECT_FALSE(checker.finish().isCorrect());
}

/// Pieces whose cell ids are the triangles' indices in the mesh, with neighbours computed from all
/// edges.
std::vector<CheckedPiece> piecesWithNeighbors(const Mesh& mesh)
{
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> cellOf; // left of an edge
  const auto edge = [&](std::size_t t, std::size_t i)
  {
    const std::int64_t* const ids = &mesh.Triangles[3 * t];
    return std::make_pair(ids[(i + 1) % 3], ids[(i + 2) % 3]);
  };
  std::map<std::array<std::int64_t, 3>, std::size_t> triangles;
  for (std::size_t t = 0; t < mesh.count(); ++t)
  {
    const std::int64_t* const ids = &mesh.Triangles[3 * t];
    triangles[{ ids[0], ids[1], ids[2] }] = t;
    for (std::size_t i = 0; i < 3; ++i)
    {
      cellOf[edge(t, i)] = std::int64_t(t);
    }
  }
  std::vector<CheckedPiece> pieces;
  for (std::size_t column = 0; column < 4; ++column)
  {
    pieces.push_back(pieceOf(mesh, column));
    CheckedPiece& piece = pieces.back();
    for (std::size_t own = 0; own < std::size_t(piece.OwnTriangles); ++own)
    {
      const auto id = [&](std::size_t i)
      { return piece.Ids[std::size_t(piece.Triangles[3 * own + i])]; };
      const std::size_t t = triangles.at({ id(0), id(1), id(2) });
      piece.CellIds.push_back(std::int64_t(t));
      for (std::size_t i = 0; i < 3; ++i)
      {
        const auto [from, to] = edge(t, i);
        const auto found = cellOf.find({ to, from });
        piece.Neighbors.push_back(found == cellOf.end() ? -1 : found->second);
      }
    }
  }
  return pieces;
}

std::int64_t countBadNeighbors(const std::vector<CheckedPiece>& pieces)
{
  PieceChecker checker({});
  for (const CheckedPiece& piece : pieces)
  {
    checker.add(piece);
  }
  const CheckReport report = checker.finish();
  EXPECT_EQ(report.BadNeighbors > 0, !report.isCorrect());
  return report.BadNeighbors;
}

TEST(PieceChecker, AcceptsTheNeighborsAcrossEachEdge)
{
  EXPECT_EQ(0, countBadNeighbors(piecesWithNeighbors(makeMesh(300, false))));
}

TEST(PieceChecker, FindsAnyWrongNeighbor)
{
  const std::vector<CheckedPiece> pieces = piecesWithNeighbors(makeMesh(300, false));
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    for (std::size_t i = 0; i < pieces[p].Neighbors.size(); i += 5)
    {
      std::vector<CheckedPiece> wrong = pieces;
      wrong[p].Neighbors[i] = wrong[p].Neighbors[i] == 7 ? -1 : 7;
      EXPECT_EQ(1, countBadNeighbors(wrong)) << p << " " << i;
    }
    std::vector<CheckedPiece> turned = pieces;
    std::swap(turned[p].Neighbors[0], turned[p].Neighbors[1]);
    EXPECT_EQ(2, countBadNeighbors(turned)) << p;
  }
}

TEST(PieceChecker, FindsIdsBeyondThePoints)
{
  CheckedPiece piece = pieceOf(makeMesh(300, false), 0);
  piece.Triangles[0] = std::int64_t(piece.Ids.size());
  piece.Triangles[4] = -1;
  PieceChecker checker({});
  checker.add(piece);
  EXPECT_EQ(2, checker.finish().BadIds);
}

TEST(PieceChecker, SumsThePointsThatPiecesOwn)
{
  const Mesh mesh = makeMesh(100, false);
  PieceChecker checker({});
  std::uint64_t expected = 0;
  for (std::size_t i = 0; i < 100; ++i)
  {
    expected += PieceChecker::hashPoint(std::int64_t(i), mesh.XY[2 * i], mesh.XY[2 * i + 1]);
  }
  for (std::size_t column = 0; column < 4; ++column)
  {
    checker.add(pieceOf(mesh, column));
  }
  EXPECT_EQ(expected, checker.pointSum());
}

} // namespace
