// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/GrowingPiece.h"

#include "Files/IOError.h"
#include "Partitioned/ColumnWriter.h"
#include "Partitioned/PieceTuples.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace tipp
{
namespace
{

constexpr std::size_t blockTuples = 4096;
constexpr std::size_t bufferBytes = std::size_t(1) << 20;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Calls visit(corners as indices in the piece, whether one of them is a rim point) for each
/// triangle.
template <typename Visit>
void forEachTriangle(const GrowingPiece::Interior& interior,
  const std::vector<std::int32_t>& numbers, const Visit& visit)
{
  for (const GrowingPiece::Corners& run : interior.Triangles)
  {
    const std::int32_t* corner = run.Begin;
    for (std::size_t t = 0; t < run.Triangles; ++t, corner += 3)
    {
      const std::array<std::int32_t, 3> triangle = { numbers[std::size_t(corner[0])],
        numbers[std::size_t(corner[1])], numbers[std::size_t(corner[2])] };
      visit(triangle, (triangle[0] | triangle[1] | triangle[2]) < 0);
    }
  }
}

} // namespace

void GrowingPiece::addTriangle(
  const std::array<std::int64_t, 3>& places, const std::vector<std::int32_t>& borrowers)
{
  this->Borrowers.insert(this->Borrowers.end(), borrowers.begin(), borrowers.end());
  this->Shared.push_back({ places, this->Borrowers.size() });
}

void GrowingPiece::addRow(std::int64_t place, const PointRowLayout& rows)
{
  this->Ghosts.emplace(place, std::int64_t(this->GhostPlaces.size()));
  this->GhostPlaces.push_back(place);
  this->GhostRows.resize(this->GhostRows.size() + rows.Words);
}

void GrowingPiece::setRow(std::int64_t place, const double* row, const PointRowLayout& rows)
{
  std::copy_n(
    row, rows.Words, this->GhostRows.data() + std::size_t(this->Ghosts.at(place)) * rows.Words);
}

GrowingPiece::BorderMesh GrowingPiece::borderMesh(const PointRowLayout& rows) const
{
  BorderMesh mesh;
  std::unordered_map<std::int64_t, std::int32_t> known;
  for (const SharedTriangle& triangle : this->Shared)
  {
    for (const std::int64_t place : triangle.Places)
    {
      const auto [found, isNew] = known.emplace(place, std::int32_t(known.size()));
      if (isNew)
      {
        const double* const row = this->owns(place)
          ? this->rimRow(place, rows)
          : this->GhostRows.data() + std::size_t(this->Ghosts.at(place)) * rows.Words;
        mesh.Rows.insert(mesh.Rows.end(), row, row + rows.Words);
      }
      mesh.Corners.push_back(found->second);
    }
  }
  return mesh;
}

const double* GrowingPiece::rimRow(std::int64_t place, const PointRowLayout& rows) const
{
  const auto found = std::lower_bound(this->RimPlaces.begin(), this->RimPlaces.end(), place);
  if (found == this->RimPlaces.end() || *found != place)
  {
    throw std::logic_error("a point of a triangle at the border is not on the rim");
  }
  return this->RimRows.data() + std::size_t(found - this->RimPlaces.begin()) * rows.Words;
}

void GrowingPiece::numberPoints(
  const Interior& interior, const PointRowLayout& rows, std::vector<std::int32_t>& numbers)
{
  this->Extent = { infinity, -infinity, infinity, -infinity, infinity, -infinity };
  numbers.resize(std::size_t(this->OwnPoints));
  std::int32_t next = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const double* const row = interior.Rows + i * rows.Words;
    extendBounds(this->Extent, row, rows);
    if (interior.Rim[i] == 0)
    {
      numbers[i] = next++;
      continue;
    }
    numbers[i] = -1 - std::int32_t(this->RimPlaces.size());
    this->RimPlaces.push_back(this->First + std::int64_t(i));
    this->RimRows.insert(this->RimRows.end(), row, row + rows.Words);
  }
  this->InteriorPoints = next;
}

/// Counts the interior's triangles, and keeps those at rim points.
std::int64_t GrowingPiece::countInterior(
  const Interior& interior, const std::vector<std::int32_t>& numbers)
{
  std::int64_t count = 0;
  forEachTriangle(interior, numbers,
    [&](const std::array<std::int32_t, 3>& triangle, bool isOnRim)
    {
      if (isOnRim)
      {
        this->RimTriangles.push_back(triangle);
      }
      count += isOnRim ? 0 : 1;
    });
  return count;
}

/// The border's size is not known yet: reserves more than it usually takes.
void GrowingPiece::makeRoom(const PartitionedMesh& mesh, std::size_t number)
{
  const auto rim = std::int64_t(this->RimPlaces.size());
  this->Room = mesh.Pieces[number];
  this->Room.Points = this->OwnPoints + rim / 2 + 256;
  this->Room.Cells = this->InteriorCells + std::int64_t(this->RimTriangles.size()) + 2 * rim + 256;
  if (hasWideIds(mesh, this->Room))
  {
    throw IOError(mesh.piecePath(number),
      "would have more points than 32-bit numbers can count; give less memory or more partitions.");
  }
}

void GrowingPiece::writeInterior(const PartitionedMesh& mesh, std::size_t number,
  const PointRowLayout& rows, const Interior& interior)
{
  std::vector<std::int32_t> numbers;
  this->numberPoints(interior, rows, numbers);
  this->InteriorCells = this->countInterior(interior, numbers);
  if (mesh.Path.empty())
  {
    this->sumInterior(interior, rows);
    return;
  }
  this->makeRoom(mesh, number);
  const PieceLayout layout = layOutPiece(mesh, number, this->Room, &this->Room);
  const OutputFile file(mesh.piecePath(number));
  for (std::size_t a = 0; a < layout.Arrays.size(); ++a)
  {
    this->writeInteriorArray(
      file, layout.Arrays[a], layout.Offsets[a], rows, interior, numbers, this->Checksums);
  }
  file.startWriteback();
}

void GrowingPiece::writeInteriorArray(const OutputFile& file, const PieceArray& array,
  std::uint64_t offset, const PointRowLayout& rows, const Interior& interior,
  const std::vector<std::int32_t>& numbers, std::vector<std::uint64_t>& checksums) const
{
  if (holdsCellIds(array))
  {
    checksums.push_back(0); // filled in once they are known
    return;
  }
  ColumnWriter column(file, offset, bufferBytes);
  if (array.ofPoints())
  {
    const std::size_t bytes = array.tupleBytes();
    const bool needsRepresentatives =
      interior.Representatives && !interior.Representatives->empty();
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      if (numbers[i] >= 0)
      {
        const double* const row = interior.Rows + i * rows.Words;
        std::int64_t representative = rows.id(row);
        if (needsRepresentatives)
        {
          const auto found = interior.Representatives->find(std::int32_t(i));
          representative = found == interior.Representatives->end()
            ? representative
            : rows.id(interior.Rows + std::size_t(found->second) * rows.Words);
        }
        copyPiecePoint(array, row, rows, false, representative, column.extend(bytes));
      }
    }
  }
  else if (array.Role == PieceRole::Connectivity)
  {
    forEachTriangle(interior, numbers,
      [&](const std::array<std::int32_t, 3>& triangle, bool isOnRim)
      {
        if (!isOnRim)
        {
          std::memcpy(column.extend(sizeof(triangle)), triangle.data(), sizeof(triangle));
        }
      });
  }
  else
  {
    for (std::int64_t at = 0; at < this->InteriorCells; at += blockTuples)
    {
      const auto count = std::size_t(std::min<std::int64_t>(blockTuples, this->InteriorCells - at));
      fillPieceCells(array, at, count, column.extend(count * array.tupleBytes()));
    }
  }
  column.endPart();
  column.flush();
  checksums.push_back(column.checksums()[0]);
}

std::uint64_t GrowingPiece::hashTriangle(std::int64_t a, std::int64_t b, std::int64_t c)
{
  const auto mix = [](std::uint64_t x) // the finaliser of splitmix64
  {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  };
  // A sum over directed edges is independent of which corner comes first.
  const auto edge = [&](std::int64_t from, std::int64_t to)
  { return mix(mix(std::uint64_t(from)) + std::uint64_t(to)); };
  return mix(edge(a, b) + edge(b, c) + edge(c, a));
}

void GrowingPiece::sumInterior(const Interior& interior, const PointRowLayout& rows)
{
  for (const Corners& run : interior.Triangles)
  {
    for (std::size_t t = 0; t < run.Triangles; ++t)
    {
      const auto id = [&](std::size_t i)
      { return rows.id(interior.Rows + std::size_t(run.Begin[3 * t + i]) * rows.Words); };
      this->InteriorSum += hashTriangle(id(0), id(1), id(2));
    }
  }
}

std::uint64_t GrowingPiece::sumBorder(const PointRowLayout& rows) const
{
  const auto id = [&](std::int64_t place)
  {
    return rows.id(this->owns(place)
        ? this->rimRow(place, rows)
        : this->GhostRows.data() + std::size_t(this->Ghosts.at(place)) * rows.Words);
  };
  std::uint64_t sum = 0;
  for (const SharedTriangle& triangle : this->Shared)
  {
    sum += hashTriangle(id(triangle.Places[0]), id(triangle.Places[1]), id(triangle.Places[2]));
  }
  return sum;
}

} // namespace tipp
