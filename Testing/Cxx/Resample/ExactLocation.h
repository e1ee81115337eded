// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactLocation_h
#define tippExactLocation_h

#include "ResampleScenes.h"

#include <vector>

// Which cells contain a sample, by CGAL's rationals and nothing of the code under test.
namespace oracle
{

/// The cells that contain the sample after it has been moved by (s0 e, s1 e^2, s2 e^3) with
/// e -> 0. Signs are those of `move`: bit 0, 1, 2 set mean -1 along x, y, z.
std::vector<int> cellsAfterMove(const Scene& scene, const double* sample, int move);

/// The cells that contain the sample as closed sets. Cells without an area or volume do not count.
std::vector<int> closedCells(const Scene& scene, const double* sample);

} // namespace oracle

#endif
