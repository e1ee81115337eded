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
#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{

namespace
{

/// The numbers of a grid's nodes, in the order of its file, and of further nodes.
class GridNumbers
{
public:
  /// `points`: the number of all nodes. Throws IOError if the numbers would exceed 64 bits.
  GridNumbers(const std::string& path, const AdcircGrid& grid, std::size_t points)
    : Known(grid.IndexOf.size())
    , Count(std::max(points, this->Known.size()))
  {
    this->Last = this->Known.empty() ? 0 : std::numeric_limits<std::int64_t>::min();
    for (const auto& [number, index] : grid.IndexOf)
    {
      this->Known[std::size_t(index)] = number;
      this->Last = std::max(this->Last, number);
    }
    const auto more = std::int64_t(this->Count - this->Known.size());
    if (this->Last > std::numeric_limits<std::int64_t>::max() - more)
    {
      throw IOError(path,
        "has the largest node number possible, so new nodes cannot be numbered; renumber its "
        "nodes.");
    }
  }

  /// Throws std::out_of_range for a node that does not exist.
  std::int64_t operator[](std::size_t node) const
  {
    if (node >= this->Count)
    {
      throw std::out_of_range("A boundary has a node that the mesh does not have.");
    }
    return node < this->Known.size() ? this->Known[node]
                                     : this->Last + 1 + std::int64_t(node - this->Known.size());
  }

private:
  std::vector<std::int64_t> Known; ///< of the grid's nodes
  std::size_t Count;
  std::int64_t Last = 0; ///< the largest one known
};

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
  const GridNumbers numbers(options.AdcircLike, frame, nodes.size());
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
  const auto numberOf = [&numbers](std::int64_t node) { return numbers[std::size_t(node)]; };
  out << (frame.Boundaries.empty() ? boundaryLines(options.Boundaries, numberOf)
                                   : frame.Boundaries);
  return finishMesh(out, pending, options);
}

} // namespace tipp
