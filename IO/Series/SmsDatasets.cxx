// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SmsDatasets.h"

#include "Files/IOError.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <utility>

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

std::string smsTimeUnits(const std::string& unit, double julianDay)
{
  constexpr std::array<std::pair<const char*, const char*>, 4> units = { { { "s", "seconds" },
    { "m", "minutes" }, { "h", "hours" }, { "d", "days" } } };
  std::string text;
  for (const auto& [begin, name] : units)
  {
    text = !unit.empty() && unit[0] == begin[0] ? name : text;
  }
  constexpr double least = 1721425.5; // the first day of year 1
  constexpr double most = 5373484.5;  // of year 10000
  if (text.empty() || !(julianDay >= least && julianDay < most))
  {
    return text;
  }
  // Fliegel and van Flandern, 1968: the date of a Julian day.
  const double seconds = std::round((julianDay + 0.5) * 86400);
  const auto day = std::int64_t(std::floor(seconds / 86400));
  const auto second = std::int64_t(seconds) - day * 86400;
  std::int64_t l = day + 68569;
  const std::int64_t n = 4 * l / 146097;
  l -= (146097 * n + 3) / 4;
  const std::int64_t i = 4000 * (l + 1) / 1461001;
  l += 31 - 1461 * i / 4;
  const std::int64_t j = 80 * l / 2447;
  const std::int64_t k = j / 11;
  std::array<char, 64> date{};
  std::snprintf(date.data(), date.size(), " since %04d-%02d-%02d %02d:%02d:%02d",
    int(100 * (n - 49) + i + k), int(j + 2 - 12 * k), int(l - 2447 * j / 80), int(second / 3600),
    int(second / 60 % 60), int(second % 60));
  return text + date.data();
}

} // namespace tipp
