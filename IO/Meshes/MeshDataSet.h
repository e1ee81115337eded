// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshDataSet_h
#define tippMeshDataSet_h

#include "Meshes/TrianglesView.h"
#include "Points/PointTable.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace tipp
{

/// The content of a data set besides columns of points; each may be null or empty.
struct MeshData
{
  const std::vector<std::int64_t>* Representatives = nullptr; ///< one point id per point
  const std::vector<std::int64_t>* Neighbors = nullptr;       ///< three triangle ids per triangle
};

/// Creates data sets over the caller's memory (only coordinates and cell offsets are copies): they
/// must not outlive it, and are for writers, which do not change it. A column named z is the third
/// coordinate, the others are point data.
vtkSmartPointer<vtkPolyData> makePolyData(
  const PointTable& points, TrianglesView triangles, const MeshData& more);
vtkSmartPointer<vtkUnstructuredGrid> makeUnstructuredGrid(
  const PointTable& points, TrianglesView triangles, const MeshData& more);

} // namespace tipp

#endif
