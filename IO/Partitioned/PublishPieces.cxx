// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PublishPieces.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/TextFile.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/Checksum.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/PieceLayout.h"

#include <string>

namespace tipp
{

namespace
{

/// Reads only the index, so that a mesh with missing or damaged pieces can be replaced, too.
std::vector<std::string> filesOf(const std::string& path)
{
  PartitionedMesh mesh;
  mesh.Path = path;
  const std::string index = mesh.indexPath();
  const std::size_t pieces = parseIndex(readTextFile(index), index).Pieces.size();
  std::vector<std::string> files;
  for (std::size_t piece = 0; piece < pieces; ++piece)
  {
    files.push_back(pieceName(piece));
  }
  for (const std::string& file : { index, mesh.tablesPath(), mesh.pvtuPath() })
  {
    files.push_back(file.substr(path.size() + 1));
  }
  return files;
}

} // namespace

const Replaceable replaceableMesh{ "partitioned mesh", isPartitionedMesh, filesOf };

namespace
{

/// Fills in each piece's borrowed groups.
void addBorrowed(std::vector<FinishedPiece>& pieces, bool duplicated)
{
  const auto eachGroup =
    [&](std::size_t owner, const std::vector<LentGroup>& groups, const auto& take)
  {
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
      for (const std::int32_t to : groups[g].To)
      {
        take(pieces[std::size_t(to)], BorrowedGroup{ std::int32_t(owner), std::int32_t(g) },
          groups[g].Count);
      }
    }
  };
  for (std::size_t owner = 0; owner < pieces.size(); ++owner)
  {
    eachGroup(owner, pieces[owner].Table.PointGroups,
      [](FinishedPiece& piece, BorrowedGroup group, std::int64_t)
      { piece.Table.BorrowedPoints.push_back(group); });
    eachGroup(owner, pieces[owner].Table.CellGroups,
      [duplicated](FinishedPiece& piece, BorrowedGroup group, std::int64_t count)
      {
        piece.Table.BorrowedCells.push_back(group);
        piece.Summary.BorrowedCells += duplicated ? 0 : count;
      });
  }
}

} // namespace

PublishedMesh publishPieces(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces)
{
  addBorrowed(pieces, mesh.Duplicated);
  std::uint64_t bytes = 0;
  std::string tables;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const std::vector<std::uint64_t> table = packTable(pieces[i].Table);
    PieceSummary& summary = pieces[i].Summary;
    summary.TableOffset = tables.size();
    summary.TableBytes = table.size() * 8;
    summary.TableChecksum = checksumOf(table.data(), table.size() * 8);
    tables.append(reinterpret_cast<const char*>(table.data()), table.size() * 8);
    mesh.Pieces[i] = summary;
    bytes += summary.FileBytes;
  }
  const std::string pvtu = pvtuText(mesh);
  const std::string index = indexText(mesh, pvtu);
  writeWholeFile(mesh.tablesPath(), tables);
  writeWholeFile(mesh.pvtuPath(), pvtu);
  syncToDisk(mesh.Path + "/pieces");
  syncToDisk(mesh.Path);
  writeWholeFile(mesh.indexPath(), index);
  openPartitionedMesh(mesh.Path);
  return { bytes + tables.size() + pvtu.size() + index.size(),
    checksumOf(index.data(), index.size()) };
}

namespace
{

PartitionedMesh openMesh(const std::string& path, std::uint64_t fingerprint)
{
  const PartitionedMesh mesh = openPartitionedMesh(path);
  const std::string index = readTextFile(mesh.indexPath());
  if (checksumOf(index.data(), index.size()) != fingerprint)
  {
    throw IOError(mesh.indexPath(), "is the index of another mesh.");
  }
  return mesh;
}

} // namespace

bool holdsMesh(const std::string& path, std::uint64_t fingerprint)
{
  try
  {
    openMesh(path, fingerprint);
    return true;
  }
  catch (const IOError&)
  {
    return false;
  }
}

void verifyMesh(const std::string& path, std::uint64_t fingerprint, int threads)
{
  const PartitionedMesh mesh = openMesh(path, fingerprint);
  verifyPvtu(mesh);
  parallelFor(std::int64_t(mesh.Pieces.size()), threads,
    [&](std::int64_t number)
    {
      ReadCounters counters;
      PieceFile(mesh, std::size_t(number), counters).verifyAll();
    });
}

} // namespace tipp
