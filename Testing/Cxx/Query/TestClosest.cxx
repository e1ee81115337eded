// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Query/Queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gmpxx.h>
#include <limits>

using namespace tipp;
using namespace tipp::test;

namespace
{

using Exact = std::array<mpq_class, 3>;

Exact exact(const Point3& p)
{
  return { mpq_class(p.x), mpq_class(p.y), mpq_class(p.z) };
}

Exact minus(const Exact& a, const Exact& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

mpq_class dot(const Exact& a, const Exact& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The squared distance of p from a simplex of one to four corners: the minimum over all faces into
/// whose interior p projects, by the normal equations. Independent of the code under test.
mpq_class squareTo(const std::vector<Exact>& corners, const Exact& p)
{
  const Exact to = minus(p, corners[0]);
  if (corners.size() == 1)
  {
    return dot(to, to);
  }
  const std::size_t n = corners.size() - 1;
  std::vector<std::vector<mpq_class>> rows(n, std::vector<mpq_class>(n + 1));
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t k = 0; k < n; ++k)
    {
      rows[i][k] = dot(minus(corners[i + 1], corners[0]), minus(corners[k + 1], corners[0]));
    }
    rows[i][n] = dot(minus(corners[i + 1], corners[0]), to);
  }
  for (std::size_t i = 0; i < n; ++i) // the matrix is positive definite, so no pivot is 0
  {
    for (std::size_t k = 0; k < n; ++k)
    {
      const mpq_class factor = k == i ? mpq_class(0) : mpq_class(rows[k][i] / rows[i][i]);
      for (std::size_t c = i; c <= n; ++c)
      {
        rows[k][c] -= factor * rows[i][c];
      }
    }
  }
  mpq_class rest = 1;
  bool isInside = true;
  Exact apart = to;
  for (std::size_t i = 0; i < n; ++i)
  {
    const mpq_class weight = rows[i][n] / rows[i][i];
    rest -= weight;
    isInside = isInside && weight >= 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      apart[axis] -= weight * (corners[i + 1][axis] - corners[0][axis]);
    }
  }
  mpq_class best = -1;
  if (isInside && rest >= 0)
  {
    best = dot(apart, apart);
  }
  for (std::size_t i = 0; i <= n; ++i)
  {
    std::vector<Exact> face = corners;
    face.erase(face.begin() + std::ptrdiff_t(i));
    const mpq_class square = squareTo(face, p);
    best = best < 0 || square < best ? square : best;
  }
  return best;
}

struct Brute
{
  std::int64_t Cell = -1;
  mpq_class Square;
};

Brute bruteForce(const SourceMesh& source, const Point3& p)
{
  Brute best;
  const auto corners = std::size_t(source.CellSize);
  for (std::size_t cell = 0; cell < source.cells(); ++cell)
  {
    std::vector<Exact> of;
    for (std::size_t i = 0; i < corners; ++i)
    {
      of.push_back(exact(pointOf(source, source.Cells[cell * corners + i])));
    }
    const mpq_class square = squareTo(of, exact(p));
    if (best.Cell < 0 || square < best.Square)
    {
      best = { std::int64_t(cell), square };
    }
  }
  return best;
}

std::vector<Point3> someAround(const SourceMesh& source)
{
  std::vector<Point3> points;
  const std::vector<Point3> all = pointsAround(source, 200);
  for (std::size_t i = 0; i < all.size(); i += 3)
  {
    points.push_back(all[i]);
  }
  for (const double far : { -1.0, 0.25, 7.0, 1e6 })
  {
    const double z = source.CellSize == 4 ? 0.5 : 0;
    points.insert(points.end(), { { far, 0.5, z }, { 0.5, far, z }, { far, far, z } });
  }
  return points;
}

void expectAsBruteForce(const SourceMesh& source)
{
  const std::vector<Point3> points = someAround(source);
  std::vector<Brute> expected;
  for (const Point3& p : points)
  {
    expected.push_back(bruteForce(source, p));
  }
  withEachMesh(source,
    [&](const ResidentMesh& mesh)
    {
      const auto count = std::int64_t(points.size());
      const ClosestLocations found = closestTo(mesh, points.data(), count);
      const MeshAnswer inside = mesh.answer(points.data(), count);
      int outside = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        SCOPED_TRACE(i);
        const bool isInside = sgn(expected[i].Square) == 0;
        outside += isInside ? 0 : 1;
        EXPECT_EQ(isInside ? inside.Cells[i] : expected[i].Cell, found.Cells[i]);
        const double distance = std::sqrt(expected[i].Square.get_d());
        EXPECT_NEAR(distance, found.Distances[i], 1e-9 * distance);
        EXPECT_EQ(isInside, found.Distances[i] == 0);
        const Point3 apart = found.Points[i] - points[i];
        EXPECT_NEAR(distance, std::hypot(apart.x, apart.y, apart.z), 1e-9 * distance + 1e-14);
      }
      EXPECT_LT(10, outside);
    });
}

} // namespace

TEST(Closest, TrianglesEqualBruteForceInRationals)
{
  expectAsBruteForce(withHoles(makeSource(latticeTriangles(9, 0.3)), 3));
}

TEST(Closest, TheLowestOfEquallyNearTrianglesIsFound)
{
  expectAsBruteForce(withHoles(makeSource(latticeTriangles(8, 0)), 2));
}

TEST(Closest, TetrahedraEqualBruteForceInRationals)
{
  expectAsBruteForce(withHoles(makeSource(latticeTetrahedra(3, 0.3)), 3));
}

TEST(Closest, TheLowestOfEquallyNearTetrahedraIsFound)
{
  expectAsBruteForce(withHoles(makeSource(latticeTetrahedra(3, 0)), 2));
}

TEST(Closest, IsExactVeryNearTheBorder)
{
  const SourceMesh source = makeSource(latticeTriangles(4, 0));
  const double tiny = std::nextafter(1.0, 2.0);
  const std::vector<Point3> points = { { tiny, 0.3, 0 }, { 0.3, -1e-300, 0 }, { 1, 1, 0 } };
  withEachMesh(source,
    [&](const ResidentMesh& mesh)
    {
      const ClosestLocations found = closestTo(mesh, points.data(), 3);
      EXPECT_EQ(tiny - 1, found.Distances[0]);
      EXPECT_DOUBLE_EQ(1e-300, found.Distances[1]);
      EXPECT_EQ(0, found.Distances[2]);
    });
}

TEST(Closest, NothingIsFoundInAnEmptyMeshOrForPointsThatAreNotFinite)
{
  const ResidentMesh empty{ MeshPart() };
  const Point3 points[2] = { { 0, 0, 0 }, { NAN, 0, 0 } };
  EXPECT_EQ(-1, closestTo(empty, points, 1).Cells[0]);
  const ResidentMesh mesh(inMemory(makeSource(latticeTriangles(3, 0))));
  const ClosestLocations found = closestTo(mesh, points, 2);
  EXPECT_EQ(0, found.Distances[0]);
  EXPECT_EQ(-1, found.Cells[1]);
  EXPECT_EQ(std::numeric_limits<double>::infinity(), found.Distances[1]);
}
