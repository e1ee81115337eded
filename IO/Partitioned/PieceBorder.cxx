// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/GrowingPiece.h"

#include "Arrays/IndexMap.h"
#include "Arrays/Random.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace tipp
{

std::uint64_t hashTriangle(std::int64_t a, std::int64_t b, std::int64_t c)
{
  // A sum over directed edges is independent of which corner comes first.
  const auto edge = [](std::int64_t from, std::int64_t to)
  { return mixBits(mixBits(std::uint64_t(from)) + std::uint64_t(to)); };
  return mixBits(edge(a, b) + edge(b, c) + edge(c, a));
}

std::uint64_t sumTriangles(
  const TriangleRange& triangles, const double* rows, const PointRowLayout& layout)
{
  const auto id = [&](std::int32_t point)
  { return layout.id(rows + std::size_t(point) * layout.Words); };
  std::uint64_t sum = 0;
  const std::int32_t* corner = triangles.Begin;
  for (std::size_t t = 0; t < triangles.Triangles; ++t, corner += 3)
  {
    sum += hashTriangle(id(corner[0]), id(corner[1]), id(corner[2]));
  }
  return sum;
}

void copyPoint(const PieceArray& array, const double* row, const PointRowLayout& layout,
  bool isGhost, std::int64_t representative, char* to)
{
  const std::int64_t id = layout.id(row);
  switch (array.Role)
  {
    case PieceRole::Points:
    {
      const Point3 point = layout.point(row);
      std::memcpy(to, &point, sizeof(point));
      break;
    }
    case PieceRole::PointIds:
      std::memcpy(to, &id, sizeof(id));
      break;
    case PieceRole::PointGhosts:
      *to = isGhost ? 1 : 0;
      break;
    default:
    {
      const int word = layout.Attributes[std::size_t(array.Attribute)];
      const void* const from = word < 0 ? static_cast<const void*>(&representative) : row + word;
      std::memcpy(to, from, 8);
    }
  }
}

void extendBounds(Box3& bounds, const Point3& point)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (std::isfinite(point[axis]))
    {
      bounds.Min[axis] = std::min(bounds.Min[axis], point[axis]);
      bounds.Max[axis] = std::max(bounds.Max[axis], point[axis]);
    }
  }
}

void completeBounds(Box3& bounds)
{
  if (bounds.Min.z > bounds.Max.z)
  {
    bounds.Min.z = bounds.Max.z = 0;
  }
}

int SharingSets::number(const std::vector<std::int32_t>& set)
{
  const auto [found, isNew] = this->Numbers.emplace(set, int(this->Sets.size()));
  if (isNew)
  {
    this->Sets.push_back(&found->first);
  }
  return found->second;
}

int SharingSets::unite(int a, int b)
{
  if (a == b || a < 0 || b < 0)
  {
    return std::max(a, b);
  }
  const auto [found, isNew] = this->Unions.emplace(std::minmax(a, b), -1);
  if (isNew)
  {
    std::vector<std::int32_t> both;
    std::set_union(this->set(a).begin(), this->set(a).end(), this->set(b).begin(),
      this->set(b).end(), std::back_inserter(both));
    found->second = this->number(both);
  }
  return found->second;
}

std::vector<int> SharingSets::groups(
  const std::vector<int>& setOf, std::vector<SharedGroup>& groups) const
{
  std::vector<std::int64_t> counts(this->Sets.size(), 0);
  for (const int set : setOf)
  {
    if (set >= 0)
    {
      ++counts[std::size_t(set)];
    }
  }
  std::vector<int> indexOf(this->Sets.size(), -1);
  for (const auto& [set, number] : this->Numbers)
  {
    const std::int64_t count = counts[std::size_t(number)];
    if (count > 0)
    {
      indexOf[std::size_t(number)] = int(groups.size());
      groups.push_back({ set, count });
    }
  }
  return indexOf;
}

std::size_t PieceInterior::interfacePosition(std::int64_t point) const
{
  const auto found =
    std::lower_bound(this->InterfacePoints.begin(), this->InterfacePoints.end(), point);
  if (found == this->InterfacePoints.end() || *found != point)
  {
    throw std::logic_error("a point of a triangle at the border is not on the interface");
  }
  return std::size_t(found - this->InterfacePoints.begin());
}

void PieceBorder::addCell(const std::int64_t* points, const std::vector<std::int32_t>& borrowers)
{
  this->Borrowers.insert(this->Borrowers.end(), borrowers.begin(), borrowers.end());
  this->Cells.push_back({ {}, this->Borrowers.size() });
  for (std::size_t i = 0; i < this->CellSize; ++i)
  {
    const std::int64_t point = this->Cells.back().Points[i] = points[i];
    if (!this->Interior.owns(point) &&
      this->GhostPosition.emplace(point, std::int64_t(this->Ghosts.size())).second)
    {
      this->Ghosts.push_back(point);
      this->GhostRows.resize(this->GhostRows.size() + this->Layout.Words);
    }
  }
}

void PieceBorder::setGhost(std::int64_t point, const double* row)
{
  const std::size_t words = this->Layout.Words;
  std::copy_n(
    row, words, this->GhostRows.data() + std::size_t(this->GhostPosition.at(point)) * words);
}

std::size_t PieceBorder::indexOf(std::int64_t point) const
{
  return this->Interior.owns(point)
    ? this->Interior.interfacePosition(point)
    : this->Interior.InterfacePoints.size() + std::size_t(this->GhostPosition.at(point));
}

const double* PieceBorder::row(std::size_t index) const
{
  const std::size_t own = this->Interior.InterfacePoints.size();
  return index < own ? this->Interior.InterfaceRows.data() + index * this->Layout.Words
                     : this->GhostRows.data() + (index - own) * this->Layout.Words;
}

PieceBorder::Mesh PieceBorder::mesh() const
{
  Mesh mesh;
  IndexMap numbers;
  for (const Cell& cell : this->Cells)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int64_t point = cell.Points[i];
      const auto [number, isNew] = numbers.insert(point);
      if (isNew)
      {
        const double* const row = this->row(this->indexOf(point));
        mesh.Rows.insert(mesh.Rows.end(), row, row + this->Layout.Words);
      }
      mesh.Corners.push_back(number);
    }
  }
  return mesh;
}

OrderedBorder::OrderedBorder(const PieceBorder& border)
  : Border(border)
  , Interior(border.Interior)
{
  this->uniteSets();
  this->orderPoints();
  this->addCells();
}

/// A point's set of borrowers is the union of its cells' sets.
void OrderedBorder::uniteSets()
{
  const int none = this->Sets.number({}); // sorts first
  this->SetOf.assign(this->Interior.InterfacePoints.size() + this->Border.Ghosts.size(), none);
  this->CellSets.assign(this->Interior.InterfaceCells.size(), none);
  auto begin = this->Border.Borrowers.begin();
  for (const PieceBorder::Cell& cell : this->Border.Cells)
  {
    const auto end = this->Border.Borrowers.begin() + std::ptrdiff_t(cell.BorrowerEnd);
    const int set = this->Sets.number({ begin, end });
    begin = end;
    this->CellSets.push_back(set);
    for (std::size_t i = 0; i < this->Border.CellSize; ++i)
    {
      int& of = this->SetOf[this->Border.indexOf(cell.Points[i])];
      of = this->Sets.unite(of, set);
    }
  }
}

void OrderedBorder::orderPoints()
{
  const std::vector<int> groupOf = this->Sets.groups(this->SetOf, this->PointGroups);
  const std::size_t own = this->Interior.InterfacePoints.size();
  for (std::size_t i = 0; i < this->SetOf.size(); ++i)
  {
    const double* const row = this->Border.row(i);
    this->Points.push_back(
      { groupOf[std::size_t(this->SetOf[i])], this->Border.Layout.id(row), row, i >= own, i });
  }
  std::sort(this->Points.begin(), this->Points.end(),
    [](const Point& a, const Point& b)
    { return a.Group != b.Group ? a.Group < b.Group : a.Id < b.Id; });
  this->Position.resize(this->Points.size());
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    this->Position[this->Points[i].Index] = std::int32_t(this->Interior.Points + std::int64_t(i));
  }
}

/// Adds a cell, its corners permuted to a canonical order of the same orientation.
void OrderedBorder::addCell(int group, CellCorners corners)
{
  if (this->Border.CellSize == 3)
  {
    std::rotate(
      corners.begin(), std::min_element(corners.begin(), corners.end() - 1), corners.end() - 1);
  }
  else
  {
    bool isOdd = false;
    for (std::size_t i = 0; i < 4; ++i)
    {
      for (std::size_t j = i + 1; j < 4; ++j)
      {
        isOdd = isOdd != (corners[i] > corners[j]);
      }
    }
    std::sort(corners.begin(), corners.end());
    if (isOdd)
    {
      std::swap(corners[2], corners[3]);
    }
  }
  this->Cells.push_back({ group, corners });
}

void OrderedBorder::addCells()
{
  const std::vector<int> groupOf = this->Sets.groups(this->CellSets, this->CellGroups);
  const auto groupOfNext = [&] { return groupOf[std::size_t(this->CellSets[this->Cells.size()])]; };
  for (CellCorners corners : this->Interior.InterfaceCells)
  {
    for (std::size_t c = 0; c < this->Border.CellSize; ++c)
    {
      std::int32_t& corner = corners[c];
      corner = corner < 0 ? this->Position[std::size_t(-1 - corner)] : corner;
    }
    this->addCell(groupOfNext(), corners);
  }
  for (const PieceBorder::Cell& cell : this->Border.Cells)
  {
    CellCorners corners{};
    for (std::size_t c = 0; c < this->Border.CellSize; ++c)
    {
      corners[c] = this->Position[this->Border.indexOf(cell.Points[c])];
    }
    this->addCell(groupOfNext(), corners);
  }
  std::sort(this->Cells.begin(), this->Cells.end(),
    [](const Cell& a, const Cell& b)
    { return a.Group != b.Group ? a.Group < b.Group : a.Points < b.Points; });
}

} // namespace tipp
