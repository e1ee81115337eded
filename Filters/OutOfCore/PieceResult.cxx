// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceResult.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"

#include <filesystem>
#include <mutex>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

FinishedPiece readFinished(const std::string& path)
{
  return unpacked<FinishedPiece>(readCheckedFile(path));
}

void removePiece(const PartitionedMesh& mesh, const StoredPiece& piece)
{
  removeFile(piece.Result);
  removeFile(piece.Finished);
  if (!mesh.Path.empty())
  {
    const std::string file = mesh.piecePath(piece.Number);
    removeFile(file + nextPieceSuffix);
    std::error_code ignored;
    fs::create_directories(fs::path(file).parent_path(), ignored);
  }
}

} // namespace

std::vector<char> verifyPieces(const PartitionedMesh& mesh, const std::vector<StoredPiece>& pieces,
  const std::function<PieceInterior(PartitionIndex)>& interior, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn)
{
  std::vector<char> isDone(pieces.size(), 0);
  std::mutex mutex;
  std::string damaged; // path of the first damaged file
  int others = -1;
  const auto verify = [&](std::int64_t at, std::int64_t, int)
  {
    const StoredPiece& piece = pieces[std::size_t(at)];
    try
    {
      if (pathExists(piece.Result))
      {
        SectionFile(piece.Result).verify();
        pathExists(piece.Finished)
          ? verifyFinished(mesh, piece.Number, readFinished(piece.Finished))
          : verifyInterior(mesh, piece.Number, interior(PartitionIndex(at)));
        isDone[std::size_t(at)] = 1;
        return;
      }
    }
    catch (const IOError& error)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      damaged = damaged.empty() || error.path() < damaged ? error.path() : damaged;
      ++others;
    }
    removePiece(mesh, piece);
  };
  forChunks(std::int64_t(pieces.size()), 1, threads, report, verify);
  if (!damaged.empty() && warn)
  {
    warn(damaged + ": is damaged or missing; its piece" +
      (others > 0 ? " and " + std::to_string(others) + " more are" : " is") +
      " made again from the points that were spilled.");
  }
  return isDone;
}

FinishedPiece finishOnce(const std::string& path, const std::function<FinishedPiece()>& finish)
{
  if (pathExists(path))
  {
    return readFinished(path);
  }
  FinishedPiece finished = finish();
  // The record must exist before the file is used further: the file may no longer have the layout
  // that the result describes.
  writeCheckedFile(path, [&](SaveArchive& archive) { archive(finished); });
  return finished;
}

} // namespace tipp
