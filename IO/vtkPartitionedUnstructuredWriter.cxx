// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPartitionedUnstructuredWriter.h"

#include "Files/IOError.h"
#include "Partitioning/PartitionMesh.h"
#include "Ranks/Communicator.h"
#include "Vtk/Compatibility.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <exception>
#include <new>

vtkStandardNewMacro(vtkPartitionedUnstructuredWriter);

namespace
{

/// Each rank requests its own piece; vtkWriter would request the whole data set on all.
void askForPiece(vtkInformation* input, vtkMultiProcessController* ranks)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  input->Set(Pipeline::UPDATE_PIECE_NUMBER(), ranks->GetLocalProcessId());
  input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), ranks->GetNumberOfProcesses());
  input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

} // namespace

vtkPartitionedUnstructuredWriter::vtkPartitionedUnstructuredWriter()
{
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

int vtkPartitionedUnstructuredWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

vtkTypeBool vtkPartitionedUnstructuredWriter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMultiProcessController* const ranks = this->Controller;
  const bool several = ranks && ranks->GetNumberOfProcesses() > 1;
  vtkInformation* const input = inputVector[0]->GetInformationObject(0);
  if (several && input && request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    askForPiece(input, ranks);
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

int vtkPartitionedUnstructuredWriter::Write()
{
  this->Written = false;
  tipp::beginExecution(this);
  if (!this->InputFileName.empty())
  {
    this->WritePartitioned();
  }
  else if (this->Controller && this->Controller->GetNumberOfProcesses() > 1)
  {
    this->WriteOnRanks();
  }
  else
  {
    this->Superclass::Write();
  }
  return this->Written ? 1 : 0;
}

/// Collective: a rank without an input must take part, or the others would wait for it.
void vtkPartitionedUnstructuredWriter::WriteOnRanks()
{
  try
  {
    tipp::Communicator(this->Controller).attempt([this] { this->RequireInput(); });
    this->Superclass::Write();
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

void vtkPartitionedUnstructuredWriter::RequireInput()
{
  if (this->GetNumberOfInputConnections(0) < 1)
  {
    throw tipp::IOError(
      "A rank has no input; set one on every rank, an empty one too, or InputFileName.");
  }
  vtkAlgorithmOutput* const input = this->GetInputConnection(0, 0);
  vtkExecutive* const executive = input->GetProducer()->GetExecutive();
  executive->UpdateInformation();
  askForPiece(executive->GetOutputInformation(input->GetIndex()), this->Controller);
  if (!executive->Update(input->GetIndex()))
  {
    throw tipp::IOError("A rank's input could not be made; see the errors before this one.");
  }
}

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0)
bool vtkPartitionedUnstructuredWriter::WriteDataAndReturn()
{
  this->WritePartitioned();
  return this->Written;
}
#else
void vtkPartitionedUnstructuredWriter::WriteData()
{
  this->WritePartitioned();
}
#endif

void vtkPartitionedUnstructuredWriter::WritePartitioned()
{
  try
  {
    this->Partition();
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("There is not enough memory to partition the mesh.");
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

void vtkPartitionedUnstructuredWriter::Partition()
{
  const std::string output = this->FileName; // observers of progress may change the property
  if (output.empty())
  {
    throw tipp::IOError("FileName is not set; name the folder to write.");
  }
  tipp::PartitionOptions options;
  options.Tiling = tipp::TilingChoice::require(this->Tiling);
  options.DuplicateBorrowers = this->DuplicateBorrowers;
  options.MemoryLimit = std::uint64_t(this->MemoryLimit);
  options.Loading.Kind = tipp::loaderFromName(this->Loader.empty() ? "auto" : this->Loader);
  options.Device = tipp::parseDeviceChoice(this->Device.empty() ? "openmp" : this->Device);
  options.Threads = this->NumberOfThreads;
  options.Progress = [this](double fraction)
  {
    this->UpdateProgress(fraction);
    return !tipp::abortRequested(this);
  };
  tipp::PartitionStatistics statistics;
  if (!this->InputFileName.empty())
  {
    statistics = tipp::partitionInput(this->InputFileName, output, options, this->Controller);
  }
  else
  {
    const auto data = tipp::gatherDataSets(this->GetInput(), this->Controller);
    statistics = tipp::partitionDataSet(data, "the input", output, options, this->Controller);
  }
  this->Written = !statistics.Aborted;
}

void vtkPartitionedUnstructuredWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(FileName);
  vtkTIPPPrintMacro(InputFileName);
  vtkTIPPPrintMacro(Tiling);
  vtkTIPPPrintMacro(Loader);
  vtkTIPPPrintMacro(Device);
  vtkTIPPPrintMacro(DuplicateBorrowers);
  vtkTIPPPrintMacro(MemoryLimit);
  vtkTIPPPrintMacro(NumberOfThreads);
  os << indent << "Controller: " << this->Controller << "\n";
}
