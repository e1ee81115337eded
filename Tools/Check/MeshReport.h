// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshReport_h
#define tippMeshReport_h

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// The base of the reports on triangles and on tetrahedra. The members from BadIds on count faults.
struct MeshReport
{
  virtual ~MeshReport() = default;

  /// Returns a line for each kind of fault, with its count.
  virtual std::vector<std::string> faults() const = 0;
  bool isCorrect() const { return this->faults().empty(); }

  std::int64_t Points = 0;
  std::int64_t DistinctPoints = 0; ///< distinct points with finite coordinates
  std::int64_t Ties = 0; ///< interior edges (facets) whose two cells are on one circle (sphere)

  std::int64_t BadIds = 0;       ///< cells with an id that does not exist, or of a point not finite
  std::int64_t BadTurns = 0;     ///< cells that are inverted or flat
  std::int64_t BadTies = 0;      ///< ties broken against the rule; counted with the tie rule only
  std::int64_t UnusedPoints = 0; ///< distinct points in no cell
  std::int64_t TwinVertices = 0; ///< vertices that have the coordinates of another vertex
  std::int64_t BadHullEdges = 0; ///< edges at which the boundary is not closed or not convex
  /// Edges (corners) with a wrong neighbour; counted if `neighbors` are given.
  std::int64_t BadNeighbors = 0;
  /// For triangles: their number less 2 n - 2 - h, for n distinct points and h boundary edges. For
  /// tetrahedra: vertices - edges + facets - tetrahedra - 1; also of the hull.
  std::int64_t EulerMismatch = 0;

protected:
  /// Returns a line for each fault whose count is not 0.
  static std::vector<std::string> describe(
    std::initializer_list<std::pair<std::int64_t, const char*>> faults)
  {
    std::vector<std::string> lines;
    for (const auto& [count, text] : faults)
    {
      if (count != 0)
      {
        lines.push_back(std::to_string(count) + " " + text);
      }
    }
    return lines;
  }
};

} // namespace tipp

#endif
