// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/UpdatedInput.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace tipp
{

vtkDataObject* updatedInput(
  vtkAlgorithm* filter, vtkMultiProcessController* ranks, vtkInformation* outInfo)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  int port = 0;
  vtkAlgorithm* const source = filter->GetInputAlgorithm(0, 0, port);
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(source->GetNumberOfOutputPorts());
  vtkInformation* const request = requests->GetInformationObject(port);
  request->Set(Pipeline::UPDATE_PIECE_NUMBER(), ranks ? ranks->GetLocalProcessId() : 0);
  request->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), ranks ? ranks->GetNumberOfProcesses() : 1);
  if (outInfo->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    request->CopyEntry(outInfo, Pipeline::UPDATE_TIME_STEP());
  }
  source->Update(port, requests);
  return source->GetOutputDataObject(port);
}

} // namespace tipp
