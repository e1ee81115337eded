// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointSets_h
#define tippPointSets_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// x and y of one point after the other.
using Coordinates = std::vector<double>;

/// The point set of this name (see pointSetNames()) for tests and benchmarks. It has about `count`
/// points: a lattice has a square number, and sets with one special point include it in the count.
/// The same arguments give the same points on every machine. Throws std::invalid_argument for an
/// unknown name.
Coordinates makePointSet(const std::string& name, std::size_t count, std::uint64_t seed = 1);

std::vector<std::string> pointSetNames();

} // namespace test
} // namespace tipp

#endif
