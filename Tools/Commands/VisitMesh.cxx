// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/VisitMesh.h"

#include "Files/IOError.h"
#include "Partitioned/PartitionedMesh.h"
#include "Vtk/DataSets.h"

#include "vtkExecutive.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPartitionedUnstructuredReader.h"
#include "vtkPointSet.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// The approximate memory, in bytes, of a cell: the cell, its share of the points, and its entry in
/// a search tree.
constexpr std::uint64_t bytesOfCell = 160;

int partsOf(const std::string& path, std::uint64_t memory)
{
  std::int64_t cells = 0;
  for (const PieceSummary& piece : openPartitionedMesh(path).Pieces)
  {
    cells += piece.Cells;
  }
  return int(std::min<std::uint64_t>(bytesOfCell * std::uint64_t(cells) / memory + 1, 1 << 20));
}

} // namespace

bool visitMesh(const std::string& path, std::uint64_t memory, int threads, const Report& report,
  const std::function<bool(vtkPointSet* part, const Report& report)>& visit)
{
  if (!isPartitionedMesh(path))
  {
    return visit(readPointSet(path), report);
  }
  const int parts = partsOf(path, memory);
  const vtkNew<ErrorKeeper> errors;
  const vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->SetController(nullptr);
  reader->SetFileName(path.c_str());
  reader->SetNumberOfThreads(threads);
  for (int i = 0; i < parts; ++i)
  {
    reader->UpdatePiece(i, parts, 0);
    if (errors->HasError)
    {
      throw IOError(errors->message());
    }
    auto* const part = vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
    if (part && !visit(part, partOf(report, double(i) / parts, (i + 1.0) / parts)))
    {
      return false;
    }
  }
  return true;
}

} // namespace tipp
