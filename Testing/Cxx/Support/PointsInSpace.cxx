// SPDX-License-Identifier: BSD-3-Clause
#include "PointsInSpace.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace tipp
{
namespace test
{
namespace
{

using Key = std::array<double, 3>;

class Maker
{
public:
  explicit Maker(unsigned seed)
    : Generator(seed)
  {
  }

  double uniform() { return this->Uniform(this->Generator); }
  double normal() { return this->Normal(this->Generator); }

  Point3 clustered()
  {
    const int cluster = int(20 * this->uniform());
    const double size = std::pow(10.0, -1 - cluster % 5);
    return { std::sin(cluster) + size * this->normal(),
      std::cos(3 * cluster) + size * this->normal(),
      std::sin(7 * cluster) + size * this->normal() };
  }

  Point3 onSphere()
  {
    const double x = this->normal();
    const double y = this->normal();
    const double z = this->normal();
    const double length = std::sqrt(x * x + y * y + z * z);
    return { x / length, y / length, z / length };
  }

  Point3 onLines()
  {
    const double t = this->uniform();
    const int line = int(3 * this->uniform());
    return line == 0 ? Point3{ t, 0, 0 } : (line == 1 ? Point3{ 0, t, 1 } : Point3{ 1, 0.5, t });
  }

  Point3 onSurface()
  {
    const double x = this->uniform();
    const double y = this->uniform();
    return { x, y, 0.1 * std::sin(9 * x) * std::cos(7 * y) };
  }

  Point3 ofManySizes()
  {
    const auto small = [this] { return std::ldexp(this->uniform(), -int(200 * this->uniform())); };
    return { small(), small(), this->uniform() };
  }

  Point3 coarse()
  {
    const auto one = [this] { return double(int(6 * this->uniform())); };
    return { one(), one(), one() };
  }

  Point3 inCube(double scale)
  {
    return { scale * this->uniform(), scale * this->uniform(), scale * this->uniform() };
  }

  /// Appends jittered lattice points: points shift, shift + 1, ... of the lattice.
  void addLattice(std::size_t count, double shift, double jitter, std::vector<Point3>& points)
  {
    const int side = int(std::lround(std::cbrt(double(count))));
    for (int i = 0; i < side * side * side; ++i)
    {
      const Point3 by = this->inCube(jitter);
      points.push_back({ i % side + shift + by.x, i / side % side + shift + by.y,
        i / side / side + shift + by.z });
    }
  }

  std::mt19937_64 Generator;
  std::uniform_real_distribution<double> Uniform{ 0, 1 };
  std::normal_distribution<double> Normal;
};

} // namespace

const std::vector<std::string>& kindsOfPoints()
{
  static const std::vector<std::string> kinds = { "uniform", "clustered", "sphere", "surface",
    "lines", "lattice", "jittered", "body-centred", "coarse", "tiny", "huge", "of many sizes" };
  return kinds;
}

std::vector<Point3> pointsInSpace(const std::string& kind, std::size_t count, unsigned seed)
{
  Maker make(seed);
  std::vector<Point3> points;
  if (kind == "lattice" || kind == "jittered" || kind == "body-centred")
  {
    make.addLattice(
      kind == "body-centred" ? count / 2 : count, 0, kind == "jittered" ? 0.1 : 0, points);
    if (kind == "body-centred")
    {
      make.addLattice(count / 2, 0.5, 0, points);
    }
    std::shuffle(points.begin(), points.end(), make.Generator);
    return points;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    points.push_back(kind == "clustered" ? make.clustered()
        : kind == "sphere"               ? make.onSphere()
        : kind == "surface"              ? make.onSurface()
        : kind == "lines"                ? make.onLines()
        : kind == "coarse"               ? make.coarse()
        : kind == "of many sizes"
        ? make.ofManySizes()
        : make.inCube(kind == "tiny" ? 1e-200 : (kind == "huge" ? 1e200 : 1)));
  }
  return points;
}

std::unique_ptr<PointStream> streamOf(const std::vector<Point3>& points)
{
  PointTable table;
  table.Columns = { { "z", {} }, { "number", {} } };
  for (const Point3& p : points)
  {
    table.Columns[1].Values.push_back(double(table.size()));
    table.XY.insert(table.XY.end(), { p.x, p.y });
    table.Columns[0].Values.push_back(p.z);
  }
  return streamTable(std::move(table));
}

std::vector<Tetrahedron> sortedCells(const Tetrahedralization& mesh)
{
  std::vector<Tetrahedron> cells;
  for (std::size_t i = 0; i < mesh.Ids.size(); i += 4)
  {
    Tetrahedron cell = { mesh.Ids[i], mesh.Ids[i + 1], mesh.Ids[i + 2], mesh.Ids[i + 3] };
    std::sort(cell.begin(), cell.end());
    cells.push_back(cell);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

std::vector<Tetrahedron> cellsOfCgal(const std::vector<Point3>& points)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;
  std::map<Key, std::int64_t> lowest;
  std::vector<Kernel::Point_3> input;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    input.emplace_back(points[i].x, points[i].y, points[i].z);
    lowest.emplace(Key{ points[i].x, points[i].y, points[i].z }, std::int64_t(i));
  }
  const Delaunay delaunay(input.begin(), input.end());
  std::vector<Tetrahedron> cells;
  for (auto cell = delaunay.finite_cells_begin(); cell != delaunay.finite_cells_end(); ++cell)
  {
    Tetrahedron ids;
    for (int i = 0; i < 4; ++i)
    {
      const Kernel::Point_3& p = cell->vertex(i)->point();
      ids[std::size_t(i)] = lowest.at({ p.x(), p.y(), p.z() });
    }
    std::sort(ids.begin(), ids.end());
    cells.push_back(ids);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

std::vector<double> coordinatesOf(const std::vector<Point3>& points)
{
  std::vector<double> xyz;
  for (const Point3& p : points)
  {
    xyz.insert(xyz.end(), { p.x, p.y, p.z });
  }
  return xyz;
}

std::vector<std::int64_t> idsOf(const Tetrahedralization& mesh)
{
  return { mesh.Ids.begin(), mesh.Ids.end() };
}

} // namespace test
} // namespace tipp
