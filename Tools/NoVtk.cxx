// SPDX-License-Identifier: BSD-3-Clause
// Replaces everything that needs VTK, in a build without it: ranks and VTK's files.
#include "NoVtk.h"
#include "Commands/VtkFiles.h"
#include "Console/Process.h"
#include "Files/InputFile.h"
#include "Reading/ReadFlatPiece.h"
#include "Sampling/SampleNames.h"
#include "Sampling/SurfaceOfPiece.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

void prepareVtk() {}

MpiSession::MpiSession()
{
  if (startedRank() >= 0)
  {
    throw std::runtime_error("this tipp was built without MPI and works on one rank; start it "
                             "without mpirun, which needs a build against a VTK with MPI.");
  }
}

MpiSession::~MpiSession() = default;

vtkMultiProcessController* MpiSession::controller() const
{
  return this->Controller;
}

bool MpiSession::isFirst() const
{
  return true;
}

int MpiSession::ranks() const
{
  return 1;
}

namespace
{

/// Reads a file whose cells keep their numbers, without vtkGhostType's array.
Piece readCells(const std::string& path, int threads)
{
  if (!isFlatMesh(path))
  {
    refuseVtkMesh(path);
  }
  const FlatMesh mesh = openFlatMesh(path);
  requireNoOtherCells(mesh);
  return readFlatPiece(mesh, threads);
}

void removeGhostArrays(Piece& piece)
{
  const auto isGhost = [](const Piece::Attribute& attribute)
  { return attribute.Description.Name == ghostArrayName; };
  piece.Attributes.erase(std::remove_if(piece.Attributes.begin(), piece.Attributes.end(), isGhost),
    piece.Attributes.end());
}

} // namespace

MeshPart readVtkPart(const std::string& path, int threads)
{
  /// The part, and the memory of its marks.
  struct MarkedPart
  {
    MeshPart Part;
    std::vector<unsigned char> Hidden;
  };
  const auto kept = std::make_shared<MarkedPart>();
  Piece piece = readCells(path, threads);
  const bool isSurface = piece.CellSize == 3;
  kept->Hidden = hiddenCells(piece);
  std::vector<bool> marked(std::size_t(piece.Points), false);
  if (markNotFinite(
        piece, isSurface ? std::vector<int>{ 0, 1 } : std::vector<int>{ 0, 1, 2 }, marked))
  {
    hideAt(piece, marked, kept->Hidden);
  }
  removeGhostArrays(piece);
  kept->Part = partOf(std::move(piece));
  MeshPart part = kept->Part;
  part.Mesh.Hidden = kept->Hidden.data();
  part.Keeps = kept;
  return part;
}

void flattenVtkFile(
  const std::string& path, const std::function<void(const Flattened& flattened)>& use)
{
  if (extensionOf(path) == ".vti")
  {
    use(flattenVtkImage(path));
    return;
  }
  Piece piece = readCells(path, 0);
  removeGhostArrays(piece);
  Flattened flattened;
  FlatContent& content = flattened.Content;
  content.CellSize = piece.CellSize;
  const auto* const ids = piece.Connectivity.as<std::int64_t>();
  content.Cells.assign(ids, ids + piece.Cells * piece.CellSize);
  content.Points = { "points", piece.PointType, 3, piece.Points, 0, piece.Coordinates.data(), {} };
  for (const Piece::Attribute& attribute : piece.Attributes)
  {
    const StoredArray& array = attribute.Description;
    (array.OfPoints ? content.PointData : content.CellData)
      .push_back({ array.Name, array.Type, array.Components,
        array.OfPoints ? piece.Points : piece.Cells, 0, attribute.Values.data(), {} });
  }
  use(flattened);
}

} // namespace tipp
