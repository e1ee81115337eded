// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellSets_h
#define tippCellSets_h

#include "Partition/ClassifyCells.h"

#include <string>
#include <vector>

/// Cells of one kind with the coordinates of their corners.
struct CellSet
{
  int Dimension = 2;
  int Corners = 3;
  std::vector<double> Coordinates;

  tipp::CellsView view() const;
  std::size_t size() const;
  /// The bounds of all corners. For cells in the plane, z is 0.
  tipp::Box3 bounds() const;
};

/// n x n squares of two triangles, or n x n x n cubes of six tetrahedra, on a lattice whose nodes
/// are moved by up to `jitter` of its step. With 0, cells touch the boxes of many grids.
CellSet latticeTriangles(int n, double jitter, unsigned seed = 1);
CellSet latticeTetrahedra(int n, double jitter, unsigned seed = 1);

/// The triangles as a surface in space: z is a function of x and y.
CellSet surface(const CellSet& triangles);

/// `count` random cells of all sizes in the unit square or cube, some of them long or flat. Most
/// coordinates are multiples of 1/16; the others use all digits.
CellSet cellSoup(int dimension, int corners, std::size_t count, unsigned seed);

/// Triangles around one point, of very different sizes.
CellSet fan(std::size_t count);

/// A tiling of the domain by the leaves of a random tree, which is at most `depth` levels deep.
tipp::BoxTiling randomTree(int dimension, const tipp::Box3& domain, int depth, unsigned seed);

/// The partitions that each cell meets, by clipping each cell with each box in rational arithmetic.
tipp::Membership bruteForce(const CellSet& cells, const tipp::BoxTiling& tiling);

/// Expects equal words, and reports the first difference.
void expectEqual(const tipp::Membership& expected, const tipp::Membership& actual);

#endif
