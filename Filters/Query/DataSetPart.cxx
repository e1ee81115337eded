// SPDX-License-Identifier: BSD-3-Clause
#include "Query/DataSetPart.h"

#include "Arrays/Scalar.h"
#include "Parallel/ParallelFor.h"
#include "Sampling/SamplingRange.h"
#include "Sampling/SimplexParts.h"
#include "Vtk/CellArrays.h"
#include "Vtk/ReadDataSet.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt64Array.h"

#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Owns everything that a MeshPart of a data set refers to.
struct Kept
{
  vtkSmartPointer<vtkPointSet> Mesh;
  SimplexParts Simplices;
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays;
  std::vector<std::int64_t> CellIds; ///< global id of the cell that each simplex is a part of
};

/// Returns the array, or a copy if its tuples are not contiguous; `kept` holds a reference.
vtkDataArray* keep(vtkDataArray* array, Kept& kept)
{
  kept.Arrays.push_back(contiguous(array));
  return kept.Arrays.back();
}

void addArrays(vtkDataSetAttributes* data, bool ofPoints, Kept& kept, MeshPart& part)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = data->GetArray(i);
    if (!array || !array->GetName() || !scalarOf(array->GetDataType()) ||
      array == data->GetGlobalIds() ||
      std::strcmp(array->GetName(), vtkDataSetAttributes::GhostArrayName()) == 0)
    {
      continue;
    }
    StoredArray description;
    description.Name = array->GetName();
    description.OfPoints = ofPoints;
    description.Type = *scalarOf(array->GetDataType());
    description.Components = array->GetNumberOfComponents();
    part.Arrays.push_back({ description, keep(array, kept)->GetVoidPointer(0) });
  }
}

const std::int64_t* globalIds(vtkDataSetAttributes* data, Kept& kept)
{
  vtkDataArray* const ids = data->GetGlobalIds();
  static_assert(sizeof(vtkIdType) == sizeof(std::int64_t));
  return ids && scalarOf(ids->GetDataType()) == Scalar::Int64
    ? static_cast<const std::int64_t*>(keep(ids, kept)->GetVoidPointer(0))
    : nullptr;
}

} // namespace

MeshPart partOf(vtkDataObject* data, int threads)
{
  const auto kept = std::make_shared<Kept>();
  for (vtkPointSet* const mesh : data ? meshesOf(data, threads) : std::vector<vtkPointSet*>())
  {
    if (mesh->GetNumberOfCells() > 0)
    {
      if (kept->Mesh)
      {
        throw std::runtime_error(
          "the mesh is made of several data sets; put them together first, as by vtkAppendFilter.");
      }
      kept->Mesh = mesh;
    }
  }
  MeshPart part;
  if (!kept->Mesh)
  {
    return part;
  }
  kept->Simplices = makeSimplices(kept->Mesh, { 0, 1 }, threadCount(threads));
  const bool inSpace = kept->Simplices.Tetrahedra.Mesh.Cells > 0;
  SimplexSet& set = inSpace ? kept->Simplices.Tetrahedra : kept->Simplices.Triangles;
  part.Mesh = set.Mesh;
  part.OwnedCells = part.Mesh.Cells;
  addArrays(kept->Mesh->GetPointData(), true, *kept, part);
  addArrays(kept->Mesh->GetCellData(), false, *kept, part);
  part.PointIds = globalIds(kept->Mesh->GetPointData(), *kept);
  part.CellIds = globalIds(kept->Mesh->GetCellData(), *kept);
  if (!set.Parents.empty())
  {
    part.Rows = set.Parents.data();
    if (part.CellIds)
    {
      for (const std::int64_t parent : set.Parents)
      {
        kept->CellIds.push_back(part.CellIds[parent]);
      }
    }
    part.CellIds = part.CellIds ? kept->CellIds.data() : part.Rows;
  }
  part.Keeps = kept;
  return part;
}

} // namespace tipp
