// SPDX-License-Identifier: BSD-3-Clause
#include "ResampleScenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

bool Scene::boxContains(int cell, const double* sample) const
{
  for (int axis = 0; axis < this->Dimension; ++axis)
  {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (int i = 0; i <= this->Dimension; ++i)
    {
      const double x = this->point(this->Ids[cell * (this->Dimension + 1) + i])[axis];
      low = std::min(low, x);
      high = std::max(high, x);
    }
    if (sample[axis] < low || sample[axis] > high)
    {
      return false;
    }
  }
  return true;
}

tipp::SimplexMesh Scene::mesh() const
{
  tipp::SimplexMesh mesh;
  mesh.Points = this->Points.data();
  mesh.Ids = this->Ids.data();
  mesh.Wide = true;
  mesh.Cells = this->cells();
  mesh.PointCount = std::int64_t(this->Points.size()) / 3;
  mesh.Dimension = this->Dimension;
  return mesh;
}

StoredMesh::StoredMesh(const Scene& scene, bool singlePrecision, bool narrowIds)
  : Points(scene.Points.begin(), scene.Points.end())
  , Ids(scene.Ids.begin(), scene.Ids.end())
  , Mesh(scene.mesh())
{
  this->Mesh.Float = singlePrecision;
  this->Mesh.Points = singlePrecision ? static_cast<const void*>(this->Points.data())
                                      : static_cast<const void*>(scene.Points.data());
  this->Mesh.Wide = !narrowIds;
  this->Mesh.Ids = narrowIds ? static_cast<const void*>(this->Ids.data())
                             : static_cast<const void*>(scene.Ids.data());
}

Scene Scene::rounded() const
{
  Scene scene = *this;
  std::transform(scene.Points.begin(), scene.Points.end(), scene.Points.begin(),
    [](double coordinate) { return double(float(coordinate)); });
  return scene;
}

Scene Scene::shuffled(unsigned seed) const
{
  std::mt19937 random(seed);
  const std::size_t corners = std::size_t(this->Dimension) + 1;
  std::vector<std::vector<std::int64_t>> cells;
  for (std::size_t i = 0; i < this->Ids.size(); i += corners)
  {
    cells.emplace_back(
      this->Ids.begin() + std::ptrdiff_t(i), this->Ids.begin() + std::ptrdiff_t(i + corners));
    std::shuffle(cells.back().begin(), cells.back().end(), random);
  }
  std::shuffle(cells.begin(), cells.end(), random);
  Scene scene = *this;
  scene.Ids.clear();
  for (const auto& cell : cells)
  {
    scene.Ids.insert(scene.Ids.end(), cell.begin(), cell.end());
  }
  return scene;
}

namespace
{

/// Adds the simplices of a cube (Kuhn): the paths along its edges from the lowest corner to the
/// highest.
void addCube(Scene& scene, int steps, std::array<int, 3> at)
{
  std::vector<int> axes =
    scene.Dimension == 2 ? std::vector<int>{ 0, 1 } : std::vector<int>{ 0, 1, 2 };
  const int stride = steps + 1;
  do
  {
    std::array<int, 3> corner = at;
    scene.Ids.push_back(corner[0] + stride * (corner[1] + stride * corner[2]));
    for (const int axis : axes)
    {
      ++corner[std::size_t(axis)];
      scene.Ids.push_back(corner[0] + stride * (corner[1] + stride * corner[2]));
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
}

Scene gridScene(int dimension, int steps, double jitter, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-jitter / 2, jitter / 2);
  Scene scene;
  scene.Dimension = dimension;
  const int layers = dimension == 3 ? steps : 0;
  for (int z = 0; z <= layers; ++z)
  {
    for (int y = 0; y <= steps; ++y)
    {
      for (int x = 0; x <= steps; ++x)
      {
        for (const int i : { x, y, z })
        {
          const bool border = i == 0 || i == steps;
          scene.Points.push_back((i + (border ? 0 : offset(random))) / steps);
        }
        if (dimension == 2)
        {
          scene.Points.back() = 0;
        }
      }
    }
  }
  for (int z = 0; z < std::max(1, layers); ++z)
  {
    for (int y = 0; y < steps; ++y)
    {
      for (int x = 0; x < steps; ++x)
      {
        addCube(scene, steps, { x, y, z });
      }
    }
  }
  return scene;
}

} // namespace

Scene regularScene(int dimension, int steps)
{
  Scene scene = gridScene(dimension, steps, 0, 1);
  scene.Name = "regular";
  return scene;
}

Scene jitteredScene(int dimension, int steps, unsigned seed)
{
  Scene scene = gridScene(dimension, steps, 0.4, seed);
  scene.Name = "jittered";
  return scene;
}

Scene sliverScene()
{
  Scene scene;
  scene.Name = "slivers";
  constexpr int columns = 9;
  // Between the lines y = 0 and y = 1, there is a band a few ulps high around y = x / 3.
  for (int i = 0; i <= columns; ++i)
  {
    const double x = double(i) / columns;
    const double low = x / 3;
    const double high = low + (i % 3 + 1) * 0x1p-53;
    for (const double y : { 0.0, low, std::max(high, std::nextafter(low, 1.0)), 1.0 })
    {
      scene.Points.insert(scene.Points.end(), { x, y, 0 });
    }
  }
  for (int i = 0; i < columns; ++i)
  {
    for (int row = 0; row < 3; ++row)
    {
      const std::int64_t a = 4 * i + row;
      const std::int64_t b = a + 4;
      scene.Ids.insert(scene.Ids.end(), { a, b, b + 1, a, b + 1, a + 1 });
    }
  }
  return scene;
}

Scene fanScene(int wedges)
{
  Scene scene;
  scene.Name = "fan";
  scene.Points = { 0.5, 0.5, 0 };
  constexpr double full = 6.0; // slightly less than 2 pi
  for (int i = 0; i <= wedges; ++i)
  {
    const double angle = 0.1 + full * i / wedges;
    scene.Points.insert(
      scene.Points.end(), { 0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle), 0 });
  }
  for (int i = 0; i < wedges; ++i)
  {
    scene.Ids.insert(scene.Ids.end(), { 0, i + 1, i + 2 });
  }
  return scene;
}

Scene overlappingScene(int triangles, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> place(0, 16);
  Scene scene;
  scene.Name = "overlapping";
  for (int i = 0; i < 3 * triangles; ++i)
  {
    scene.Points.insert(scene.Points.end(), { place(random) / 16.0, place(random) / 16.0, 0 });
    scene.Ids.push_back(i);
  }
  return scene;
}

std::vector<Scene> tilesOf(const Scene& scene, int side, bool ownPoints)
{
  const int corners = scene.Dimension + 1;
  std::vector<Scene> tiles(std::size_t(side * side * (scene.Dimension == 3 ? side : 1)));
  std::vector<std::vector<std::int64_t>> places(tiles.size());
  for (std::size_t tile = 0; tile < tiles.size(); ++tile)
  {
    tiles[tile].Dimension = scene.Dimension;
    tiles[tile].Points = ownPoints ? std::vector<double>() : scene.Points;
    places[tile].assign(scene.Points.size() / 3, -1);
  }
  for (int cell = 0; cell < scene.cells(); ++cell)
  {
    std::size_t tile = 0;
    for (int axis = scene.Dimension - 1; axis >= 0; --axis)
    {
      double sum = 0;
      for (int i = 0; i < corners; ++i)
      {
        sum += scene.corner(cell, i)[axis];
      }
      const int at = std::clamp(int(sum / corners * side), 0, side - 1);
      tile = tile * std::size_t(side) + std::size_t(at);
    }
    Scene& part = tiles[tile];
    for (int i = 0; i < corners; ++i)
    {
      const std::int64_t id = scene.Ids[std::size_t(cell * corners + i)];
      std::int64_t& place = places[tile][std::size_t(id)];
      if (ownPoints && place < 0)
      {
        place = std::int64_t(part.Points.size() / 3);
        part.Points.insert(part.Points.end(), scene.point(id), scene.point(id) + 3);
      }
      part.Ids.push_back(ownPoints ? place : id);
    }
  }
  return tiles;
}

std::vector<Scene> planeScenes()
{
  Scene corner; // a sample at its corner (0.5, 0.5) is only found in the closed cell, by no move
  corner.Name = "corner";
  corner.Points = { 0.5, 0.5, 0, 0.9, 1, 0, 1, 0.9, 0 };
  corner.Ids = { 0, 1, 2 };
  return { regularScene(2, 8), jitteredScene(2, 8, 1), sliverScene(), fanScene(40), corner };
}

std::vector<Scene> spaceScenes()
{
  Scene corner;
  corner.Name = "corner";
  corner.Dimension = 3;
  corner.Points = { 0.5, 0.5, 0.5, 0.9, 1, 1, 1, 0.9, 1, 1, 1, 0.9 };
  corner.Ids = { 0, 1, 2, 3 };
  Scene flat = jitteredScene(3, 3, 2); // the middle layer is one ulp high
  flat.Name = "flat";
  for (std::size_t i = 2; i < flat.Points.size(); i += 3)
  {
    double& z = flat.Points[i];
    const bool inner = z > 0 && z < 1;
    z = inner ? (z < 0.5 ? 0.25 : std::nextafter(0.25, 1.0)) : z;
  }
  return { regularScene(3, 4), jitteredScene(3, 4, 1), corner, flat };
}

tipp::Lattice latticeOf(int dimension, int n, double low, double high)
{
  tipp::Lattice lattice;
  for (int axis = 0; axis < dimension; ++axis)
  {
    lattice.Min[std::size_t(axis)] = low;
    lattice.Delta[std::size_t(axis)] = n > 1 ? (high - low) / (n - 1) : 1;
    lattice.Extent[std::size_t(2 * axis + 1)] = n - 1;
  }
  return lattice;
}

void sampleOf(const tipp::Lattice& lattice, std::int64_t sample, double (&coordinates)[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t index = sample % lattice.size(axis) + lattice.Extent[std::size_t(2 * axis)];
    sample /= lattice.size(axis);
    coordinates[axis] = tipp::GridSteps(
      lattice.Min[std::size_t(axis)], lattice.Delta[std::size_t(axis)])[double(index)];
  }
}
