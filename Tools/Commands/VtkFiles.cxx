// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/VtkFiles.h"

#include "Query/QueryData.h"
#include "Vtk/DataSets.h"

#include "vtkDataSet.h"

namespace tipp
{

MeshPart readVtkPart(const std::string& path, int threads)
{
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  removeGhostCells(data);
  return partOf(data, threads);
}

void flattenVtkFile(
  const std::string& path, const std::function<void(const Flattened& flattened)>& use)
{
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  use(flattenDataSet(data, path));
}

} // namespace tipp
