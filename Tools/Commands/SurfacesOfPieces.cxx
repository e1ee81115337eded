// SPDX-License-Identifier: BSD-3-Clause
// Surfaces in a build without VTK: partitioned meshes, and VTK's files as TIPP writes them.
#include "Commands/MeshParts.h"
#include "Commands/VisitSurface.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "NoVtk.h"
#include "Partitioning/MeshTiling.h"
#include "Reading/PieceSource.h"
#include "Reading/ReadFlatPiece.h"
#include "Sampling/SurfaceOfPiece.h"
#include "Sampling/WriteSurface.h"

#include <filesystem>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

/// Opens a file of VTK. Throws IOError if it is of another kind, or not as TIPP writes it.
FlatMesh openSurface(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path))
  {
    throw IOError(path, "is not a file that can be read; check the name.");
  }
  if (!isOpenedBy(path, Opener::Vtk))
  {
    refuseKind(path, "is of a kind that VTK's readers here do not know.");
  }
  if (!isFlatMesh(path))
  {
    refuseVtkMesh(path);
  }
  return openFlatMesh(path);
}

/// Reads some pieces of a partitioned mesh as one.
Piece readPart(PieceSource& source, const std::vector<std::size_t>& numbers)
{
  PieceOptions options;
  options.Borrowed = false;
  std::vector<Piece> pieces = source.read(numbers, options);
  return pieces.size() == 1 ? std::move(pieces[0]) : mergePieces(pieces);
}

} // namespace

bool visitSurface(const std::string& path, const SurfaceReading& reading, const Report& report,
  const std::function<bool(const SurfacePart& part, const Report& report)>& visit)
{
  if (!isPartitionedMesh(path))
  {
    return visit(
      surfaceOf(readFlatPiece(openSurface(path), reading.Threads), reading.Name, reading.Axes),
      report);
  }
  const std::unique_ptr<PieceSource> source = openPieceSource(path);
  Communicator alone(nullptr);
  source->prepare(alone);
  const int parts = countParts(source->mesh(), reading.Memory);
  const std::vector<std::size_t> starts = assignPieces(source->weights(), parts);
  for (std::size_t i = 0; i + 1 < starts.size(); ++i)
  {
    std::vector<std::size_t> numbers(starts[i + 1] - starts[i]);
    std::iota(numbers.begin(), numbers.end(), starts[i]);
    if (!numbers.empty() &&
      !visit(surfaceOf(readPart(*source, numbers), reading.Name, reading.Axes),
        partOf(report, double(i) / parts, double(i + 1) / parts)))
    {
      return false;
    }
  }
  return true;
}

TargetSurface readTarget(const std::string& path, const SurfaceReading& reading,
  const std::function<void(const std::string& extension)>& requireExtension)
{
  const FlatMesh mesh = openSurface(path);
  requireNoOtherCells(mesh);
  requireExtension(extensionOf(path) == ".vtp" ? ".vtp" : ".vtu");
  TargetSurface target;
  target.Surface = surfaceOf(readFlatPiece(mesh, reading.Threads), reading.Name, reading.Axes);
  target.Write = [surface = target.Surface](const std::string& output, const PathState& before,
                   const std::vector<SurfaceMeans>& means)
  { writeSurface(output, before, surface.Mesh, means); };
  return target;
}

} // namespace tipp
