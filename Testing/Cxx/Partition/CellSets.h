// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellSets_h
#define tippCellSets_h

#include "Partition/ClassifyCells.h"

#include <string>
#include <vector>

/// Cells with their coordinates, made to a kind.
struct CellSet
{
  int Dimension = 2;
  int Corners = 3;
  std::vector<double> Coordinates;

  tipp::CellsView view() const;
  std::size_t size() const;
  /// Bounds of the cells; flat in z where the set lies in the plane.
  tipp::Box3 bounds() const;
};

/// n x n squares of two triangles, or n x n x n cubes of six tetrahedra, on a lattice whose nodes
/// are moved by up to `jitter` of its step: with 0, cells touch the boxes of many a grid.
CellSet latticeTriangles(int n, double jitter, unsigned seed = 1);
CellSet latticeTetrahedra(int n, double jitter, unsigned seed = 1);

/// The triangles in space: z is a function of x and y.
CellSet surface(const CellSet& triangles);

/// Cells of all lengths, anywhere in the unit square or cube, long slivers and flat ones among
/// them; most coordinates are multiples of 1/16, the others have all digits.
CellSet cellSoup(int dimension, int corners, std::size_t count, unsigned seed);

/// Triangles around one point, from long ones to tiny ones.
CellSet fan(std::size_t count);

/// A tree tiling of the cells' bounds: a node of depth below `depth` is split if the seed says so.
tipp::BoxTiling randomTree(int dimension, const tipp::Box3& domain, int depth, unsigned seed);

/// By clipping in rationals, each cell against each box.
tipp::Membership bruteForce(const CellSet& cells, const tipp::BoxTiling& tiling);

/// Word by word; the first difference is a test failure.
void expectEqual(const tipp::Membership& expected, const tipp::Membership& actual);

#endif
