// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointsLike_h
#define tippPointsLike_h

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// `count` points, x and y interleaved, distributed as those of a file: each uniform in a triangle
/// of the file's Delaunay triangulation, every triangle equally often, so that places with small
/// triangles stay dense (the dissertation's chapter 3.3.3 makes its storm-surge meshes larger in
/// this way). Throws IOError, and std::runtime_error if the file's points have no triangles.
std::vector<double> pointsLike(const std::string& path, std::int64_t count, std::uint64_t seed);

} // namespace tipp

#endif
