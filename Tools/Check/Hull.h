// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHull_h
#define tippHull_h

#include <cstdint>
#include <vector>

namespace tipp
{
namespace check
{

struct DirectedEdge
{
  std::int64_t From;
  std::int64_t To;
};

/// Counts the edges that keep `edges` from being one closed convex counter-clockwise chain,
/// collinear runs allowed; 0 if they are one. Sorts the edges by From.
std::int64_t countHullFaults(const std::vector<double>& xy, std::vector<DirectedEdge>& edges);

/// Counts the edges that are not edges of the convex hull of the finite points, where all points on
/// the hull are vertices of it.
std::int64_t countOffHull(const std::vector<double>& xy, const std::vector<DirectedEdge>& edges);

} // namespace check
} // namespace tipp

#endif
