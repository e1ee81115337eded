// SPDX-License-Identifier: BSD-3-Clause
#include "Series/CellSeries.h"

#include "Files/IOError.h"

#include <string>
#include <utility>

namespace tipp
{

void CellSeries::setSize(std::int64_t nodes, std::int64_t cells)
{
  this->FileNodes = nodes;
  this->FileCells = cells;
  this->Nodes = nodes;
  if (this->Wrap)
  {
    this->prepare(); // which may copy nodes
  }
}

void CellSeries::prepare()
{
  CellMesh cells = this->readCells();
  const std::vector<std::int64_t> originals = std::move(cells.Originals);
  CutMesh cut = cutCells(std::move(cells), this->Wrap, this->Path);
  if (!this->IsPrepared)
  {
    this->LeftOut.insert(this->LeftOut.end(), cut.LeftOut.begin(), cut.LeftOut.end());
  }
  this->Parents = cut.Mesh.OriginalCells;
  this->Copies = std::move(cut.Copies);
  this->Ready = std::move(cut.Mesh);
  if (!originals.empty() && this->Parents.empty())
  {
    this->Ready->OriginalCells = originals;
  }
  else if (!originals.empty())
  {
    for (std::int64_t& cell : this->Ready->OriginalCells)
    {
      cell = originals[std::size_t(cell)];
    }
  }
  this->Nodes = std::int64_t(this->Ready->XY.size() / 2);
  this->IsPrepared = true;
}

SeriesMesh CellSeries::readMesh()
{
  if (!this->Ready)
  {
    this->prepare();
  }
  SeriesMesh mesh = std::move(*this->Ready);
  this->Ready.reset();
  return mesh;
}

std::vector<double> CellSeries::readNodes()
{
  return this->Wrap ? this->readMesh().XY : this->readCells().XY;
}

void CellSeries::read(std::size_t variable, std::size_t step, std::vector<double>& values)
{
  const SeriesVariable& described = this->Variables.at(variable);
  if (!this->IsPrepared && described.OnCells)
  {
    this->prepare(); // which triangles are parts of which cells
  }
  this->readStored(variable, described.Varies ? step : 0, values);
  const std::int64_t expected = described.OnCells ? this->FileCells : this->FileNodes;
  if (std::int64_t(values.size()) != expected)
  {
    throw IOError(this->Path,
      "has " + std::to_string(values.size()) + " values of '" + described.Name +
        "' where the mesh has " + std::to_string(expected) + "; copy it again.");
  }
  if (!described.OnCells)
  {
    for (const std::int64_t node : this->Copies)
    {
      values.push_back(values[std::size_t(node)]);
    }
  }
  else if (!this->Parents.empty())
  {
    std::vector<double> parts(this->Parents.size());
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      parts[i] = values[std::size_t(this->Parents[i])];
    }
    values = std::move(parts);
  }
}

} // namespace tipp
