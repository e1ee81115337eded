// SPDX-License-Identifier: BSD-3-Clause
#include "Series/CellSeries.h"

#include "Files/IOError.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

std::vector<double> interleaved(SeriesNodes nodes)
{
  std::vector<double> xy;
  xy.reserve(2 * std::size_t(nodes.size()));
  nodes.consume([&xy](std::int64_t, Point2 p) { xy.insert(xy.end(), { p.x, p.y }); });
  return xy;
}

} // namespace

void CellSeries::setSize(std::int64_t nodes, std::int64_t cells)
{
  this->FileNodes = nodes;
  this->FileCells = cells;
  this->Nodes = nodes;
  if (this->Wrap)
  {
    this->readTriangles([](const SeriesNodes&, const SeriesTriangles&) {}); // may copy nodes
  }
}

SeriesNodes CellSeries::readTriangles(const TakeTriangles& take)
{
  const std::unique_ptr<CellBlocks> source = this->openCells();
  SeriesNodes nodes = source->readNodes();
  CellCutter cutter(std::move(nodes), source->IsInDegrees, this->Wrap, this->Path);
  CellBlock block;
  while (source->next(block))
  {
    take(cutter.nodes(), cutter.cut(std::move(block)));
  }
  this->finishCutting(cutter);
  return std::move(cutter.nodes());
}

void CellSeries::finishCutting(CellCutter& cutter)
{
  if (!this->IsCut)
  {
    const std::vector<SeriesLeftOut> leftOut = cutter.leftOut();
    this->LeftOut.insert(this->LeftOut.end(), leftOut.begin(), leftOut.end());
  }
  this->IsCut = true;
  this->Nodes = cutter.nodes().size();
  this->Copies = cutter.nodes().copies();
}

namespace
{

/// Adds triangles to a mesh that has `count`.
void append(SeriesMesh& mesh, SeriesTriangles triangles, std::int64_t count)
{
  const std::size_t added = triangles.Nodes.size() / 3;
  if (!mesh.OriginalCells.empty() || !triangles.Cells.empty() || triangles.FirstCell != count)
  {
    if (mesh.OriginalCells.empty()) // up to here the cells are the triangles
    {
      mesh.OriginalCells.resize(std::size_t(count));
      std::iota(mesh.OriginalCells.begin(), mesh.OriginalCells.end(), 0);
    }
    for (std::size_t i = 0; i < added; ++i)
    {
      mesh.OriginalCells.push_back(triangles.cell(i));
    }
  }
  if (count == 0)
  {
    mesh.Triangles.swap(triangles.Nodes);
    return;
  }
  mesh.Triangles.insert(mesh.Triangles.end(), triangles.Nodes.begin(), triangles.Nodes.end());
}

} // namespace

void CellSeries::prepare()
{
  const std::unique_ptr<CellBlocks> source = this->openCells();
  CellCutter cutter(source->readNodes(), source->IsInDegrees, this->Wrap, this->Path);
  SeriesMesh mesh;
  CellBlock block;
  while (source->next(block))
  {
    const auto count = std::int64_t(mesh.Triangles.size() / 3);
    append(mesh, cutter.cut(std::move(block)), count);
    mesh.Triangles.reserve(3 * std::size_t(source->Cells));
  }
  this->finishCutting(cutter);
  this->Parents = mesh.OriginalCells;
  const std::vector<std::int64_t>& originals = source->Originals;
  if (!originals.empty() && this->Parents.empty())
  {
    mesh.OriginalCells = originals;
  }
  else if (!originals.empty())
  {
    for (std::int64_t& cell : mesh.OriginalCells)
    {
      cell = originals[std::size_t(cell)];
    }
  }
  mesh.XY = interleaved(std::move(cutter.nodes()));
  this->Ready = std::move(mesh);
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
  return this->Wrap ? this->readMesh().XY : interleaved(this->openCells()->readNodes());
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

void CellSeries::readSome(std::size_t variable, std::size_t step,
  const std::vector<std::int32_t>& at, std::vector<double>& values)
{
  std::vector<double> all;
  this->readStored(variable, step, all);
  values.resize(at.size());
  std::transform(at.begin(), at.end(), values.begin(),
    [&all](std::int32_t index) { return all.at(std::size_t(index)); });
}

void CellSeries::readAt(std::size_t variable, std::size_t step, const std::vector<std::int32_t>& at,
  std::vector<double>& values)
{
  this->readSome(variable, this->Variables.at(variable).Varies ? step : 0, at, values);
}

} // namespace tipp
