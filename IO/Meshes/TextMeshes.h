// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTextMeshes_h
#define tippTextMeshes_h

#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Meshes/MeshOptions.h"
#include "Points/ReadPoints.h"

#include <cstddef>
#include <string>

// Writers of meshes as text, for models and mesh generators. Numbers are the shortest ones from
// which the doubles can be restored. Each function writes its files completely or not at all,
// returns false if options.Aborted returned true, and throws IOError, also if a coordinate is not
// finite, which none of the formats can hold.

namespace tipp
{

/// Writes a grid of ADCIRC or SCHISM (.14, .grd, .gr3). The depth of a node is the column depth,
/// else the negated elevation, else 0. With options.AdcircLike, its title, node numbers and
/// boundary lists are kept. Otherwise nodes are numbered from 1, and the boundaries are
/// options.Boundaries.
bool writeAdcircGrid(const std::string& path, const NodesView& nodes, TrianglesView triangles,
  const MeshOptions& options);

/// Writes a mesh of SMS (.2dm), with nodes numbered from 1. z is the elevation, else the negated
/// depth, else 0; the material is the region, else 1.
bool writeSmsMesh(const std::string& path, const NodesView& nodes, TrianglesView triangles,
  const MeshOptions& options);

/// Writes a mesh of Gmsh in ASCII of version 2.2, with nodes numbered from 1. z is as in
/// writeSmsMesh(). Regions above 0 are physical groups, named "region N"; the triangles of region 0
/// are in no group. Throws IOError for negative regions, which Gmsh does not allow.
bool writeGmshMesh(const std::string& path, const NodesView& nodes, TrianglesView triangles,
  const MeshOptions& options);

/// Writes files of Triangle, numbered from 1: NAME.node with all columns as attributes, the
/// elevation first; NAME.ele, with the region as attribute; and, if there are options.Segments,
/// NAME.poly, which refers to NAME.node. options.Before holds for `path`. The files appear one
/// after the other once all are complete.
bool writeTriangleFiles(const std::string& path, const NodesView& nodes, TrianglesView triangles,
  const MeshOptions& options);

/// @name Parts of these files
///@{
/// Appends a blank and the number.
void appendNumber(std::string& line, double value);
/// Appends x and y of a node, and a third number.
void appendNode(std::string& line, const NodesView& nodes, std::size_t node, double third);
/// Ends a file. Returns false, without the file, if options.Aborted returns true.
bool finishMesh(OutputStream& out, PendingFile& pending, const MeshOptions& options);
/// Throws IOError if a coordinate is not finite.
void requireFinite(const std::string& path, const NodesView& nodes);
/// Values of nodes: those of a column, which may be negated, or zeros.
struct NodeValues
{
  const NodeColumn* Column = nullptr; ///< null: zeros
  bool IsNegated = false;

  double operator[](std::size_t node) const
  {
    const double value = this->Column ? this->Column->Values[node] : 0;
    return this->IsNegated ? 0 - value : value;
  }
};
/// The column depth, else the negated elevation, else zeros.
NodeValues depthsOf(const NodesView& nodes);
/// The elevation, else the negated column depth, else zeros.
NodeValues elevationsOf(const NodesView& nodes);
///@}

} // namespace tipp

#endif
