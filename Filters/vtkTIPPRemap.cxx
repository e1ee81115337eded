// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPRemap.h"

#include "Parallel/ParallelFor.h"
#include "Pipeline/FilterPipeline.h"
#include "Sampling/RemapMesh.h"
#include "Sampling/SamplingRange.h"
#include "Vtk/DataSets.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

vtkStandardNewMacro(vtkTIPPRemap);

vtkTIPPRemap::vtkTIPPRemap()
{
  this->SetNumberOfInputPorts(2);
}

int vtkTIPPRemap::FillInputPortInformation(int port, vtkInformation* info)
{
  return tipp::acceptInput(info, port == 0 ? "vtkPointSet" : "vtkDataObject");
}

int vtkTIPPRemap::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  return tipp::askForWholeInputs(inputs, 2);
}

int vtkTIPPRemap::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPointSet* const output = vtkPointSet::GetData(outputs);
  output->Initialize();
  return tipp::runReported(this, nullptr, "", outputs,
    [&]
    { this->Execute(vtkPointSet::GetData(inputs[0]), vtkDataObject::GetData(inputs[1]), output); });
}

void vtkTIPPRemap::Execute(vtkPointSet* target, vtkDataObject* source, vtkPointSet* output)
{
  const tipp::ThreadLimit limit(this->NumberOfThreads);
  const int threads = tipp::threadCount(this->NumberOfThreads);
  tipp::checkDataSet(target, "the target mesh", threads);
  tipp::MeshRemapper remapper(target, this->Arrays, threads);
  tipp::Monitor monitor(this);
  const std::vector<vtkPointSet*> meshes = tipp::meshesOf(source, threads, "the source mesh");
  const double share = 1 / double(meshes.empty() ? 1 : meshes.size());
  double begin = 0;
  for (vtkPointSet* const mesh : meshes)
  {
    if (!remapper.add(mesh, [&](double fraction) { return monitor(begin + share * fraction); }))
    {
      return;
    }
    begin += share;
  }
  output->ShallowCopy(remapper.finish(this->NullValue));
  if (remapper.coveredTwice() > 0)
  {
    vtkWarningMacro("Cells of the source overlap: " << remapper.coveredTwice()
                                                    << " cells of the result are covered more than "
                                                       "once, and each cell counts.");
  }
}

void vtkTIPPRemap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(Arrays);
  vtkTIPPPrintMacro(NullValue);
  vtkTIPPPrintMacro(NumberOfThreads);
}
