// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircBoundaries.h"

#include <cstddef>

namespace tipp
{
namespace
{

void addCountLine(std::string& text, std::size_t count, const char* what)
{
  text += std::to_string(count) + " = " + what + "\n";
}

void addNodes(std::string& text, const std::vector<std::int64_t>& nodes,
  const std::function<std::int64_t(std::int64_t node)>& numberOf)
{
  for (const std::int64_t node : nodes)
  {
    text += std::to_string(numberOf(node)) + "\n";
  }
}

} // namespace

std::string boundaryLines(const AdcircBoundaries& boundaries,
  const std::function<std::int64_t(std::int64_t node)>& numberOf)
{
  std::size_t openNodes = 0;
  for (const auto& nodes : boundaries.Open)
  {
    openNodes += nodes.size();
  }
  std::string text;
  addCountLine(text, boundaries.Open.size(), "number of open boundaries");
  addCountLine(text, openNodes, "total number of open boundary nodes");
  for (const auto& nodes : boundaries.Open)
  {
    addCountLine(text, nodes.size(), "number of nodes of this open boundary");
    addNodes(text, nodes, numberOf);
  }
  std::size_t landNodes = 0;
  for (const AdcircBoundaries::LandBoundary& land : boundaries.Land)
  {
    landNodes += land.Nodes.size();
  }
  addCountLine(text, boundaries.Land.size(), "number of land boundaries");
  addCountLine(text, landNodes, "total number of land boundary nodes");
  for (const AdcircBoundaries::LandBoundary& land : boundaries.Land)
  {
    text += std::to_string(land.Nodes.size()) + " " + std::to_string(land.Kind) +
      " = number of nodes and kind of this land boundary\n";
    addNodes(text, land.Nodes, numberOf);
  }
  return text;
}

} // namespace tipp
