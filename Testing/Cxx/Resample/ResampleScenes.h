// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleScenes_h
#define tippResampleScenes_h

#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"

#include <cstdint>
#include <string>
#include <vector>

/// A small mesh in memory.
struct Scene
{
  std::string Name;
  int Dimension = 2;
  std::vector<double> Points; ///< x, y, z of each point
  std::vector<std::int64_t> Ids;

  int cells() const { return int(this->Ids.size()) / (this->Dimension + 1); }
  const double* point(std::int64_t id) const { return this->Points.data() + 3 * id; }
  bool boxContains(int cell, const double* sample) const;
  tipp::SimplexMesh mesh() const;

  /// The same mesh with coordinates rounded to float32.
  Scene rounded() const;
  /// The same mesh with its cells, and the corners in each cell, in another order.
  Scene shuffled(unsigned seed) const;
  const double* corner(int cell, int i) const
  {
    return this->point(this->Ids[std::size_t(cell * (this->Dimension + 1) + i)]);
  }
};

/// A copy of a scene's mesh, with float32 points and int32 ids on request.
struct StoredMesh
{
  StoredMesh(const Scene& scene, bool singlePrecision, bool narrowIds);
  StoredMesh(const StoredMesh&) = delete;
  StoredMesh& operator=(const StoredMesh&) = delete;

  std::vector<float> Points;
  std::vector<std::int32_t> Ids;
  tipp::SimplexMesh Mesh;
};

/// A regular mesh of the unit square or cube, cut by diagonals, so that samples fall on edges and
/// corners.
Scene regularScene(int dimension, int steps);
/// As regularScene(), with the inner points moved at random.
Scene jitteredScene(int dimension, int steps, unsigned seed);
/// Extremely flat triangles: the points are in columns, and heights in a column differ by a few
/// ulps.
Scene sliverScene();
/// A fan of thin triangles around (0.5, 0.5), with a gap.
Scene fanScene(int wedges);
/// Triangles at random positions, which overlap.
Scene overlappingScene(int triangles, unsigned seed);

/// Divides the scene into `side` tiles along each axis, by the centres of its cells. Each part has
/// its own points, or all points.
std::vector<Scene> tilesOf(const Scene& scene, int side, bool ownPoints);

std::vector<Scene> planeScenes();
std::vector<Scene> spaceScenes();

/// A lattice with n samples along each axis of the mesh's dimension, from low to high.
tipp::Lattice latticeOf(int dimension, int n, double low, double high);

/// The coordinates of the sample with this index.
void sampleOf(const tipp::Lattice& lattice, std::int64_t sample, double (&coordinates)[3]);

#endif
