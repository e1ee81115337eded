// SPDX-License-Identifier: BSD-3-Clause
#include "CellSets.h"
#include "Predicates/ExactPredicates3.h"

#include "ExactClipping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using tipp::Box3;
using tipp::Point3;

namespace
{

// The nodes of a lattice over the unit square or cube.
class Lattice
{
public:
  Lattice(int n, int dimension, double jitter, unsigned seed)
    : N(n)
    , Dimension(dimension)
  {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> move(-jitter / n, jitter / n);
    const int layers = dimension == 3 ? n + 1 : 1;
    for (int i = 0; i < (n + 1) * (n + 1) * layers; ++i)
    {
      const int node[3] = { i % (n + 1), i / (n + 1) % (n + 1), i / (n + 1) / (n + 1) };
      for (int axis = 0; axis < dimension; ++axis)
      {
        const bool border = node[axis] == 0 || node[axis] == n;
        const double moved = jitter > 0.0 ? move(engine) : 0.0;
        this->Nodes.push_back(static_cast<double>(node[axis]) / n + (border ? 0.0 : moved));
      }
    }
  }

  void append(std::vector<double>& coordinates, int i, int j, int k) const
  {
    const int node = i + (this->N + 1) * (j + (this->N + 1) * k);
    const auto begin = this->Nodes.begin() + static_cast<std::ptrdiff_t>(node) * this->Dimension;
    coordinates.insert(coordinates.end(), begin, begin + this->Dimension);
  }

private:
  int N;
  int Dimension;
  std::vector<double> Nodes;
};

std::array<Point3, 4> cornersOf(const CellSet& cells, std::size_t index)
{
  std::array<Point3, 4> result;
  const auto dimension = static_cast<std::size_t>(cells.Dimension);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const std::size_t corner = std::min(i, static_cast<std::size_t>(cells.Corners) - 1);
    const double* p = cells.Coordinates.data() +
      (index * static_cast<std::size_t>(cells.Corners) + corner) * dimension;
    result[i] = { p[0], p[1], dimension == 3 ? p[2] : 0.0 };
  }
  return result;
}

} // namespace

tipp::CellsView CellSet::view() const
{
  return { this->Dimension, this->Corners, this->Coordinates.data(), this->size() };
}

std::size_t CellSet::size() const
{
  return this->Coordinates.size() / static_cast<std::size_t>(this->Dimension * this->Corners);
}

Box3 CellSet::bounds() const
{
  Box3 box;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(this->Dimension); ++axis)
  {
    box.Min[axis] = HUGE_VAL;
    box.Max[axis] = -HUGE_VAL;
    for (std::size_t i = axis; i < this->Coordinates.size();
         i += static_cast<std::size_t>(this->Dimension))
    {
      box.Min[axis] = std::min(box.Min[axis], this->Coordinates[i]);
      box.Max[axis] = std::max(box.Max[axis], this->Coordinates[i]);
    }
  }
  return box;
}

CellSet latticeTriangles(int n, double jitter, unsigned seed)
{
  const Lattice lattice(n, 2, jitter, seed);
  CellSet cells;
  for (int square = 0; square < n * n; ++square)
  {
    const int i = square % n;
    const int j = square / n;
    lattice.append(cells.Coordinates, i, j, 0);
    lattice.append(cells.Coordinates, i + 1, j, 0);
    lattice.append(cells.Coordinates, i + 1, j + 1, 0);
    lattice.append(cells.Coordinates, i, j, 0);
    lattice.append(cells.Coordinates, i + 1, j + 1, 0);
    lattice.append(cells.Coordinates, i, j + 1, 0);
  }
  return cells;
}

CellSet latticeTetrahedra(int n, double jitter, unsigned seed)
{
  // Kuhn's six tetrahedra: paths along the axes, in each order, from one corner to the opposite
  // one.
  static const int orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 }, { 2, 1, 0 },
    { 1, 0, 2 } };
  const Lattice lattice(n, 3, jitter, seed);
  CellSet cells;
  cells.Dimension = 3;
  cells.Corners = 4;
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    for (const auto& order : orders)
    {
      int node[3] = { cube % n, cube / n % n, cube / n / n };
      lattice.append(cells.Coordinates, node[0], node[1], node[2]);
      for (const int axis : order)
      {
        ++node[axis];
        lattice.append(cells.Coordinates, node[0], node[1], node[2]);
      }
    }
  }
  return cells;
}

CellSet surface(const CellSet& triangles)
{
  CellSet cells;
  cells.Dimension = 3;
  for (std::size_t i = 0; i < triangles.Coordinates.size(); i += 2)
  {
    const double x = triangles.Coordinates[i];
    const double y = triangles.Coordinates[i + 1];
    cells.Coordinates.insert(cells.Coordinates.end(), { x, y, x * (1.0 - y) });
  }
  return cells;
}

CellSet cellSoup(int dimension, int corners, std::size_t count, unsigned seed)
{
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> real(0.0, 1.0);
  std::uniform_int_distribution<int> sixteenth(0, 16);
  CellSet cells;
  cells.Dimension = dimension;
  cells.Corners = corners;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double length = std::ldexp(1.0, -static_cast<int>(i % 9));
    const bool rough = i % 4 == 0;
    std::vector<double> origin;
    for (int c = 0; c < corners * dimension; ++c)
    {
      const double drawn = rough ? real(engine) : sixteenth(engine) / 16.0;
      if (c < dimension)
      {
        origin.push_back(drawn * (1.0 - length));
      }
      cells.Coordinates.push_back(origin[static_cast<std::size_t>(c % dimension)] + length * drawn);
    }
  }
  return cells;
}

CellSet fan(std::size_t count)
{
  CellSet cells;
  const auto append = [&cells](double angle, double length)
  {
    cells.Coordinates.insert(
      cells.Coordinates.end(), { 0.3 + length * std::cos(angle), 0.3 + length * std::sin(angle) });
  };
  for (std::size_t i = 0; i < count; ++i)
  {
    const double angle = 0.01 * static_cast<double>(i);
    const double length = std::ldexp(0.25, -static_cast<int>(i % 20));
    append(0.0, 0.0);
    append(angle, length);
    append(angle + 0.01, length);
  }
  return cells;
}

tipp::BoxTiling randomTree(int dimension, const Box3& domain, int depth, unsigned seed)
{
  std::mt19937_64 engine(seed);
  std::vector<std::int32_t> firstChild = { -1 };
  std::vector<int> depths = { 0 };
  const int children = tipp::BoxTiling::childCount(dimension, domain);
  for (std::size_t node = 0; node < firstChild.size(); ++node)
  {
    if (depths[node] < depth && (node == 0 || engine() % 2 == 0))
    {
      firstChild[node] = static_cast<std::int32_t>(firstChild.size());
      firstChild.insert(firstChild.end(), static_cast<std::size_t>(children), -1);
      depths.insert(depths.end(), static_cast<std::size_t>(children), depths[node] + 1);
    }
  }
  return tipp::BoxTiling::tree(dimension, domain, firstChild);
}

tipp::Membership bruteForce(const CellSet& cells, const tipp::BoxTiling& tiling)
{
  tipp::Membership result;
  result.BorrowerStart.push_back(0);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    auto p = cornersOf(cells, i);
    if (tiling.dimension() == 2)
    {
      for (Point3& corner : p)
      {
        corner.z = 0.0;
      }
    }
    std::int32_t owner = -1;
    for (std::int64_t id = 0; id < tiling.count(); ++id)
    {
      const Box3& box = tiling.box(id);
      if (!(cells.Corners == 3 ? oracle::triangleMeetsBox({ p[0], p[1], p[2] }, box)
                               : oracle::tetrahedronMeetsBox(p, box)))
      {
        continue;
      }
      if (owner >= 0)
      {
        result.Borrowers.push_back(static_cast<std::int32_t>(id));
      }
      owner = owner < 0 ? static_cast<std::int32_t>(id) : owner;
    }
    result.Owner.push_back(owner);
    result.BorrowerStart.push_back(static_cast<std::int64_t>(result.Borrowers.size()));
  }
  return result;
}

void expectEqual(const tipp::Membership& expected, const tipp::Membership& actual)
{
  EXPECT_EQ(expected.Owner, actual.Owner);
  EXPECT_EQ(expected.BorrowerStart, actual.BorrowerStart);
  EXPECT_EQ(expected.Borrowers, actual.Borrowers);
}
