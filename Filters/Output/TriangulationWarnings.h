// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulationWarnings_h
#define tippTriangulationWarnings_h

#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Returns the warnings about a triangulation of `points` points, one sentence each.
std::vector<std::string> warningsOf(
  const Triangulation& triangulation, std::int64_t points, bool longEdgesLeftOut);
std::vector<std::string> warningsOf(const OutOfCoreStatistics& statistics);

} // namespace tipp

#endif
