// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCoast_h
#define tippCoast_h

#include "Distributions/Random.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Generates Distribution::Coast; x and y interleaved.
std::vector<double> generateCoast(std::int64_t count, Random& random);

} // namespace tipp

#endif
