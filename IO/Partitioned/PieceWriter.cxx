// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceWriter.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/TextFile.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/Checksum.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/PieceFormat.h"

#include <cstring>
#include <string>
#include <utility>

namespace tipp
{

ColumnWriter::ColumnWriter(const OutputFile& file, std::uint64_t offset, std::size_t bufferBytes)
  : File(file)
  , Offset(offset)
  , Unwritten(bufferBytes)
{
}

char* ColumnWriter::extend(std::size_t bytes)
{
  if (this->Used + bytes > this->Unwritten.size())
  {
    this->flush();
    if (bytes > this->Unwritten.size())
    {
      this->Unwritten = Buffer<char>(bytes);
    }
  }
  char* const room = this->Unwritten.data() + this->Used;
  this->Used += bytes;
  return room;
}

void ColumnWriter::endPart()
{
  this->Part.add(this->Unwritten.data() + this->Hashed, this->Used - this->Hashed);
  this->Hashed = this->Used;
  this->Checksums.push_back(this->Part.finish());
}

void ColumnWriter::flush()
{
  this->Part.add(this->Unwritten.data() + this->Hashed, this->Used - this->Hashed);
  this->File.write(this->Offset, this->Unwritten.data(), this->Used);
  this->Offset += this->Used;
  this->Used = 0;
  this->Hashed = 0;
}

std::uint64_t writeFrame(const OutputFile& file, const PieceLayout& layout, PieceTable& table)
{
  file.write(0, layout.Header.data(), layout.Header.size());
  const std::size_t footer = std::strlen(pieceFooter);
  file.write(layout.End, pieceFooter, footer);
  file.startWriteback();
  table.Offsets = layout.Offsets;
  table.HeaderBytes = layout.Header.size();
  table.HeaderChecksum = checksumOf(layout.Header.data(), layout.Header.size());
  return layout.End + footer;
}

PieceWriter::PieceWriter(const PartitionedMesh& mesh, std::size_t number,
  const PieceSummary& summary, std::size_t bufferBytes)
  : Layout(layOutPiece(mesh, number, summary))
  , File(mesh.piecePath(number))
{
  for (std::size_t a = 0; a < this->Layout.Arrays.size(); ++a)
  {
    const PieceArray& array = this->Layout.Arrays[a];
    const std::uint64_t bytes =
      std::uint64_t(storedTuples(mesh, summary, array)) * array.tupleBytes();
    this->File.write(this->Layout.Offsets[a] - 8, &bytes, 8);
    this->Columns.emplace_back(this->File, this->Layout.Offsets[a], bufferBytes);
  }
}

void PieceWriter::endPart(bool ofPoints)
{
  for (std::size_t a = 0; a < this->Columns.size(); ++a)
  {
    if (this->Layout.Arrays[a].ofPoints() == ofPoints)
    {
      this->Columns[a].endPart();
    }
  }
}

std::uint64_t PieceWriter::finish(PieceTable& table)
{
  for (ColumnWriter& column : this->Columns)
  {
    column.flush();
    table.Checksums.push_back(std::move(column.checksums()));
  }
  return writeFrame(this->File, this->Layout, table);
}

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
  for (std::size_t owner = 0; owner < pieces.size(); ++owner)
  {
    for (const bool ofPoints : { true, false })
    {
      const PieceTable& table = pieces[owner].Table;
      const std::vector<SharedGroup>& groups = ofPoints ? table.PointGroups : table.CellGroups;
      for (std::size_t g = 0; g < groups.size(); ++g)
      {
        for (const std::int32_t to : groups[g].Borrowers)
        {
          FinishedPiece& piece = pieces[std::size_t(to)];
          (ofPoints ? piece.Table.BorrowedPoints : piece.Table.BorrowedCells)
            .push_back({ std::int32_t(owner), std::int32_t(g) });
          piece.Summary.BorrowedCells += ofPoints || duplicated ? 0 : groups[g].Count;
        }
      }
    }
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
    const Bytes table = packTable(pieces[i].Table);
    PieceSummary& summary = pieces[i].Summary;
    summary.TableOffset = tables.size();
    summary.TableBytes = table.size();
    summary.TableChecksum = checksumOf(table.data(), table.size());
    tables.append(table.data(), table.size());
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
  PartitionedMesh mesh = openPartitionedMesh(path);
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
    [&](std::int64_t number) { PieceFile(mesh, std::size_t(number)).verifyAll(); });
}

} // namespace tipp
