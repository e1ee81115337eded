// SPDX-License-Identifier: BSD-3-Clause
#include "Output/FilterPipeline.h"

#include "Ranks/Communicator.h"

#include "vtkAlgorithm.h"
#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <cmath>
#include <exception>
#include <new>
#include <stdexcept>

namespace tipp
{

using Executive = vtkStreamingDemandDrivenPipeline;

void requireFinite(std::initializer_list<std::pair<const char*, double>> properties)
{
  for (const auto& [name, value] : properties)
  {
    if (!std::isfinite(value))
    {
      throw std::runtime_error(
        std::string(name) + " is " + std::to_string(value) + ": give a finite number.");
    }
  }
}

void requireUnused(std::initializer_list<std::pair<const char*, bool>> properties)
{
  for (const auto& [name, isUsed] : properties)
  {
    if (isUsed)
    {
      throw std::invalid_argument(
        std::string(name) + " needs a single rank: set the controller to null on one rank.");
    }
  }
}

void warn(vtkAlgorithm* filter, const std::vector<std::string>& warnings)
{
  for (const std::string& warning : warnings)
  {
    vtkWarningWithObjectMacro(filter, << warning);
  }
}

bool hasSeveralRanks(vtkMultiProcessController* controller)
{
  return controller && controller->GetNumberOfProcesses() > 1;
}

int runReported(vtkAlgorithm* filter, vtkMultiProcessController* controller, const char* doing,
  vtkPointSet* input, std::initializer_list<vtkDataObject*> outputs,
  const std::function<void()>& work)
{
  const std::string what =
    std::string(doing) + " " + std::to_string(input->GetNumberOfPoints()) + " points";
  bool isStopped = false;
  try
  {
    work();
    return 1;
  }
  catch (const RankFailure& failure)
  {
    isStopped = failure.Aborted;
    if (!isStopped && (!controller || controller->GetLocalProcessId() == 0))
    {
      vtkErrorWithObjectMacro(filter, "Rank " << failure.Rank << ": " << failure.what());
    }
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorWithObjectMacro(
      filter, << what << ": not enough memory; use fewer points or a machine with more memory.");
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(filter, << what << ": " << error.what());
  }
  for (vtkDataObject* const output : outputs)
  {
    output->Initialize();
  }
  return isStopped ? 1 : 0;
}

vtkDataObject* updatedInput(vtkAlgorithm* filter, int rank, int ranks, vtkInformation* outInfo)
{
  int port = 0;
  vtkAlgorithm* const source = filter->GetInputAlgorithm(0, 0, port);
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(source->GetNumberOfOutputPorts());
  vtkInformation* const request = requests->GetInformationObject(port);
  request->Set(Executive::UPDATE_PIECE_NUMBER(), rank);
  request->Set(Executive::UPDATE_NUMBER_OF_PIECES(), ranks);
  if (outInfo->Has(Executive::UPDATE_TIME_STEP()))
  {
    request->CopyEntry(outInfo, Executive::UPDATE_TIME_STEP());
  }
  return source->Update(port, requests) ? source->GetOutputDataObject(port) : nullptr;
}

namespace
{

void setPiece(vtkInformation* inInfo, int piece, int pieces)
{
  inInfo->Set(Executive::UPDATE_PIECE_NUMBER(), piece);
  inInfo->Set(Executive::UPDATE_NUMBER_OF_PIECES(), pieces);
  inInfo->Set(Executive::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

} // namespace

void askForPiece(vtkInformation* inInfo, int piece, int pieces)
{
  inInfo->Remove(Executive::UPDATE_EXTENT());
  if (inInfo->Has(Executive::WHOLE_EXTENT())) // structured data
  {
    inInfo->Set(Executive::UPDATE_EXTENT(), inInfo->Get(Executive::WHOLE_EXTENT()), 6);
  }
  setPiece(inInfo, piece, pieces);
}

void askForRankPiece(vtkInformation* inInfo, vtkMultiProcessController* controller)
{
  setPiece(inInfo, controller->GetLocalProcessId(), controller->GetNumberOfProcesses());
}

bool wantsGhosts(vtkInformationVector* outputs)
{
  return outputs->GetInformationObject(0)->Get(Executive::UPDATE_NUMBER_OF_GHOST_LEVELS()) > 0;
}

vtkStandardNewMacro(CollectivePipeline);

void useCollectivePipeline(
  vtkAlgorithm* filter, std::function<vtkMultiProcessController*()> controller)
{
  struct Algorithm : public vtkAlgorithm // the prototype is protected
  {
    static bool hasOwnExecutive() { return DefaultExecutivePrototype != nullptr; }
  };
  if (!Algorithm::hasOwnExecutive())
  {
    const vtkNew<CollectivePipeline> executive;
    executive->Controller = std::move(controller);
    filter->SetExecutive(executive);
  }
}

int CollectivePipeline::ForwardUpstream(vtkInformation* request)
{
  const int own = this->Superclass::ForwardUpstream(request);
  vtkMultiProcessController* ranks =
    this->GetAlgorithm() && this->Controller ? this->Controller() : nullptr;
  // A rank that fails before the data request does not reach this point in the data request; the
  // others do.
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
      "Rank " << failed << ": the pipeline upstream of the filter failed, see its message; no rank "
              << "executes the filter.");
  }
  return failed == none;
}

} // namespace tipp
