// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SmsDatasets.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Series/SmsText.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace tipp
{

SmsMeshShape::SmsMeshShape(const ModelMesh& mesh)
  : Nodes(std::int64_t(mesh.XY.size() / 2))
  , Numbers(mesh.Numbers)
  , Cells(mesh.OriginalCells.empty() ? std::int64_t(mesh.Triangles.size() / 3)
                                     : mesh.OriginalCells.back() + 1)
  , Triangles(mesh.Triangles)
  , OriginalCells(mesh.OriginalCells)
{
}

SmsStep::SmsStep(const std::string& path, const SmsMeshShape& shape, SmsDataset& dataset)
  : Path(path)
  , Shape(shape)
  , Dataset(dataset)
{
}

void SmsStep::checkSize(std::int64_t nodes, std::int64_t cells) const
{
  const std::int64_t highest = this->Shape.Numbers.empty()
    ? this->Shape.Nodes
    : *std::max_element(this->Shape.Numbers.begin(), this->Shape.Numbers.end());
  if (nodes != this->Shape.Nodes && nodes != highest)
  {
    throw IOError(this->Path,
      "gives values at " + std::to_string(nodes) + " nodes, but the mesh has " +
        std::to_string(this->Shape.Nodes) + "; name the mesh that it belongs to.");
  }
  if (cells != 0 && cells != this->Shape.Cells)
  {
    throw IOError(this->Path,
      "is of a mesh of " + std::to_string(cells) + " cells, but the mesh has " +
        std::to_string(this->Shape.Cells) + "; name the mesh that it belongs to.");
  }
}

void SmsStep::add(
  double time, const std::vector<double>& values, const std::vector<bool>& activeCells)
{
  const auto components = std::size_t(this->Dataset.Components);
  const auto nodes = std::size_t(this->Shape.Nodes);
  const std::vector<bool> active = this->activeNodes(activeCells);
  // A mesh with gaps among its numbers may have values for these, too.
  const bool isByNumber = values.size() != nodes * components;
  for (std::size_t node = 0; node < nodes; ++node)
  {
    const std::size_t at = isByNumber ? std::size_t(this->Shape.Numbers[node] - 1) : node;
    for (std::size_t c = 0; c < components; ++c)
    {
      this->Dataset.Values.push_back(
        active[node] ? values[at * components + c] : std::numeric_limits<double>::quiet_NaN());
    }
  }
  this->Dataset.Times.push_back(time);
}

std::vector<bool> SmsStep::activeNodes(const std::vector<bool>& activeCells) const
{
  std::vector<bool> active(std::size_t(this->Shape.Nodes), activeCells.empty());
  for (std::size_t i = 0; !activeCells.empty() && i < this->Shape.Triangles.size(); ++i)
  {
    const std::size_t triangle = i / 3;
    const std::size_t cell = this->Shape.OriginalCells.empty()
      ? triangle
      : std::size_t(this->Shape.OriginalCells[triangle]);
    if (activeCells[cell])
    {
      active[std::size_t(this->Shape.Triangles[i])] = true;
    }
  }
  return active;
}

std::vector<SmsDataset> readSmsDatasets(const std::string& path, const SmsMeshShape& shape)
{
  constexpr std::int32_t version = 3000; // all binary files have it
  const InputFile file(path);
  std::int32_t first = 0;
  if (file.size() >= sizeof first)
  {
    file.read(0, &first, sizeof first);
  }
  return first == version ? readBinarySmsDatasets(path, shape) : readSmsText(path, shape);
}

} // namespace tipp
