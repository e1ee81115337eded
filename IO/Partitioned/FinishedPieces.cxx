// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/FinishedPieces.h"

#include "Arrays/FindNeighbors.h"
#include "Files/Checksum.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/VirtualHdf.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iterator>

namespace tipp
{
namespace
{

/// Writes parts [parts.first, parts.second) of the array with index `a` of a piece's cells into its
/// file, and their checksums into its table: writeNext(to, bytes) writes the tuple of the next
/// cell. Throws IOError.
template <typename WriteNext>
void writeCellParts(const PartitionedMesh& mesh, std::size_t number, std::size_t a,
  std::pair<std::size_t, std::size_t> parts, FinishedPiece& piece, WriteNext writeNext)
{
  const std::size_t bytes = pieceArrays(mesh, piece.Summary)[a].tupleBytes();
  const std::vector<std::int64_t> starts = piece.Table.partStarts(mesh, piece.Summary, false);
  const OutputFile file = OutputFile::shared(mesh.piecePath(number));
  ColumnWriter column(
    file, piece.Table.Offsets[a] + std::uint64_t(starts[parts.first]) * bytes, columnBufferBytes);
  for (std::size_t part = parts.first; part < parts.second; ++part)
  {
    for (std::int64_t i = starts[part]; i < starts[part + 1]; ++i)
    {
      writeNext(column.extend(bytes), bytes);
    }
    column.endPart();
  }
  column.flush();
  file.startWriteback();
  std::vector<std::uint64_t>& checksums = piece.Table.Checksums[a];
  checksums.resize(parts.first);
  checksums.insert(checksums.end(), column.checksums().begin(), column.checksums().end());
}

/// Reads an array's parts from `first` on.
template <typename Value>
std::vector<Value> readParts(const PieceFile& file, PieceRole role, std::size_t first)
{
  const std::size_t a = file.find(role);
  const PieceArray& array = file.arrays()[a];
  const std::vector<std::int64_t>& starts = file.partStarts(array.ofPoints());
  std::vector<Value> values(
    std::size_t(starts.back() - starts[first]) * std::size_t(array.Components));
  file.read(a, first, starts.size() - 1, values.data());
  return values;
}

/// Reads only the index, so that a mesh with missing or damaged pieces can be replaced, too.
std::vector<std::string> filesOf(const std::string& path)
{
  PartitionedMesh mesh;
  mesh.Path = path;
  const std::string index = mesh.indexPath();
  const PartitionedMesh parsed = parseIndex(readTextFile(index), index);
  std::vector<std::string> files;
  for (std::size_t piece = 0; piece < parsed.Pieces.size(); ++piece)
  {
    files.push_back(pieceName(piece));
  }
  for (const std::string& file : { index, mesh.tablesPath(), mesh.pvtuPath() })
  {
    files.push_back(file.substr(path.size() + 1));
  }
  if (parsed.VtkHdfBytes > 0)
  {
    files.push_back(mesh.vtkHdfPath().substr(path.size() + 1));
  }
  return files;
}

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

/// Writes mesh.pvtu and mesh.vtkhdf. Returns their bytes.
std::uint64_t writeViews(PartitionedMesh& mesh)
{
  const std::string pvtu = pvtuText(mesh);
  writeWholeFile(mesh.pvtuPath(), pvtu);
  mesh.PvtuBytes = pvtu.size();
  mesh.PvtuChecksum = checksumOf(pvtu.data(), pvtu.size());
  writeVirtualHdf(mesh);
  mesh.VtkHdfBytes = InputFile(mesh.vtkHdfPath()).size();
  mesh.VtkHdfChecksum = fileChecksum(mesh.vtkHdfPath());
  return mesh.PvtuBytes + mesh.VtkHdfBytes;
}

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

void takeNextFile(const std::string& path)
{
  std::error_code failure;
  std::filesystem::rename(path + nextPieceSuffix, path, failure);
  if (failure && failure != std::errc::no_such_file_or_directory)
  {
    throw IOError(path, "cannot be replaced (" + failure.message() + ").");
  }
}

void writeCellIds(
  const PartitionedMesh& mesh, std::size_t number, std::int64_t first, FinishedPiece& piece)
{
  takeNextFile(mesh.piecePath(number));
  const std::size_t array = findArray(pieceArrays(mesh, piece.Summary), PieceRole::CellIds);
  writeCellParts(mesh, number, array, { 0, piece.cellParts() }, piece,
    [&first](char* to, std::size_t bytes)
    {
      std::memcpy(to, &first, bytes);
      ++first;
    });
}

void writeLateArray(const PartitionedMesh& mesh, std::size_t number, std::int64_t attribute,
  const char* values, FinishedPiece& piece)
{
  const std::size_t array = findArrayOf(pieceArrays(mesh, piece.Summary), attribute);
  writeCellParts(mesh, number, array, { 0, piece.cellParts() }, piece,
    [&values](char* to, std::size_t bytes)
    {
      std::memcpy(to, values, bytes);
      values += bytes;
    });
}

void verifyFinished(const PartitionedMesh& mesh, std::size_t number, const FinishedPiece& piece)
{
  if (mesh.Path.empty())
  {
    return;
  }
  takeNextFile(mesh.piecePath(number));
  PieceFile(mesh, number, piece.Summary, piece.Table).verifyAll();
}

const StoredArray neighborIdsArray{ "NeighborIds", false, Scalar::Int64, 3, -1 };

std::int64_t findNeighborIds(const PartitionedMesh& mesh)
{
  const auto found = std::find_if(mesh.Arrays.begin(), mesh.Arrays.end(),
    [&mesh](const StoredArray& array)
    {
      return array.Name == neighborIdsArray.Name && !array.OfPoints &&
        array.Type == neighborIdsArray.Type && array.Components == mesh.CellSize &&
        array.Step == neighborIdsArray.Step;
    });
  return found == mesh.Arrays.end() ? -1 : found - mesh.Arrays.begin();
}

NeighborWriter::NeighborWriter(const PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces)
  : Mesh(mesh)
  , Corners(std::size_t(mesh.CellSize))
  , Pieces(pieces)
{
  std::int64_t cells = 0;
  for (const FinishedPiece& piece : pieces)
  {
    this->FirstCells.push_back(cells);
    cells += piece.Summary.Cells;
  }
}

std::uint64_t NeighborWriter::bytesFor(const PartitionedMesh& mesh, const FinishedPiece& piece)
{
  // Corners, neighbours and the lists to find them, and a buffer.
  const std::uint64_t perCell = mesh.CellSize == 4 ? 16 + 16 + 16 : 12 + 12 + 8;
  return perCell * std::uint64_t(piece.Summary.Cells) + columnBufferBytes;
}

void NeighborWriter::add(std::size_t number)
{
  const FinishedPiece& piece = this->Pieces[number];
  const PieceFile file(this->Mesh, number, piece.Summary, piece.Table);
  const std::vector<std::int64_t>& parts = file.partStarts(false);
  const auto corners = readParts<std::int32_t>(file, PieceRole::Connectivity, 0);
  std::vector<std::int32_t> neighbors(corners.size());
  this->Corners == 4 ? findNeighbors<4>(corners.data(), corners.size() / 4, neighbors.data())
                     : findNeighbors(corners.data(), corners.size() / 3, neighbors.data());
  const std::vector<OpenFacet> open = this->findOpenFacets(file, corners, neighbors);

  const std::int64_t first = this->FirstCells[number];
  const auto idOf = [first](std::int32_t n) { return n < 0 ? std::int64_t(-1) : first + n; };
  Border border;
  border.FirstCell = first + parts[1];
  border.Open = open.size();
  std::transform(neighbors.begin() + std::ptrdiff_t(this->Corners) * parts[1], neighbors.end(),
    std::back_inserter(border.Values), idOf);
  this->write(number, { 0, 1 }, [&, at = neighbors.begin()]() mutable { return idOf(*at++); });
  for (auto& [completed, values] : this->match(number, std::move(border), open))
  {
    this->writeBorder(completed, values);
  }
}

/// Finds the border's facets whose neighbour may be in another piece. All neighbours of a cell of
/// part 0 are in its piece. Across a facet with a point of part 0, a border cell's neighbour is in
/// its piece too, if there is one.
std::vector<NeighborWriter::OpenFacet> NeighborWriter::findOpenFacets(const PieceFile& file,
  const std::vector<std::int32_t>& corners, const std::vector<std::int32_t>& neighbors) const
{
  const std::vector<std::int64_t>& pointParts = file.partStarts(true);
  const auto firstPoint = std::int32_t(pointParts[1]);
  const auto ids = readParts<std::int64_t>(file, PieceRole::PointIds, 1);
  const std::size_t firstCorner = this->Corners * std::size_t(file.partStarts(false)[1]);
  std::vector<OpenFacet> open;
  for (std::size_t h = firstCorner; h < neighbors.size(); ++h)
  {
    const std::size_t cell = h - h % this->Corners;
    Facet facet = { -1, -1, -1 };
    std::size_t next = this->Corners == 3 ? 1 : 0;
    bool isOfBorder = neighbors[h] < 0;
    for (std::size_t c = cell; c < cell + this->Corners && isOfBorder; ++c)
    {
      const std::int32_t point = corners[c] - firstPoint;
      isOfBorder = c == h || point >= 0;
      if (c != h && isOfBorder)
      {
        facet[next++] = ids[std::size_t(point)];
      }
    }
    if (isOfBorder)
    {
      std::sort(facet.begin(), facet.end());
      open.push_back({ facet, h - firstCorner });
    }
  }
  return open;
}

/// Returns the borders that have no open facet any more.
std::vector<std::pair<std::size_t, NeighborWriter::Border>> NeighborWriter::match(
  std::size_t number, Border border, const std::vector<OpenFacet>& open)
{
  std::vector<std::pair<std::size_t, Border>> complete;
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto take = [&](const auto& found)
  {
    if (found->second.Open == 0)
    {
      complete.emplace_back(found->first, std::move(found->second));
      this->Borders.erase(found);
    }
  };
  const auto mine = this->Borders.emplace(number, std::move(border)).first;
  for (const OpenFacet& facet : open)
  {
    const auto [found, isNew] = this->Facets.emplace(facet.Points, Waiting{ number, facet.At });
    if (isNew)
    {
      continue;
    }
    const auto other = this->Borders.find(found->second.Piece);
    mine->second.set(facet.At, this->cellOf(other->second, found->second.At));
    other->second.set(found->second.At, this->cellOf(mine->second, facet.At));
    this->Facets.erase(found);
    take(other);
  }
  take(mine);
  return complete;
}

void NeighborWriter::finish()
{
  for (const auto& [number, border] : this->Borders)
  {
    this->writeBorder(number, border);
  }
  this->Borders.clear();
  this->Facets.clear();
}

void NeighborWriter::writeBorder(std::size_t number, const Border& border)
{
  this->write(number, { 1, this->Pieces[number].cellParts() },
    [at = border.Values.begin()]() mutable { return *at++; });
}

/// Writes the parts [parts.first, parts.second) of the array of neighbour ids of piece `number`.
/// next() returns the values one by one.
template <typename Next>
void NeighborWriter::write(std::size_t number, std::pair<std::size_t, std::size_t> parts, Next next)
{
  FinishedPiece& piece = this->Pieces[number];
  const std::size_t array =
    findArrayOf(pieceArrays(this->Mesh, piece.Summary), findNeighborIds(this->Mesh));
  writeCellParts(this->Mesh, number, array, parts, piece,
    [&next](char* to, std::size_t bytes)
    {
      for (const char* const end = to + bytes; to < end; to += sizeof(std::int64_t))
      {
        const std::int64_t id = next();
        std::memcpy(to, &id, sizeof(id));
      }
    });
}

const Replaceable replaceableMesh{ "partitioned mesh", isPartitionedMesh, filesOf };

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
  writeWholeFile(mesh.tablesPath(), tables);
  bytes += tables.size() + writeViews(mesh);
  const std::string index = indexText(mesh);
  syncToDisk(mesh.Path + "/pieces");
  syncToDisk(mesh.Path);
  writeWholeFile(mesh.indexPath(), index);
  openPartitionedMesh(mesh.Path);
  return { bytes + index.size(), checksumOf(index.data(), index.size()) };
}

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
  verifyViews(mesh);
  parallelFor(std::int64_t(mesh.Pieces.size()), threads,
    [&](std::int64_t number) { PieceFile(mesh, std::size_t(number)).verifyAll(); });
}

} // namespace tipp
