// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapTesting.h"

#include "Triangulation/Triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

namespace tipp
{
namespace test
{

SimplexMesh ValuedMesh::view() const
{
  SimplexMesh mesh;
  mesh.Points = this->Points.data();
  mesh.PointCount = std::int64_t(this->Points.size());
  mesh.Ids = this->Ids.data();
  mesh.Wide = true;
  mesh.Cells = this->cells();
  return mesh;
}

OverlapSource ValuedMesh::source() const
{
  return { this->view(), nullptr,
    { { this->OfCells.data(), 1, true }, { this->OfPoints.data(), 1, false } } };
}

ValuedMesh randomMesh(int points, std::uint64_t seed, bool corners, Point2 shift)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> xy;
  if (corners)
  {
    xy = { 0, 0, 1, 0, 0, 1, 1, 1 };
  }
  for (int i = 0; i < points; ++i)
  {
    xy.push_back(uniform(random));
    xy.push_back(uniform(random));
  }
  ValuedMesh mesh;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    xy[i] += shift.x;
    xy[i + 1] += shift.y;
    mesh.Points.push_back({ xy[i], xy[i + 1], 0 });
    mesh.OfPoints.push_back(uniform(random) - 0.5);
  }
  const Triangulation triangulation = triangulate(PointsView(xy.data(), xy.size() / 2, 2));
  for (const std::int32_t id : triangulation.Ids32)
  {
    mesh.Ids.push_back(id);
  }
  for (std::int64_t i = 0; i < mesh.cells(); ++i)
  {
    mesh.OfCells.push_back(uniform(random) - 0.5);
  }
  return mesh;
}

ValuedMesh oneTriangle(Point2 a, Point2 b, Point2 c, double value)
{
  ValuedMesh mesh;
  mesh.Points = { { a.x, a.y, 0 }, { b.x, b.y, 0 }, { c.x, c.y, 0 } };
  mesh.Ids = { 0, 1, 2 };
  mesh.OfCells = { value };
  mesh.OfPoints = { value, value, value };
  return mesh;
}

mpq_class exactArea(const ExactPolygon& polygon)
{
  mpq_class twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    const ExactPoint& a = polygon[0];
    const ExactPoint& b = polygon[i - 1];
    const ExactPoint& c = polygon[i];
    twice += (b.X - a.X) * (c.Y - a.Y) - (b.Y - a.Y) * (c.X - a.X);
  }
  return twice / 2;
}

ExactPolygon exactTriangle(const ValuedMesh& mesh, std::int64_t cell)
{
  ExactPolygon polygon(3);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point3& p = mesh.Points[std::size_t(mesh.Ids[std::size_t(3 * cell) + i])];
    polygon[i].X = p.x;
    polygon[i].Y = p.y;
    polygon[i].Weight[i] = 1;
  }
  const mpq_class area = exactArea(polygon);
  if (area < 0)
  {
    std::swap(polygon[1], polygon[2]);
  }
  return area == 0 ? ExactPolygon() : polygon;
}

ExactPolygon exactlyClipped(const ExactPolygon& polygon, const mpq_class& ax, const mpq_class& ay,
  const mpq_class& bx, const mpq_class& by)
{
  const auto side = [&](const ExactPoint& p) -> mpq_class
  { return (bx - ax) * (p.Y - ay) - (by - ay) * (p.X - ax); };
  ExactPolygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const ExactPoint& a = polygon[i];
    const ExactPoint& b = polygon[(i + 1) % polygon.size()];
    const mpq_class ofA = side(a);
    const mpq_class ofB = side(b);
    if (ofA >= 0)
    {
      result.push_back(a);
    }
    if (sgn(ofA) * sgn(ofB) < 0)
    {
      const mpq_class share = ofA / (ofA - ofB);
      ExactPoint p;
      p.X = a.X + share * (b.X - a.X);
      p.Y = a.Y + share * (b.Y - a.Y);
      for (int k = 0; k < 3; ++k)
      {
        p.Weight[k] = a.Weight[k] + share * (b.Weight[k] - a.Weight[k]);
      }
      result.push_back(p);
    }
  }
  return result;
}

void ExactSums::add(const ValuedMesh& mesh, std::int64_t cell, const ExactPolygon& part)
{
  const mpq_class area = exactArea(part);
  this->Area += area;
  this->OfCells += area * mpq_class(mesh.OfCells[std::size_t(cell)]);
  const auto valueAt = [&](const ExactPoint& p)
  {
    mpq_class value = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t id = std::size_t(mesh.Ids[std::size_t(3 * cell) + k]);
      value += p.Weight[k] * mpq_class(mesh.OfPoints[id]);
    }
    return value;
  };
  for (std::size_t i = 2; i < part.size(); ++i)
  {
    const mpq_class ofTriangle = exactArea({ part[0], part[i - 1], part[i] });
    this->OfPoints += ofTriangle * (valueAt(part[0]) + valueAt(part[i - 1]) + valueAt(part[i])) / 3;
  }
}

void expectNear(const ExactSums& expected, const RunningSum* found, double error)
{
  EXPECT_NEAR(found[0].value(), expected.Area.get_d(), error);
  EXPECT_NEAR(found[1].value(), expected.OfCells.get_d(), error);
  EXPECT_NEAR(found[2].value(), expected.OfPoints.get_d(), error);
}

mpq_class totalOf(const OverlapSums& sums, int index)
{
  mpq_class total = 0;
  for (std::int64_t i = 0; i < sums.targets(); ++i)
  {
    total += mpq_class(sums.of(i)[index].value());
  }
  return total;
}

} // namespace test
} // namespace tipp
