// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLocatedVariables_h
#define tippLocatedVariables_h

#include "Series/MeshSeries.h"
#include "Series/NetcdfMesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The dimensions of a mesh, as files with values may have them, too.
struct MeshDimensions
{
  std::string NodeName;
  std::string CellName;
  std::int64_t Nodes = 0;
  std::int64_t Cells = 0;
};

MeshDimensions dimensionsOf(const NetcdfContent& content, const NetcdfMesh& mesh);

/// A variable with one value per node or cell, and possibly per time step.
struct LocatedVariable
{
  SeriesVariable Described;
  const NetcdfVariable* Variable = nullptr;
  int TimeAxis = -1;  ///< the index of time among its dimensions; -1: it does not vary
  int SpaceAxis = -1; ///< the index of the nodes or cells among its dimensions
};

struct LocatedVariables
{
  std::vector<LocatedVariable> Variables;
  std::vector<SeriesLeftOut> LeftOut;
};

/// What locateVariables() must know of the mesh and the file.
struct LocatingContext
{
  const NetcdfMesh* Mesh;
  MeshDimensions Dimensions;
  int TimeDimension;
  bool HasMesh; ///< the file is that with the mesh
};

/// Finds the variables with values at nodes or cells. Throws IOError if the file belongs to another
/// mesh.
LocatedVariables locateVariables(
  const std::string& path, const NetcdfContent& content, const LocatingContext& context);

} // namespace tipp

#endif
