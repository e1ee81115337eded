// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SurfaceOfMesh.h"

#include "Sampling/PlainValues.h"
#include "Sampling/SimplexParts.h"
#include "Vtk/Compatibility.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointSet.h"

#include <list>
#include <memory>

namespace tipp
{
namespace
{

/// A mesh, its triangles, and the values that were asked for.
struct KeptMesh
{
  vtkSmartPointer<vtkPointSet> Mesh;
  SimplexParts Parts;
  std::list<PlainValues> Values; ///< stay where they are
};

vtkDataSetAttributes* attributesOf(vtkPointSet* mesh, bool ofCells)
{
  return mesh->GetAttributes(ofCells ? vtkDataObject::CELL : vtkDataObject::POINT);
}

std::vector<SurfaceArray> arraysOf(vtkPointSet* mesh)
{
  std::vector<SurfaceArray> arrays;
  for (const bool ofCells : { true, false })
  {
    vtkDataSetAttributes* const data = attributesOf(mesh, ofCells);
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* const array = data->GetArray(i);
      const std::string name = array && array->GetName() ? array->GetName() : "";
      if (!name.empty() && name != vtkDataSetAttributes::GhostArrayName() &&
        array != data->GetGlobalIds() && scalarOf(array->GetDataType()))
      {
        arrays.push_back({ name, array->GetNumberOfComponents(), ofCells });
      }
    }
  }
  return arrays;
}

} // namespace

SurfacePart surfaceOf(
  vtkPointSet* mesh, const std::string& name, const std::vector<int>& axes, int threads)
{
  const auto kept = std::make_shared<KeptMesh>();
  kept->Mesh = mesh;
  kept->Parts = makeTriangles(mesh, name, axes, threads);
  const SimplexSet& triangles = kept->Parts.Triangles;
  SurfacePart surface;
  surface.Mesh = triangles.Mesh;
  surface.Parents = triangles.Parents.empty() ? nullptr : triangles.Parents.data();
  surface.Cells = mesh->GetNumberOfCells();
  surface.NotFinite = kept->Parts.NotFinite;
  surface.Arrays = arraysOf(mesh);
  surface.Values = [kept = kept.get()](const SurfaceArray& array)
  {
    vtkDataArray* const found =
      attributesOf(kept->Mesh, array.OfCells)->GetArray(array.Name.c_str());
    kept->Values.emplace_back(contiguous(found));
    return kept->Values.back().data();
  };
  surface.Owner = kept;
  return surface;
}

} // namespace tipp
