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

/// x and y interleaved.
using Coordinates = std::vector<double>;

/// A point set of tests and benchmarks by its name (see pointSetNames()), of about `count` points:
/// lattices have a square number, sets with one odd point out count that one in. The same for the
/// same arguments everywhere. Throws std::invalid_argument for an unknown name.
Coordinates makePointSet(const std::string& name, std::size_t count, std::uint64_t seed = 1);

std::vector<std::string> pointSetNames();

} // namespace test
} // namespace tipp

#endif
