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

/// How many edges keep them from being one closed convex counter-clockwise chain, collinear runs
/// allowed: 0 if they are. The edges come out sorted by From.
std::int64_t countHullFaults(const std::vector<double>& xy, std::vector<DirectedEdge>& edges);

/// How many of the edges are not edges of the convex hull of the finite points, with all points
/// that lie on it.
std::int64_t countOffHull(const std::vector<double>& xy, const std::vector<DirectedEdge>& edges);

} // namespace check
} // namespace tipp

#endif
