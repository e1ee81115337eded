// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircBoundaries.h"
#include "Adcirc/AdcircGrid.h"
#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Meshes/TextMeshes.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace tipp
{

namespace
{

/// The numbers of a grid's nodes, in the order of the file `path`, and of further nodes up to
/// `points`. Throws IOError if these would exceed 64 bits.
std::vector<std::int64_t> nodeNumbers(
  const std::string& path, const AdcircGrid& grid, std::size_t points)
{
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  std::vector<std::int64_t> numbers(grid.IndexOf.size());
  std::int64_t last = numbers.empty() ? 0 : std::numeric_limits<std::int64_t>::min();
  for (const auto& [number, index] : grid.IndexOf)
  {
    numbers[std::size_t(index)] = number;
    last = std::max(last, number);
  }
  while (numbers.size() < points)
  {
    if (last == most)
    {
      throw IOError(path,
        "has the largest node number possible, so new nodes cannot be numbered; renumber its "
        "nodes.");
    }
    numbers.push_back(++last);
  }
  return numbers;
}

} // namespace

bool writeAdcircGrid(const std::string& path, const NodesView& nodes, TrianglesView triangles,
  const MeshOptions& options)
{
  requireFinite(path, nodes);
  AdcircGrid frame; // its title, node numbers and boundaries are written
  frame.Title = "Triangles made by tipp";
  if (!options.AdcircLike.empty())
  {
    frame = readAdcircNodes(options.AdcircLike);
  }
  const std::vector<std::int64_t> numbers = nodeNumbers(options.AdcircLike, frame, nodes.size());
  const NodeValues depths = depthsOf(nodes);
  PendingFile pending(path, options.Before);
  OutputStream out(pending.file());
  out << frame.Title << "\n" << triangles.size() << " " << nodes.size() << "\n";
  std::string line;
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    line = std::to_string(numbers[i]);
    appendNode(line, nodes, i, depths[i]);
    out << line << "\n";
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    line = std::to_string(t + 1) + " 3";
    for (int corner = 0; corner < 3; ++corner)
    {
      line += ' ' + std::to_string(numbers[std::size_t(triangles.id(t, corner))]);
    }
    out << line << "\n";
  }
  out << (frame.Boundaries.empty() ? boundaryLines(options.Boundaries, numbers) : frame.Boundaries);
  return finishMesh(out, pending, options);
}

} // namespace tipp
