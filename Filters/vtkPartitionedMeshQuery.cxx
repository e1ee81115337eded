// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPartitionedMeshQuery.h"

#include "Parallel/ParallelFor.h"
#include "Pipeline/FilterPipeline.h"
#include "Query/QueryData.h"
#include "Reading/PieceSource.h"

#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <exception>

vtkStandardNewMacro(vtkPartitionedMeshQuery);

vtkPartitionedMeshQuery::vtkPartitionedMeshQuery()
{
  this->SetNumberOfInputPorts(2);
  this->Controller = vtkMultiProcessController::GetGlobalController();
  tipp::useCollectivePipeline(this, [this] { return this->Controller; });
}

vtkDataObject* vtkPartitionedMeshQuery::GetSource()
{
  return this->GetNumberOfInputConnections(1) > 0 ? this->GetInputDataObject(1, 0) : nullptr;
}

int vtkPartitionedMeshQuery::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkDataSet" : "vtkPointSet");
  if (port == 1)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkPartitionedMeshQuery::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!this->Superclass::RequestUpdateExtent(request, inputs, outputs))
  {
    return 0;
  }
  if (inputs[1]->GetNumberOfInformationObjects() > 0)
  {
    const auto [rank, ranks] = this->GetRank();
    tipp::askForPiece(inputs[1]->GetInformationObject(0), rank, ranks);
  }
  return 1;
}

/// Returns this process's rank and the number of ranks.
std::pair<int, int> vtkPartitionedMeshQuery::GetRank() const
{
  return this->Controller ? std::make_pair(this->Controller->GetLocalProcessId(),
                              this->Controller->GetNumberOfProcesses())
                          : std::make_pair(0, 1);
}

/// Returns the mesh, opened again if it or the properties have changed.
std::shared_ptr<const tipp::ResidentMesh> vtkPartitionedMeshQuery::Open()
{
  const std::lock_guard<std::mutex> lock(this->Opening);
  const bool isStored = !this->FileName.empty();
  vtkDataObject* const source = isStored ? nullptr : this->GetSource();
  std::string key = this->FileName;
  for (const vtkTypeInt64 number : { vtkTypeInt64(this->MemoryLimit), vtkTypeInt64(this->Step),
         vtkTypeInt64(this->NumberOfThreads), source ? vtkTypeInt64(source->GetMTime()) : 0 })
  {
    key += "|" + std::to_string(number);
  }
  const bool isOther =
    this->Mesh && tipp::wasReplaced(this->Mesh->mesh()) && tipp::isPartitionedMesh(this->FileName);
  if (!this->Mesh || this->Opened != key || isOther)
  {
    this->Mesh.reset();
    tipp::ResidentOptions options;
    options.MemoryLimit = std::uint64_t(this->MemoryLimit);
    options.Threads = this->NumberOfThreads;
    options.Step = this->Step;
    this->Mesh = isStored ? std::make_shared<const tipp::ResidentMesh>(this->FileName, options)
                          : std::make_shared<const tipp::ResidentMesh>(
                              tipp::partOf(source, this->NumberOfThreads), options);
    this->Opened = key;
  }
  return this->Mesh;
}

/// The names of the arrays to evaluate. Collective if there are several ranks.
std::vector<std::string> vtkPartitionedMeshQuery::ArraysOf(
  tipp::Communicator* ranks, const tipp::ResidentMesh& mesh) const
{
  const bool hasCells = mesh.mesh().Cells > 0;
  std::vector<std::string> arrays = this->Arrays.empty() ? mesh.names() : this->Arrays;
  if (ranks)
  {
    // A rank without cells does not know the arrays' names.
    for (const std::vector<std::string>& names :
      ranks->allGather(hasCells ? arrays : std::vector<std::string>()))
    {
      arrays = hasCells || names.empty() ? arrays : names;
    }
  }
  return arrays;
}

/// Calls ask(ranks, mesh) with this process's mesh. `ranks` is null if there is only one rank.
void vtkPartitionedMeshQuery::AskMesh(const Question& ask)
{
  if (this->GetRank().second == 1)
  {
    ask(nullptr, *this->Open());
    return;
  }
  tipp::Communicator ranks(this->Controller);
  ranks.together(
    [&]
    {
      const auto mesh = this->Open();
      tipp::requireSameMesh(ranks, mesh->mesh());
      ask(&ranks, *mesh);
    });
}

/// Evaluates the mesh at points. Collective if there are several ranks.
tipp::MeshAnswer vtkPartitionedMeshQuery::Ask(
  const std::vector<tipp::Point3>& points, bool weights, bool arrays)
{
  tipp::MeshAnswer answer;
  this->AskMesh(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      tipp::AnswerOptions options;
      options.Weights = weights;
      options.Arrays = arrays ? this->ArraysOf(ranks, mesh) : std::vector<std::string>();
      answer = tipp::answerOf(mesh, points.data(), std::int64_t(points.size()), options, ranks);
    });
  return answer;
}

/// Runs `work` and reports its exceptions as errors. Returns 0 after an error, else 1.
int vtkPartitionedMeshQuery::Try(const std::function<void()>& work)
{
  try
  {
    work();
    return 1;
  }
  catch (const tipp::WorkAborted&)
  {
    return 0;
  }
  catch (const std::exception& error)
  {
    const auto* const failure = dynamic_cast<const tipp::RankFailure*>(&error);
    if (!failure || !failure->Aborted)
    {
      vtkErrorMacro("Query: " << error.what());
    }
    return 0;
  }
}

/// The same for calls outside of the pipeline: updates the source first.
int vtkPartitionedMeshQuery::Direct(const std::function<void()>& work)
{
  return this->Try(
    [&]
    {
      if (this->GetNumberOfInputConnections(1) > 0)
      {
        const std::lock_guard<std::mutex> lock(this->Opening);
        const auto [rank, ranks] = this->GetRank();
        this->GetInputAlgorithm(1, 0)->UpdatePiece(rank, ranks, 0);
      }
      work();
    });
}

int vtkPartitionedMeshQuery::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
  vtkDataSet* const output = vtkDataSet::GetData(outputs);
  output->CopyStructure(input);
  if (this->PassPointArrays)
  {
    output->GetPointData()->PassData(input->GetPointData());
  }
  if (this->PassCellArrays)
  {
    output->GetCellData()->PassData(input->GetCellData());
  }
  if (this->PassFieldArrays)
  {
    output->GetFieldData()->PassData(input->GetFieldData());
  }
  const int isDone = this->Try(
    [&]
    {
      tipp::Monitor monitor(this);
      const tipp::PollScope scope(
        [&]
        {
          if (!monitor(0.5) && this->Controller)
          {
            throw tipp::RankFailure(this->GetRank().first, true, "The run was stopped.");
          }
          return monitor(0.5);
        });
      tipp::MeshAnswer answer =
        this->Ask(tipp::collected(input->GetNumberOfPoints(),
                    [input](vtkIdType i, double* p) { input->GetPoint(i, p); }),
          false, true);
      vtkPointData* const values = output->GetPointData();
      tipp::moveArrays(answer, values, this->NullValue);
      values->AddArray(tipp::arrayOf<vtkIdTypeArray>("CellId", answer.Cells));
      vtkNew<vtkCharArray> mask;
      mask->SetName(this->ValidPointMaskArrayName.c_str());
      mask->SetNumberOfValues(vtkIdType(answer.Cells.size()));
      std::transform(answer.Cells.begin(), answer.Cells.end(), mask->GetPointer(0),
        [](std::int64_t cell) { return char(cell >= 0); });
      values->AddArray(mask);
    });
  if (!isDone)
  {
    output->Initialize();
  }
  return isDone || this->GetAbortExecute() ? 1 : 0;
}

int vtkPartitionedMeshQuery::Locate(
  vtkDataArray* points, vtkIdTypeArray* cells, vtkDoubleArray* weights)
{
  return this->Direct(
    [&]
    {
      const tipp::MeshAnswer answer = this->Ask(tipp::pointsOf(points), weights != nullptr, false);
      tipp::copyTo(cells, answer.Cells);
      const std::size_t count = answer.Cells.size();
      tipp::copyTo(
        weights, answer.Weights, answer.Weights.empty() ? 3 : int(answer.Weights.size() / count));
    });
}

int vtkPartitionedMeshQuery::Interpolate(
  vtkDataArray* points, vtkDataSetAttributes* values, vtkIdTypeArray* cells)
{
  return this->Direct(
    [&]
    {
      tipp::MeshAnswer answer = this->Ask(tipp::pointsOf(points), false, true);
      tipp::moveArrays(answer, values);
      tipp::copyTo(cells, answer.Cells);
    });
}

void vtkPartitionedMeshQuery::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(FileName);
  vtkTIPPPrintMacro(MemoryLimit);
  vtkTIPPPrintMacro(Step);
  vtkTIPPPrintMacro(NullValue);
  vtkTIPPPrintMacro(PassPointArrays);
  vtkTIPPPrintMacro(PassCellArrays);
  vtkTIPPPrintMacro(PassFieldArrays);
  vtkTIPPPrintMacro(ValidPointMaskArrayName);
  vtkTIPPPrintMacro(NumberOfThreads);
  os << indent << "Controller: " << this->Controller << "\n";
  vtkTIPPPrintMacro(Arrays);
}
