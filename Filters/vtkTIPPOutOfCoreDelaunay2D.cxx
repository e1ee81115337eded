// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPOutOfCoreDelaunay2D.h"

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/TableConstraints.h"
#include "Files/IOError.h"
#include "Files/RequireApart.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Pipeline/FilterPipeline.h"
#include "Statistics/RunStatistics.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkTIPPOutOfCoreDelaunay2D);

vtkTIPPOutOfCoreDelaunay2D::vtkTIPPOutOfCoreDelaunay2D()
{
  this->SetNumberOfInputPorts(0);
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

void vtkTIPPOutOfCoreDelaunay2D::AddHole(double x, double y)
{
  this->Holes.emplace_back(x, y);
  this->Modified();
}

void vtkTIPPOutOfCoreDelaunay2D::ClearHoles()
{
  if (!this->Holes.empty())
  {
    this->Holes.clear();
    this->Modified();
  }
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
  const int isDone = tipp::runReported(this, this->Controller, "", outputVector,
    [&] { this->Execute(vtkTable::GetData(outputVector, 0)); });
  if (!isDone)
  {
    this->SetErrorCode(vtkErrorCode::UserError); // not every rank reports the error
  }
  return isDone;
}

void vtkTIPPOutOfCoreDelaunay2D::Execute(vtkTable* output)
{
  const std::string path = this->FileName; // observers of progress may change the property
  tipp::Communicator ranks(this->Controller);
  tipp::Monitor monitor(this);
  tipp::OutOfCoreOptions options = this->Options();
  options.Progress = [&monitor](double fraction) { return monitor(fraction); };
  options.Warn = [this](const std::string& sentence) { vtkWarningMacro(<< sentence); };
  const auto crossings =
    this->SplitCrossings ? tipp::CrossingRule::Split : tipp::CrossingRule::Refuse;
  const tipp::ConstraintFiles constraints{ this->ConstraintsFileName, this->BoundaryFileName,
    this->Holes, crossings };
  const auto open = [&]
  {
    if (path.empty())
    {
      throw tipp::IOError("FileName is not set; name the folder to write.");
    }
    tipp::requireApart({ path, tipp::scratchIn(options.Scratch) }, this->InputFileNames);
    return tipp::joinConstraints(
      tipp::openPointStream(this->InputFileNames, { this->XColumn, this->YColumn }), constraints,
      options.MarkConstraints, options.Threads);
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
  options.Scratch = this->ScratchFolder;
  return options;
}

void vtkTIPPOutOfCoreDelaunay2D::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto onOff = [](vtkTypeBool flag) { return flag ? "On\n" : "Off\n"; };
  vtkTIPPPrintMacro(InputFileNames);
  vtkTIPPPrintMacro(XColumn);
  vtkTIPPPrintMacro(YColumn);
  vtkTIPPPrintMacro(FileName);
  vtkTIPPPrintMacro(MemoryLimit);
  vtkTIPPPrintMacro(NumberOfPartitions);
  vtkTIPPPrintMacro(MaximumEdgeLength);
  os << indent << "GenerateRepresentativeIds: " << onOff(this->GenerateRepresentativeIds);
  os << indent << "GenerateNeighborIds: " << onOff(this->GenerateNeighborIds);
  vtkTIPPPrintMacro(ConstraintsFileName);
  vtkTIPPPrintMacro(BoundaryFileName);
  os << indent << "Holes: " << this->Holes.size() << "\n";
  os << indent << "SplitCrossings: " << onOff(this->SplitCrossings);
  os << indent << "GenerateConstraintEdges: " << onOff(this->GenerateConstraintEdges);
  os << indent << "CountOnly: " << onOff(this->CountOnly);
  os << indent << "Resume: " << onOff(this->Resume);
  vtkTIPPPrintMacro(ScratchFolder);
  vtkTIPPPrintMacro(NumberOfThreads);
  os << indent << "Controller: " << this->Controller << "\n";
}
