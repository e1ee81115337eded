// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPCutFill.h"

#include "Parallel/ParallelFor.h"
#include "Pipeline/FilterPipeline.h"
#include "Sampling/CompareSurfaces.h"
#include "Sampling/SamplingRange.h"
#include "Sampling/SurfaceOfMesh.h"
#include "Vtk/DataSets.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkTable.h"

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkTIPPCutFill);

namespace
{

void addColumn(vtkTable* table, const char* name, double value)
{
  const vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  column->InsertNextValue(value);
  table->AddColumn(column);
}

} // namespace

vtkTIPPCutFill::vtkTIPPCutFill()
{
  this->SetNumberOfInputPorts(2);
}

int vtkTIPPCutFill::FillInputPortInformation(int port, vtkInformation* info)
{
  return tipp::acceptInput(info, port == 0 ? "vtkPointSet" : "vtkDataObject");
}

int vtkTIPPCutFill::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  return tipp::askForWholeInputs(inputs, 2);
}

int vtkTIPPCutFill::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkTable* const output = vtkTable::GetData(outputs);
  output->Initialize();
  return tipp::runReported(this, nullptr, "", outputs,
    [&]
    { this->Execute(vtkPointSet::GetData(inputs[0]), vtkDataObject::GetData(inputs[1]), output); });
}

void vtkTIPPCutFill::Execute(vtkPointSet* before, vtkDataObject* after, vtkTable* output)
{
  const tipp::ThreadLimit limit(this->NumberOfThreads);
  const int threads = tipp::threadCount(this->NumberOfThreads);
  std::optional<tipp::Box2> bounds;
  if (this->UseBounds)
  {
    bounds = tipp::boxOfVtkBounds<2>(this->Bounds);
    if (!(bounds->Min.x < bounds->Max.x && bounds->Min.y < bounds->Max.y))
    {
      throw std::runtime_error("Bounds have no area: give xmin, xmax, ymin and ymax.");
    }
  }
  const std::array<std::string, 2> names = { "the surface before", "the surface after" };
  tipp::checkDataSet(before, names[0], threads);
  const auto surfaceOf = [threads](vtkPointSet* mesh, const std::string& name) {
    return tipp::surfaceOf(mesh, name, { 0, 1, 2 }, threads);
  };
  tipp::SurfaceComparison comparison(surfaceOf(before, names[0]), names, bounds, threads);
  tipp::Monitor monitor(this);
  const std::vector<vtkPointSet*> meshes = tipp::meshesOf(after, threads, names[1]);
  const double share = 1 / double(meshes.empty() ? 1 : meshes.size());
  double begin = 0;
  for (vtkPointSet* const mesh : meshes)
  {
    if (!comparison.add(surfaceOf(mesh, names[1]),
          [&](double fraction) { return monitor(begin + share * fraction); }))
    {
      return;
    }
    begin += share;
  }
  const tipp::CutFill result = comparison.result();
  tipp::warn(this, comparison.warnings(result));
  addColumn(output, "Cut", result.Cut);
  addColumn(output, "Fill", result.Fill);
  addColumn(output, "Net", result.net());
  addColumn(output, "Area", result.Area);
  addColumn(output, "OnlyBefore", result.OnlyFirst);
  addColumn(output, "OnlyAfter", result.OnlySecond);
}

void vtkTIPPCutFill::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(UseBounds);
  vtkTIPPPrintMacro(Bounds);
  vtkTIPPPrintMacro(NumberOfThreads);
}
