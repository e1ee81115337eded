// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointsLike_h
#define tippPointsLike_h

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Returns `count` points, x and y interleaved, distributed like those of a file: each is uniform
/// in a triangle of the file's Delaunay triangulation; all triangles are equally likely, so that
/// dense areas stay dense (the dissertation's chapter 3.3.3 enlarges its storm-surge meshes in this
/// way). Throws IOError, and std::runtime_error if the file's points have no triangles.
std::vector<double> pointsLike(const std::string& path, std::int64_t count, std::uint64_t seed);

} // namespace tipp

#endif
