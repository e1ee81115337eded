// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDescribeMesh_h
#define tippDescribeMesh_h

#include "OutOfCore/OutOfCoreOptions.h"
#include "Partitioned/GrowingPiece.h"
#include "Partitioned/PartitionedMesh.h"
#include "Predicates/Geometry.h"
#include "Triangulation/Tiling.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tipp
{

/// Sets the layout of the points' rows, and the arrays of a mesh of triangles or tetrahedra.
/// `elevation`: index of the column with the third coordinate; the number of columns if there is
/// none. Throws IOError if two arrays would have one name.
void describeColumns(const std::vector<std::string>& columns, std::size_t elevation,
  const OutOfCoreRunOptions& options, PointRowLayout& rows, PartitionedMesh& mesh);

/// Sets the domain, the number of points and the pieces' boxes of a mesh.
template <typename Plan, typename Survey>
void describePieces(const Plan& plan, const Survey& survey, PartitionedMesh& mesh)
{
  mesh.Domain = inSpace(scaled(survey.Bounds, 1 / survey.Factor));
  mesh.Points = survey.Points;
  mesh.Tiling = "delaunay:" + std::to_string(plan.pieces());
  mesh.Pieces.resize(std::size_t(plan.pieces()));
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    mesh.Pieces[plan.number(piece)].Box = inSpace(scaled(plan.box(piece), 1 / survey.Factor));
  }
}

} // namespace tipp

#endif
