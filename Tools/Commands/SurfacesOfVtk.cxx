// SPDX-License-Identifier: BSD-3-Clause
// Surfaces in a build with VTK: all files that it reads.
#include "Commands/MeshParts.h"
#include "Commands/VisitSurface.h"
#include "Files/IOError.h"
#include "Partitioned/PartitionedMesh.h"
#include "Sampling/RemapMesh.h"
#include "Sampling/SurfaceOfMesh.h"
#include "Sampling/WriteSurface.h"
#include "Vtk/DataSets.h"

#include "vtkExecutive.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPartitionedUnstructuredReader.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

namespace tipp
{

bool visitSurface(const std::string& path, const SurfaceReading& reading, const Report& report,
  const std::function<bool(const SurfacePart& part, const Report& report)>& visit)
{
  const auto visitMesh = [&](vtkPointSet* mesh, const Report& ofPart)
  {
    return visit(surfaceOf(mesh, reading.Name, reading.Axes, threadCount(reading.Threads)), ofPart);
  };
  if (!isPartitionedMesh(path))
  {
    return visitMesh(readPointSet(path), report);
  }
  const int parts = countParts(openPartitionedMesh(path), reading.Memory);
  const vtkNew<ErrorKeeper> errors;
  const vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->SetController(nullptr);
  reader->SetFileName(path.c_str());
  reader->SetNumberOfThreads(reading.Threads);
  for (int i = 0; i < parts; ++i)
  {
    reader->UpdatePiece(i, parts, 0);
    if (errors->HasError)
    {
      throw IOError(errors->message());
    }
    // A copy, because the visit may keep the part, and the reader reuses its output.
    auto* const output = vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
    if (!output)
    {
      continue;
    }
    const auto part = vtkSmartPointer<vtkPointSet>::Take(output->NewInstance());
    part->ShallowCopy(output);
    if (!visitMesh(part, partOf(report, double(i) / parts, (i + 1.0) / parts)))
    {
      return false;
    }
  }
  return true;
}

TargetSurface readTarget(const std::string& path, const SurfaceReading& reading,
  const std::function<void(const std::string& extension)>& requireExtension)
{
  const vtkSmartPointer<vtkPointSet> mesh = readPointSet(path);
  requireExtension(vtkPolyData::SafeDownCast(mesh) ? ".vtp" : ".vtu");
  TargetSurface target;
  target.Surface = surfaceOf(mesh, reading.Name, reading.Axes, threadCount(reading.Threads));
  target.Write = [mesh, surface = target.Surface](const std::string& output,
                   const PathState& before, const std::vector<SurfaceMeans>& means)
  {
    if (!surface.Parents)
    {
      writeSurface(output, before, surface.Mesh, means);
      return;
    }
    writeXmlFile(output, before, withCellMeans(mesh, means));
  };
  return target;
}

} // namespace tipp
