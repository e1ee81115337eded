// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/UpdatedInput.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace tipp
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkDataObject* updatedInput(vtkAlgorithm* filter, int rank, int ranks, vtkInformation* outInfo)
{
  int port = 0;
  vtkAlgorithm* const source = filter->GetInputAlgorithm(0, 0, port);
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(source->GetNumberOfOutputPorts());
  vtkInformation* const request = requests->GetInformationObject(port);
  request->Set(Pipeline::UPDATE_PIECE_NUMBER(), rank);
  request->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), ranks);
  if (outInfo->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    request->CopyEntry(outInfo, Pipeline::UPDATE_TIME_STEP());
  }
  return source->Update(port, requests) ? source->GetOutputDataObject(port) : nullptr;
}

void askForPiece(vtkInformation* inInfo, int piece, int pieces)
{
  inInfo->Remove(Pipeline::UPDATE_EXTENT());
  if (inInfo->Has(Pipeline::WHOLE_EXTENT())) // structured data
  {
    inInfo->Set(Pipeline::UPDATE_EXTENT(), inInfo->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  inInfo->Set(Pipeline::UPDATE_PIECE_NUMBER(), piece);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

} // namespace tipp
