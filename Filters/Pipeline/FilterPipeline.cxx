// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/FilterPipeline.h"

#include "Parallel/ParallelFor.h"
#include "Ranks/Communicator.h"
#include "Statistics/RunStatistics.h"

#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTypeUInt64Array.h"

#include <cmath>
#include <exception>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <variant>

namespace tipp
{

using Executive = vtkStreamingDemandDrivenPipeline;

namespace
{

void setUpdatePiece(vtkInformation* inInfo, int piece, int pieces)
{
  inInfo->Set(Executive::UPDATE_PIECE_NUMBER(), piece);
  inInfo->Set(Executive::UPDATE_NUMBER_OF_PIECES(), pieces);
  inInfo->Set(Executive::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

template <typename Array, typename Values>
vtkSmartPointer<Array> makeArray(const std::string& name, const Values& values)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  for (const auto& value : values)
  {
    array->InsertNextValue(value);
  }
  return array;
}

vtkSmartPointer<vtkAbstractArray> arrayOf(const Figures& figures)
{
  return std::visit(
    [&](const auto& values) -> vtkSmartPointer<vtkAbstractArray>
    {
      using Value = typename std::decay_t<decltype(values)>::value_type;
      using NumberArray = std::conditional_t<std::is_same_v<Value, double>, vtkDoubleArray,
        std::conditional_t<std::is_same_v<Value, std::uint64_t>, vtkTypeUInt64Array,
          vtkIdTypeArray>>;
      using Array =
        std::conditional_t<std::is_same_v<Value, std::string>, vtkStringArray, NumberArray>;
      return makeArray<Array>(figures.Array, values);
    },
    figures.Values);
}

} // namespace

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

int runReported(vtkAlgorithm* filter, vtkMultiProcessController* controller,
  const std::string& prefix, vtkInformationVector* outputs, const std::function<void()>& work)
{
  bool isStopped = false;
  try
  {
    work();
    return 1;
  }
  catch (const std::exception& error)
  {
    const auto* const failure = dynamic_cast<const RankFailure*>(&error);
    isStopped = failure && failure->Aborted;
    if (failure && hasSeveralRanks(controller))
    {
      if (!isStopped && controller->GetLocalProcessId() == 0)
      {
        vtkErrorWithObjectMacro(filter, "Rank " << failure->Rank << ": " << error.what());
      }
    }
    else if (!isStopped)
    {
      vtkErrorWithObjectMacro(filter, << prefix << error.what());
    }
  }
  for (int port = 0; outputs && port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject::GetData(outputs, port)->Initialize();
  }
  return isStopped ? 1 : 0;
}

int triangulateReported(vtkAlgorithm* filter, vtkMultiProcessController* controller, int threads,
  const std::string& doing, vtkPointSet* input, vtkInformationVector* outputs,
  const std::function<void()>& alone, const std::function<void()>& onRanks)
{
  const std::string prefix = doing + " " + std::to_string(input->GetNumberOfPoints()) + " points: ";
  return runReported(filter, controller, prefix, outputs,
    [&]
    {
      const ThreadLimit limit(threads);
      try
      {
        hasSeveralRanks(controller) ? onRanks() : alone();
      }
      catch (const std::bad_alloc&)
      {
        throw std::runtime_error(
          "not enough memory; use fewer points or a machine with more memory.");
      }
    });
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

void askForUpdatePiece(vtkInformation* inInfo, int piece, int pieces)
{
  inInfo->Remove(Executive::UPDATE_EXTENT());
  if (inInfo->Has(Executive::WHOLE_EXTENT())) // structured data
  {
    inInfo->Set(Executive::UPDATE_EXTENT(), inInfo->Get(Executive::WHOLE_EXTENT()), 6);
  }
  setUpdatePiece(inInfo, piece, pieces);
}

int acceptInput(vtkInformation* port, const char* type, bool isOptional)
{
  port->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  if (isOptional)
  {
    port->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int askForWholeInputs(vtkInformationVector** inputs, int ports)
{
  for (int port = 0; port < ports; ++port)
  {
    if (vtkInformation* const input = inputs[port]->GetInformationObject(0))
    {
      askForUpdatePiece(input, 0, 1);
    }
  }
  return 1;
}

bool askForUpdatePieces(
  vtkMultiProcessController* controller, vtkInformationVector** inputs, int ports)
{
  const bool several = hasSeveralRanks(controller);
  for (int port = 0; several && port < ports; ++port)
  {
    if (vtkInformation* const input = inputs[port]->GetInformationObject(0))
    {
      setUpdatePiece(input, controller->GetLocalProcessId(), controller->GetNumberOfProcesses());
    }
  }
  return several;
}

bool wantsGhosts(vtkInformationVector* outputs)
{
  return outputs->GetInformationObject(0)->Get(Executive::UPDATE_NUMBER_OF_GHOST_LEVELS()) > 0;
}

void fillStatisticsTable(const RunStatistics& statistics, vtkTable* table)
{
  vtkFieldData* const totals = table->GetFieldData();
  const auto add = [&](const Figures& figures, bool isColumn)
  {
    if (figures.Array.empty())
    {
      return;
    }
    const vtkSmartPointer<vtkAbstractArray> array = arrayOf(figures);
    if (isColumn)
    {
      table->AddColumn(array);
    }
    else
    {
      totals->AddArray(array);
    }
  };
  for (const Figures& total : statistics.Totals)
  {
    add(total, false);
  }
  for (const FigureList& list : statistics.Lists)
  {
    for (const Figures& column : list.Columns)
    {
      add(column, list.IsTable);
    }
  }
}

void addDuplicatesAndRejected(const std::vector<Duplicate>& duplicates,
  const std::vector<PointId>& rejected, vtkDataObject* output)
{
  std::vector<PointId> points;
  std::vector<PointId> representatives;
  for (const Duplicate& duplicate : duplicates)
  {
    points.push_back(duplicate.Point);
    representatives.push_back(duplicate.Representative);
  }
  vtkFieldData* const data = output->GetFieldData();
  data->AddArray(makeArray<vtkIdTypeArray>("DuplicatePointIds", points));
  data->AddArray(makeArray<vtkIdTypeArray>("DuplicateRepresentativeIds", representatives));
  data->AddArray(makeArray<vtkIdTypeArray>("RejectedPointIds", rejected));
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
