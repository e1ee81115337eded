// SPDX-License-Identifier: BSD-3-Clause
#include "Output/FilterPipeline.h"

#include "vtkAlgorithm.h"
#include "vtkCommunicator.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"

namespace tipp
{

vtkStandardNewMacro(CollectivePipeline);

int CollectivePipeline::ForwardUpstream(vtkInformation* request)
{
  const int own = this->Superclass::ForwardUpstream(request);
  vtkMultiProcessController* ranks =
    this->GetAlgorithm() && this->Controller ? this->Controller() : nullptr;
  // A rank that fails before the data request will not reach this point again; the others will.
  if (!ranks || ranks->GetNumberOfProcesses() < 2 || (own && !request->Has(REQUEST_DATA())))
  {
    return own;
  }
  const int rank = ranks->GetLocalProcessId();
  const int none = ranks->GetNumberOfProcesses();
  const int mine = own ? none : rank;
  int failed = none;
  ranks->AllReduce(&mine, &failed, 1, vtkCommunicator::MIN_OP);
  if (failed < none && rank == 0)
  {
    vtkErrorWithObjectMacro(this->GetAlgorithm(),
      "Rank " << failed << ": what is upstream of the filter failed, see its message; no rank "
              << "executes the filter.");
  }
  return failed == none;
}

} // namespace tipp
