// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactLocation_h
#define tippExactLocation_h

#include "ResampleScenes.h"

#include <vector>

// Finds the cells that contain a sample with CGAL's rational numbers, independently of the code
// under test.
namespace oracle
{

/// The cells that contain the sample after a move by (s0 e, s1 e^2, s2 e^3) with e -> 0. The signs
/// s0, s1 and s2 are -1 where bit 0, 1 or 2 of `move` is set.
std::vector<int> cellsAfterMove(const Scene& scene, const double* sample, int move);

/// The cells that, as closed sets, contain the sample. Cells without area or volume are left out.
std::vector<int> closedCells(const Scene& scene, const double* sample);

} // namespace oracle

#endif
