// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPOutOfCoreDelaunay2D.h"

#include "Constraints/OnDisk/ConstrainedPoints.h"
#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Output/RunStatistics.h"
#include "Pipeline/FilterPipeline.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkTIPPOutOfCoreDelaunay2D);
vtkCxxSetObjectMacro(vtkTIPPOutOfCoreDelaunay2D, Controller, vtkMultiProcessController);

namespace
{

std::string textOf(const char* text)
{
  return text ? text : "";
}

} // namespace

vtkTIPPOutOfCoreDelaunay2D::vtkTIPPOutOfCoreDelaunay2D()
{
  this->SetNumberOfInputPorts(0);
  this->vtkTIPPOutOfCoreDelaunay2D::SetController(vtkMultiProcessController::GetGlobalController());
}

vtkTIPPOutOfCoreDelaunay2D::~vtkTIPPOutOfCoreDelaunay2D()
{
  this->vtkTIPPOutOfCoreDelaunay2D::SetXColumn(nullptr);
  this->vtkTIPPOutOfCoreDelaunay2D::SetYColumn(nullptr);
  this->vtkTIPPOutOfCoreDelaunay2D::SetFileName(nullptr);
  this->vtkTIPPOutOfCoreDelaunay2D::SetConstraintsFileName(nullptr);
  this->vtkTIPPOutOfCoreDelaunay2D::SetBoundaryFileName(nullptr);
  this->vtkTIPPOutOfCoreDelaunay2D::SetScratchFolder(nullptr);
  this->vtkTIPPOutOfCoreDelaunay2D::SetController(nullptr);
}

void vtkTIPPOutOfCoreDelaunay2D::AddInputFileName(const char* name)
{
  tipp::addName(this, name, this->InputFileNames);
}

void vtkTIPPOutOfCoreDelaunay2D::SetInputFileName(const char* name)
{
  if (name && this->InputFileNames == std::vector<std::string>{ name })
  {
    return;
  }
  this->ClearInputFileNames();
  this->AddInputFileName(name);
}

void vtkTIPPOutOfCoreDelaunay2D::ClearInputFileNames()
{
  tipp::clearItems(this, this->InputFileNames);
}

int vtkTIPPOutOfCoreDelaunay2D::GetNumberOfInputFileNames() const
{
  return int(this->InputFileNames.size());
}

const char* vtkTIPPOutOfCoreDelaunay2D::GetInputFileName(int index) const
{
  return tipp::nameAt(this->InputFileNames, index);
}

void vtkTIPPOutOfCoreDelaunay2D::AddHole(double x, double y)
{
  this->Holes.emplace_back(x, y);
  this->Modified();
}

void vtkTIPPOutOfCoreDelaunay2D::ClearHoles()
{
  tipp::clearItems(this, this->Holes);
}

/// Announces that the filter handles piece requests. Otherwise a pipeline that requests one piece
/// per rank would execute the first rank only, which would wait for the others forever.
int vtkTIPPOutOfCoreDelaunay2D::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* const info = outputVector->GetInformationObject(0);
  info->Remove(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST());
  if (tipp::hasSeveralRanks(this->Controller))
  {
    info->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
  return 1;
}

int vtkTIPPOutOfCoreDelaunay2D::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkTable* const output = vtkTable::GetData(outputVector, 0);
  const int isDone =
    tipp::runReported(this, this->Controller, "", { output }, [&] { this->Execute(output); });
  if (!isDone)
  {
    this->SetErrorCode(vtkErrorCode::UserError); // not every rank reports the error
  }
  return isDone;
}

void vtkTIPPOutOfCoreDelaunay2D::Execute(vtkTable* output)
{
  const std::string path = textOf(this->FileName);
  tipp::Communicator ranks(this->Controller);
  tipp::Monitor monitor(this);
  tipp::OutOfCoreOptions options = this->Options();
  options.Progress = [&monitor](double fraction) { return monitor(fraction); };
  options.Warn = [this](const std::string& sentence) { vtkWarningMacro(<< sentence); };
  const auto crossings =
    this->SplitCrossings ? tipp::CrossingRule::Split : tipp::CrossingRule::Refuse;
  const tipp::ConstraintFiles constraints{ textOf(this->ConstraintsFileName),
    textOf(this->BoundaryFileName), this->Holes, crossings };
  const auto open = [&]
  {
    if (path.empty())
    {
      throw tipp::IOError("FileName is not set; name the folder to write.");
    }
    tipp::requireApart({ path, tipp::scratchIn(options.Scratch) }, this->InputFileNames);
    return tipp::joinConstraints(
      tipp::openPointStream(this->InputFileNames, { textOf(this->XColumn), textOf(this->YColumn) }),
      constraints, options);
  };
  const tipp::OutOfCoreStatistics statistics =
    tipp::triangulateOutOfCoreOnRanks(ranks, open, path, options);
  if (!statistics.Aborted && ranks.rank() == 0)
  {
    tipp::warn(this, tipp::warningsOf(statistics));
    tipp::fillStatisticsTable(tipp::statisticsOf(statistics, options.CountOnly), output);
  }
}

tipp::OutOfCoreOptions vtkTIPPOutOfCoreDelaunay2D::Options() const
{
  tipp::OutOfCoreOptions options;
  options.MemoryLimit = std::uint64_t(this->MemoryLimit);
  options.Threads = this->NumberOfThreads;
  options.Columns = this->NumberOfPartitions[0];
  options.Rows = this->NumberOfPartitions[1];
  options.MaximumEdge = this->MaximumEdgeLength;
  options.MapDuplicates = this->GenerateRepresentativeIds != 0;
  options.Neighbors = this->GenerateNeighborIds != 0;
  options.MarkConstraints = this->GenerateConstraintEdges != 0;
  options.CountOnly = this->CountOnly != 0;
  options.Resume = this->Resume != 0;
  options.Scratch = textOf(this->ScratchFolder);
  return options;
}

void vtkTIPPOutOfCoreDelaunay2D::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const char* value)
  { os << indent << name << ": " << (value ? value : "(none)") << "\n"; };
  const auto onOff = [](vtkTypeBool flag) { return flag ? "On\n" : "Off\n"; };
  for (const std::string& name : this->InputFileNames)
  {
    print("InputFileName", name.c_str());
  }
  print("XColumn", this->XColumn);
  print("YColumn", this->YColumn);
  print("FileName", this->FileName);
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "NumberOfPartitions: " << this->NumberOfPartitions[0] << " x "
     << this->NumberOfPartitions[1] << "\n";
  os << indent << "MaximumEdgeLength: " << this->MaximumEdgeLength << "\n";
  os << indent << "GenerateRepresentativeIds: " << onOff(this->GenerateRepresentativeIds);
  os << indent << "GenerateNeighborIds: " << onOff(this->GenerateNeighborIds);
  print("ConstraintsFileName", this->ConstraintsFileName);
  print("BoundaryFileName", this->BoundaryFileName);
  os << indent << "Holes: " << this->Holes.size() << "\n";
  os << indent << "SplitCrossings: " << onOff(this->SplitCrossings);
  os << indent << "GenerateConstraintEdges: " << onOff(this->GenerateConstraintEdges);
  os << indent << "CountOnly: " << onOff(this->CountOnly);
  os << indent << "Resume: " << onOff(this->Resume);
  print("ScratchFolder", this->ScratchFolder);
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
