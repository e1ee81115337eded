// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/RemapMesh.h"

#include "Sampling/SurfaceOfMesh.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <utility>

namespace tipp
{

MeshRemapper::MeshRemapper(vtkPointSet* target, std::vector<std::string> names, int threads)
  : Target(target)
  , Threads(threads)
  , Remapper(surfaceOf(target, "The target mesh", { 0, 1 }, threads), std::move(names), threads)
{
}

bool MeshRemapper::add(vtkPointSet* source, const Report& report)
{
  return this->Remapper.add(surfaceOf(source, "The source mesh", { 0, 1 }, this->Threads), report);
}

vtkSmartPointer<vtkPointSet> MeshRemapper::finish(double null)
{
  return withCellMeans(this->Target, this->Remapper.finish(null));
}

vtkSmartPointer<vtkPointSet> withCellMeans(
  vtkPointSet* mesh, const std::vector<SurfaceMeans>& means)
{
  const auto result = vtkSmartPointer<vtkPointSet>::Take(mesh->NewInstance());
  result->CopyStructure(mesh);
  for (const SurfaceMeans& mean : means)
  {
    const vtkNew<vtkDoubleArray> array;
    array->SetName(mean.Name.c_str());
    array->SetNumberOfComponents(mean.Components);
    array->SetNumberOfTuples(mesh->GetNumberOfCells());
    std::copy(mean.Values.begin(), mean.Values.end(), array->GetPointer(0));
    result->GetCellData()->AddArray(array);
  }
  return result;
}

} // namespace tipp
