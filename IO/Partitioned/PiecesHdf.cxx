// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PiecesHdf.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace tipp
{

PiecesHdf::PiecesHdf(const PartitionedMesh& mesh)
  : Mesh(mesh)
{
  this->takeColumns();
}

std::uint64_t PiecesHdf::leadOf(const HdfColumn& column)
{
  return column.Array.Role == PieceRole::Offsets ? 1 : 0;
}

std::uint64_t PiecesHdf::tuplesOf(const PieceSummary& piece, const HdfColumn& column) const
{
  const auto tuples = std::uint64_t(storedTuples(this->Mesh, piece, column.Array.ofPoints()));
  const bool areCorners = column.Array.Role == PieceRole::Connectivity;
  return areCorners ? tuples * std::uint64_t(this->Mesh.CellSize) : tuples;
}

std::uint64_t PiecesHdf::stepTuples(const HdfColumn& column) const
{
  std::uint64_t tuples = 0;
  for (const PieceSummary& piece : this->Mesh.Pieces)
  {
    tuples += leadOf(column) + this->tuplesOf(piece, column);
  }
  return tuples;
}

HdfShape PiecesHdf::shapeOf(const HdfColumn& column) const
{
  HdfShape shape = hdfShapeOf(column.Array, 0);
  shape.Sizes[0] = this->stepTuples(column) * column.Steps.size();
  return shape;
}

/// The ids of all pieces have the type that the largest piece needs.
Scalar PiecesHdf::typeOfIds() const
{
  const bool isWide = std::any_of(this->Mesh.Pieces.begin(), this->Mesh.Pieces.end(),
    [this](const PieceSummary& piece) { return hasWideIds(this->Mesh, piece); });
  return isWide ? Scalar::Int64 : Scalar::Int32;
}

void PiecesHdf::takeColumns()
{
  const std::vector<PieceArray> arrays = pieceArrays(this->Mesh, PieceSummary());
  std::map<std::pair<bool, std::string>, std::size_t> varying; // to the index of the column
  for (std::size_t a = 0; a < arrays.size(); ++a)
  {
    HdfColumn column{ arrays[a].Name, arrays[a], { a } };
    const std::int64_t attribute = arrays[a].Attribute;
    if (attribute >= 0 && this->Mesh.Arrays[std::size_t(attribute)].Step >= 0)
    {
      column.Name = this->Mesh.Arrays[std::size_t(attribute)].Name;
      const auto [known, isNew] =
        varying.emplace(std::pair(arrays[a].ofPoints(), column.Name), this->Columns.size());
      if (!isNew)
      {
        this->Columns[known->second].Steps.push_back(a);
        continue;
      }
    }
    if (column.Array.Role == PieceRole::Connectivity || column.Array.Role == PieceRole::Offsets)
    {
      column.Array.Type = this->typeOfIds();
    }
    this->Columns.push_back(std::move(column));
  }
}

std::vector<const HdfColumn*> PiecesHdf::find(PieceRole first, PieceRole last) const
{
  std::vector<const HdfColumn*> found;
  for (const HdfColumn& column : this->Columns)
  {
    if (column.Array.Role >= first && column.Array.Role <= last)
    {
      found.push_back(&column);
    }
  }
  return found;
}

std::vector<const HdfColumn*> PiecesHdf::findData(bool ofPoints) const
{
  return ofPoints ? this->find(PieceRole::PointIds, PieceRole::PointData)
                  : this->find(PieceRole::CellIds, PieceRole::CellData);
}

namespace
{

std::vector<std::string> namesOf(const std::vector<const HdfColumn*>& columns)
{
  std::vector<std::string> names;
  std::transform(columns.begin(), columns.end(), std::back_inserter(names),
    [](const HdfColumn* column) { return column->Name; });
  return hdfNamesOf(names);
}

} // namespace

std::vector<HdfLink> PiecesHdf::addColumns(const std::vector<const HdfColumn*>& columns)
{
  const std::vector<std::string> names = namesOf(columns);
  std::vector<HdfLink> links;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    links.push_back({ names[i], this->addColumn(*columns[i]) });
  }
  return links;
}

HdfAddress PiecesHdf::addData(bool ofPoints)
{
  return this->Objects.addGroup(this->addColumns(this->findData(ofPoints)),
    { HdfObjects::textAttribute("GlobalIds", ofPoints ? pointIdsName : cellIdsName) });
}

/// Adds the number of points, or of cells, of each piece, multiplied by `times`.
HdfAddress PiecesHdf::addCounts(bool ofPoints, std::int64_t times)
{
  std::vector<std::int64_t> counts;
  for (const PieceSummary& piece : this->Mesh.Pieces)
  {
    counts.push_back(times * storedTuples(this->Mesh, piece, ofPoints));
  }
  return this->Objects.addNumbers(counts);
}

/// Adds where the arrays of points, or of cells, have their values of each step.
HdfAddress PiecesHdf::addDataOffsets(bool ofPoints)
{
  const std::vector<const HdfColumn*> columns = this->findData(ofPoints);
  const std::vector<std::string> names = namesOf(columns);
  std::vector<HdfLink> links;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const bool varies = columns[i]->Steps.size() > 1;
    const auto tuples = std::int64_t(varies ? this->stepTuples(*columns[i]) : 0);
    std::vector<std::int64_t> offsets;
    for (std::size_t step = 0; step < this->Mesh.Times.size(); ++step)
    {
      offsets.push_back(std::int64_t(step) * tuples);
    }
    links.push_back({ names[i], this->Objects.addNumbers(offsets) });
  }
  return this->Objects.addGroup(links);
}

HdfAddress PiecesHdf::addSteps()
{
  const std::size_t steps = this->Mesh.Times.size();
  const std::vector<std::int64_t> zeros(steps, 0);
  const HdfAddress data = this->Objects.addBytes(zeros.data(), steps * sizeof(std::int64_t));
  const HdfAddress one = this->Objects.addArray({ Scalar::Int64, { steps } }, data);
  // The columns are kinds of cells, of which an unstructured grid has one.
  const HdfAddress kinds = this->Objects.addArray({ Scalar::Int64, { steps, 1 } }, data);
  const std::vector<std::int64_t> parts(steps, std::int64_t(this->Mesh.Pieces.size()));
  const std::vector<HdfLink> links = {
    { "Values", this->Objects.addNumbers(this->Mesh.Times) },
    { "PartOffsets", one },
    { "NumberOfParts", this->Objects.addNumbers(parts) },
    { "PointOffsets", one },
    { "CellOffsets", kinds },
    { "ConnectivityIdOffsets", kinds },
    { "PointDataOffsets", this->addDataOffsets(true) },
    { "CellDataOffsets", this->addDataOffsets(false) },
  };
  return this->Objects.addGroup(
    links, { HdfObjects::numberAttribute("NSteps", { std::int64_t(steps) }) });
}

HdfAddress PiecesHdf::addAll()
{
  const auto columnOf = [this](PieceRole role)
  { return this->addColumn(*this->find(role, role).front()); };
  std::vector<HdfLink> members = {
    { "NumberOfPoints", this->addCounts(true, 1) },
    { "NumberOfCells", this->addCounts(false, 1) },
    { "NumberOfConnectivityIds", this->addCounts(false, this->Mesh.CellSize) },
    { "Points", columnOf(PieceRole::Points) },
    { "Connectivity", columnOf(PieceRole::Connectivity) },
    { "Offsets", columnOf(PieceRole::Offsets) },
    { "Types", columnOf(PieceRole::Types) },
    { "PointData", this->addData(true) },
    { "CellData", this->addData(false) },
  };
  const bool hasSteps = !this->Mesh.Times.empty();
  if (hasSteps)
  {
    members.push_back({ "Steps", this->addSteps() });
  }
  // Version 1 has no steps, and VTK 9.1 reads it, too.
  const std::vector<std::string> attributes = {
    HdfObjects::numberAttribute("Version", { hasSteps ? 2 : 1, 0 }),
    HdfObjects::textAttribute("Type", "UnstructuredGrid"),
  };
  this->Root.push_back({ "VTKHDF", this->Objects.addGroup(members, attributes) });
  return this->Objects.addGroup(this->Root);
}

} // namespace tipp
