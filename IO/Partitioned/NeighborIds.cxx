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
    [&mesh](const StoredArray& array)
    {
      return array.Name == neighborIdsArray.Name && !array.OfPoints &&
        array.Type == neighborIdsArray.Type && array.Components == mesh.CellSize &&
        array.Step == neighborIdsArray.Step;
    });
  return found == mesh.Arrays.end() ? -1 : found - mesh.Arrays.begin();
}

namespace
{

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
  const auto corners = readParts<std::int32_t>(file, PieceRole::Connectivity, 0, parts.size() - 1);
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
  const auto ids = readParts<std::int64_t>(file, PieceRole::PointIds, 1, pointParts.size() - 1);
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

/// Writes these parts of the array; next() returns the values one by one.
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

} // namespace tipp
