// SPDX-License-Identifier: BSD-3-Clause
// The part of PieceAssembly that turns rows into arrays.
#include "Partitioning/PieceAssembly.h"

#include "Partitioning/PointCoordinates.h"

#include <algorithm>
#include <stdexcept>

namespace tipp
{
namespace
{

/// Copies `bytes` bytes at `offset` of each row to consecutive memory.
template <std::size_t Bytes>
void copyFixed(const std::vector<const char*>& rows, std::size_t offset, char* to)
{
  for (const char* row : rows)
  {
    std::memcpy(to, row + offset, Bytes);
    to += Bytes;
  }
}

void copyBytes(
  const std::vector<const char*>& rows, std::size_t offset, std::size_t bytes, char* to)
{
  if (bytes == 8)
  {
    copyFixed<8>(rows, offset, to);
    return;
  }
  if (bytes == 4)
  {
    copyFixed<4>(rows, offset, to);
    return;
  }
  for (const char* row : rows)
  {
    std::memcpy(to, row + offset, bytes);
    to += bytes;
  }
}

/// Converts coordinates of two or three components to three; in 2D the third is 0.
void copyCoordinates(const std::vector<const char*>& rows, const RawArray& points, char* to)
{
  const std::size_t bytes = points.tupleBytes();
  const std::size_t three = 3 * scalarSize(points.Type);
  for (const char* row : rows)
  {
    std::memset(to + bytes, 0, three - bytes);
    std::memcpy(to, row + 8, bytes);
    to += three;
  }
}

} // namespace

/// The offset of an attribute in a row.
std::size_t PieceAssembly::dataOffset(const PieceArray& array) const
{
  const bool ofPoints = array.ofPoints();
  std::size_t offset = ofPoints ? 8 + this->Run.Mesh.Points.tupleBytes() : this->Run.Rows.CellData;
  for (std::int64_t i = 0; i < array.Attribute; ++i)
  {
    const StoredArray& before = this->Run.Result.Arrays[std::size_t(i)];
    if (before.OfPoints == ofPoints)
    {
      offset += std::size_t(before.Components) * scalarSize(before.Type);
    }
  }
  return offset;
}

void PieceAssembly::extendBounds(const RowPointers& rows)
{
  const RawArray& points = this->Run.Mesh.Points;
  for (const char* row : rows)
  {
    double xyz[3] = {};
    takeCoordinates(points, row + 8, 1, points.Components, xyz);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double& least = this->Summary.Extent[2 * axis];
      double& greatest = this->Summary.Extent[2 * axis + 1];
      least = std::min(least, xyz[axis]);
      greatest = std::max(greatest, xyz[axis]);
    }
  }
}

void PieceAssembly::appendPoints(const RowPointers& rows)
{
  if (rows.empty())
  {
    return;
  }
  const std::vector<PieceArray>& arrays = this->Writer->arrays();
  for (std::size_t a = 0; a < arrays.size(); ++a)
  {
    if (arrays[a].ofPoints())
    {
      char* const to = this->Writer->extend(a, rows.size() * arrays[a].tupleBytes());
      this->appendPointArray(rows, arrays[a], to);
    }
  }
}

void PieceAssembly::appendPointArray(
  const RowPointers& rows, const PieceArray& array, char* to) const
{
  if (array.Role == PieceRole::Points)
  {
    copyCoordinates(rows, this->Run.Mesh.Points, to);
  }
  else if (array.Role == PieceRole::PointData)
  {
    copyBytes(rows, this->dataOffset(array), array.tupleBytes(), to);
  }
  else
  {
    const bool ids = array.Role == PieceRole::PointIds;
    for (const char* row : rows)
    {
      std::uint64_t word = 0;
      std::memcpy(&word, row, 8);
      const std::uint64_t value = ids ? word >> 2 : word & RowLayout::Foreign;
      std::memcpy(to, &value, array.tupleBytes());
      to += array.tupleBytes();
    }
  }
}

void PieceAssembly::appendCells(const RowPointers& rows, bool ghosts)
{
  if (rows.empty())
  {
    return;
  }
  const std::vector<PieceArray>& arrays = this->Writer->arrays();
  for (std::size_t a = 0; a < arrays.size(); ++a)
  {
    if (!arrays[a].ofPoints())
    {
      char* const to = this->Writer->extend(a, rows.size() * arrays[a].tupleBytes());
      this->appendCellArray(rows, arrays[a], ghosts, to);
    }
  }
  this->CellsWritten += std::int64_t(rows.size());
}

template <typename Id>
void PieceAssembly::appendLocalIds(const RowPointers& rows, const PieceArray& array, char* to)
{
  std::vector<Id> values;
  values.reserve(rows.size() * this->Corners);
  if (array.Role == PieceRole::Offsets)
  {
    for (std::size_t i = 1; i <= rows.size(); ++i)
    {
      values.push_back(Id((this->CellsWritten + std::int64_t(i)) * std::int64_t(this->Corners)));
    }
  }
  else
  {
    std::vector<std::int64_t> ids;
    ids.reserve(rows.size() * this->Corners);
    for (const char* row : rows)
    {
      for (std::size_t corner = 1; corner <= this->Corners; ++corner)
      {
        ids.push_back(this->Run.Rows.id(row, corner));
      }
    }
    values.resize(ids.size());
    if (!this->Local.translate(ids.data(), ids.size(), values.data()))
    {
      throw std::logic_error("a piece lacks a point of one of its cells");
    }
  }
  std::memcpy(to, values.data(), values.size() * sizeof(Id));
}

void PieceAssembly::appendCellArray(
  const RowPointers& rows, const PieceArray& array, bool ghosts, char* to)
{
  constexpr int vtkTriangle = 5;
  constexpr int vtkTetra = 10;
  switch (array.Role)
  {
    case PieceRole::Connectivity:
    case PieceRole::Offsets:
      array.Type == Scalar::Int64 ? this->appendLocalIds<std::int64_t>(rows, array, to)
                                  : this->appendLocalIds<std::int32_t>(rows, array, to);
      break;
    case PieceRole::Types:
      std::memset(to, this->Corners == 3 ? vtkTriangle : vtkTetra, rows.size());
      break;
    case PieceRole::CellGhosts:
      std::memset(to, ghosts ? 1 : 0, rows.size());
      break;
    case PieceRole::CellIds:
      for (const char* row : rows)
      {
        const std::int64_t id = this->Run.Rows.id(row, 0);
        std::memcpy(to, &id, 8);
        to += 8;
      }
      break;
    default:
      copyBytes(rows, this->dataOffset(array), array.tupleBytes(), to);
  }
}

} // namespace tipp
