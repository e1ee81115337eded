// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippModelMesh_h
#define tippModelMesh_h

#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Nodes and triangles of a mesh in the file of a model or a mesh generator. Nodes are in the order
/// of the file.
struct ModelMesh
{
  /// Values at the nodes.
  struct Column
  {
    std::string Name;
    std::vector<double> Values;
  };

  std::vector<double> XY; ///< x and y of the nodes, interleaved
  std::vector<Column> Columns;
  std::vector<std::int64_t> Triangles; ///< three node indices, from 0, per triangle
  std::vector<double> Regions;         ///< one number per triangle; empty: the file has none
  /// The index of the file's cell that each triangle is a part of; empty: the cells are triangles.
  std::vector<std::int64_t> OriginalCells;
  /// The numbers that the file gives the nodes, where files of values need them; empty: from 1 on.
  std::vector<std::int64_t> Numbers;
};

/// What is read of a mesh besides its nodes.
enum class ModelPart
{
  Nodes,
  Triangles
};

/// Reads the mesh of an ADCIRC or SCHISM grid (.14, .grd, .gr3), of SMS (.2dm), of Gmsh (.msh), of
/// Triangle (.node, .ele), of NetCDF (.nc) or of SELAFIN (.slf), by the extension. All node indices
/// are valid. Quadrilaterals of SMS and polygons of NetCDF are cut into triangles. Throws IOError,
/// with the line, for a file that is damaged or has other elements. With ModelPart::Nodes, other
/// elements are allowed.
VTKTIPPIO_EXPORT ModelMesh readModelMesh(const std::string& path, ModelPart part);

/// Whether readModelMesh() reads the file, by its extension.
VTKTIPPIO_EXPORT bool isModelMesh(const std::string& path);

///@{
/// readModelMesh() for one kind of file.
ModelMesh readSmsMesh(const std::string& path, ModelPart part);
ModelMesh readGmshMesh(const std::string& path, ModelPart part);
ModelMesh readTriangleMesh(const std::string& path, ModelPart part);
/// Without the values of time steps; in IO/Series.
ModelMesh readSeriesMesh(const std::string& path, ModelPart part);
///@}

} // namespace tipp

#endif
