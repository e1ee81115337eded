// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippChosenTriangles_h
#define tippChosenTriangles_h

#include "Predicates/Geometry.h"
#include "Resample/SimplexMesh.h"
#include "Series/MeshSeries.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// The triangles of a series' mesh that some purpose needs, with their nodes alone: of a large mesh
/// a small part. The mesh is read block by block and never in memory as a whole.
class ChosenTriangles
{
public:
  /// Whether a triangle with this bounding box is needed. Threads call it concurrently.
  using Test = std::function<bool(const Box2& box)>;
  /// Makes the test when the nodes of the file are known.
  using MakeTest = std::function<Test(const SeriesNodes& nodes)>;

  /// Throws IOError, also if the mesh has more than 2^31 - 1 nodes or cells.
  ChosenTriangles(MeshSeries& series, const MakeTest& makeTest, int threads);

  /// The bounding box of all triangles of the mesh whose corners are finite, chosen or not.
  const Box2& bounds() const { return this->Bounds; }

  /// A view of the chosen triangles, in their order in the mesh. This must outlive it.
  SimplexMesh mesh() const;

  /// The index in the mesh of a chosen triangle.
  std::int64_t indexOf(std::int64_t triangle) const { return this->Indices[std::size_t(triangle)]; }
  /// The node of a chosen triangle's corner, as mesh() numbers it.
  std::int32_t node(std::int64_t triangle, std::size_t corner) const
  {
    return this->Corners[3 * std::size_t(triangle) + corner];
  }

  /// Where the file has the values of some of the chosen nodes, or triangles.
  struct Stored
  {
    std::vector<std::int32_t> At;    ///< for MeshSeries::readAt()
    std::vector<std::int32_t> Ranks; ///< of each of them in At; empty: their own order
  };
  /// `chosen`: ascending indices of nodes of mesh().
  Stored storedNodes(std::vector<std::int32_t> chosen) const;
  /// `chosen`: ascending indices of triangles of mesh().
  std::vector<std::int32_t> storedCells(std::vector<std::int32_t> chosen) const;

private:
  void take(MeshSeries& series, const SeriesNodes& nodes, const SeriesTriangles& triangles,
    const Test& test, int threads);
  void keepNodes(SeriesNodes nodes, int threads);

  Box2 Bounds = Box2::empty();
  std::int64_t Triangles = 0;            ///< of the mesh, up to now
  std::vector<std::int32_t> Corners;     ///< three nodes per triangle
  std::vector<std::int32_t> Indices;     ///< of the triangles in the mesh
  std::vector<std::int32_t> Cells;       ///< of the file; empty: as Indices
  std::vector<double> XYZ;               ///< of the chosen nodes
  std::vector<std::int32_t> StoredNodes; ///< the file's node of each
};

} // namespace tipp

#endif
