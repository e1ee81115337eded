// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/NeighborIds.h"

#include "Meshes/MeshFiles.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/PieceWriter.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace tipp
{

const StoredArray neighborIdsArray{ "NeighborIds", false, Scalar::Int64, 3, -1 };

std::int64_t findNeighborIds(const PartitionedMesh& mesh)
{
  const auto found = std::find_if(mesh.Arrays.begin(), mesh.Arrays.end(),
    [](const StoredArray& array)
    {
      return array.Name == neighborIdsArray.Name && !array.OfPoints &&
        array.Type == neighborIdsArray.Type && array.Components == neighborIdsArray.Components &&
        array.Step == neighborIdsArray.Step;
    });
  return found == mesh.Arrays.end() ? -1 : found - mesh.Arrays.begin();
}

namespace
{

constexpr std::size_t tupleBytes = 3 * sizeof(std::int64_t);
constexpr std::size_t writeBufferBytes = std::size_t(1) << 20;

/// The array's index among the arrays of the piece's file.
std::size_t placeInFile(const PartitionedMesh& mesh, const PieceSummary& piece)
{
  const std::int64_t attribute = findNeighborIds(mesh);
  const std::vector<PieceArray> arrays = pieceArrays(mesh, piece);
  const auto found = std::find_if(arrays.begin(), arrays.end(),
    [&](const PieceArray& array) { return array.Attribute == attribute; });
  return std::size_t(found - arrays.begin());
}

/// Reads parts [part, end) of an array.
template <typename Value>
std::vector<Value> readParts(
  const PieceFile& file, PieceRole role, std::size_t part, std::size_t end)
{
  const std::size_t a = file.find(role);
  const PieceArray& array = file.arrays()[a];
  const std::vector<std::int64_t>& starts = file.partStarts(array.ofPoints());
  std::vector<Value> values(
    std::size_t(starts[end] - starts[part]) * std::size_t(array.Components));
  file.read(a, part, end, values.data());
  return values;
}

} // namespace

NeighborWriter::NeighborWriter(const PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces)
  : Mesh(mesh)
  , Pieces(pieces)
{
  std::int64_t cells = 0;
  for (const FinishedPiece& piece : pieces)
  {
    this->FirstCells.push_back(cells);
    cells += piece.Summary.Cells;
  }
}

std::uint64_t NeighborWriter::bytesFor(const FinishedPiece& piece)
{
  // Corners, neighbours and findNeighbors()' lists, and a buffer.
  constexpr std::uint64_t perCell = 12 + 12 + 8;
  return perCell * std::uint64_t(piece.Summary.Cells) + writeBufferBytes;
}

void NeighborWriter::add(std::size_t number)
{
  const FinishedPiece& piece = this->Pieces[number];
  ReadCounters counters;
  const PieceFile file(this->Mesh, number, piece.Summary, piece.Table, counters);
  const std::vector<std::int64_t>& parts = file.partStarts(false);
  const auto corners = readParts<std::int32_t>(file, PieceRole::Connectivity, 0, parts.size() - 1);
  std::vector<std::int32_t> neighbors(corners.size());
  findNeighbors(corners.data(), corners.size() / 3, neighbors.data());
  const std::vector<OpenEdge> open = findOpenEdges(file, corners, neighbors);

  const std::int64_t first = this->FirstCells[number];
  const auto idOf = [first](std::int32_t n) { return n < 0 ? std::int64_t(-1) : first + n; };
  Border border;
  border.FirstCell = first + parts[1];
  border.Open = open.size();
  std::transform(
    neighbors.begin() + 3 * parts[1], neighbors.end(), std::back_inserter(border.Values), idOf);
  this->write(number, 0, 1, [&, at = neighbors.begin()]() mutable { return idOf(*at++); });
  for (auto& [completed, values] : this->match(number, std::move(border), open))
  {
    this->writeBorder(completed, values);
  }
}

/// Finds the border's edges whose neighbour may be in another piece. All neighbours of a triangle
/// of part 0 are in its piece. Across an edge with a point of part 0, a border triangle's neighbour
/// is in its piece too, if there is one.
std::vector<NeighborWriter::OpenEdge> NeighborWriter::findOpenEdges(const PieceFile& file,
  const std::vector<std::int32_t>& corners, const std::vector<std::int32_t>& neighbors)
{
  const std::vector<std::int64_t>& pointParts = file.partStarts(true);
  const auto firstPoint = std::int32_t(pointParts[1]);
  const auto ids = readParts<std::int64_t>(file, PieceRole::PointIds, 1, pointParts.size() - 1);
  const auto firstCorner = std::size_t(3 * file.partStarts(false)[1]);
  std::vector<OpenEdge> open;
  for (std::size_t h = firstCorner; h < neighbors.size(); ++h)
  {
    const std::int32_t from = corners[h % 3 == 2 ? h - 2 : h + 1] - firstPoint;
    const std::int32_t to = corners[h % 3 == 0 ? h + 2 : h - 1] - firstPoint;
    if (neighbors[h] < 0 && from >= 0 && to >= 0)
    {
      open.push_back(
        { std::minmax(ids[std::size_t(from)], ids[std::size_t(to)]), h - firstCorner });
    }
  }
  return open;
}

/// Returns the borders that have no open edge any more.
std::vector<std::pair<std::size_t, NeighborWriter::Border>> NeighborWriter::match(
  std::size_t number, Border border, const std::vector<OpenEdge>& open)
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
  for (const OpenEdge& edge : open)
  {
    const auto [found, isNew] = this->Edges.emplace(edge.Ends, Waiting{ number, edge.At });
    if (isNew)
    {
      continue;
    }
    const auto other = this->Borders.find(found->second.Piece);
    mine->second.set(edge.At, other->second.cellOf(found->second.At));
    other->second.set(found->second.At, mine->second.cellOf(edge.At));
    this->Edges.erase(found);
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
  this->Edges.clear();
}

void NeighborWriter::writeBorder(std::size_t number, const Border& border)
{
  const std::size_t parts = 1 + this->Pieces[number].Table.CellGroups.size();
  this->write(number, 1, parts, [at = border.Values.begin()]() mutable { return *at++; });
}

/// Writes these parts of the array, value by value, and their checksums.
template <typename Next>
void NeighborWriter::write(std::size_t number, std::size_t begin, std::size_t end, Next next)
{
  FinishedPiece& piece = this->Pieces[number];
  const std::size_t a = placeInFile(this->Mesh, piece.Summary);
  const std::vector<std::int64_t> parts = piece.Table.parts(this->Mesh, piece.Summary, false);
  const std::uint64_t skipped = begin == 0 ? 0 : std::uint64_t(parts[0]);
  const OutputFile file = OutputFile::shared(this->Mesh.piecePath(number));
  ColumnWriter column(file, piece.Table.Offsets[a] + skipped * tupleBytes, writeBufferBytes);
  for (std::size_t part = begin; part < end; ++part)
  {
    for (std::int64_t i = 0; i < 3 * parts[part]; ++i)
    {
      const std::int64_t id = next();
      std::memcpy(column.extend(sizeof(id)), &id, sizeof(id));
    }
    column.endPart();
  }
  column.flush();
  file.startWriteback();
  std::vector<std::uint64_t>& checksums = piece.Table.Checksums[a];
  checksums.resize(begin);
  checksums.insert(checksums.end(), column.checksums().begin(), column.checksums().end());
}

} // namespace tipp
