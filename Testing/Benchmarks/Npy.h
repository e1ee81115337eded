// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBenchmarkNpy_h
#define tippBenchmarkNpy_h

#include <string>
#include <vector>

namespace tipp
{
namespace benchmark
{

/// x and y interleaved from an n x 2 (or wider) C-ordered float64 .npy. Throws std::runtime_error.
std::vector<double> readNpy(const std::string& path);

} // namespace benchmark
} // namespace tipp

#endif
