// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceFigures_h
#define tippPieceFigures_h

#include <cstdint>

namespace tipp
{

/// What a run has done, together with those before it that it resumes.
struct PieceFigures
{
  std::int64_t Duplicates = 0;
  std::int64_t WorkerVertices = 0;
  std::int64_t PeakRimTriangles = 0; ///< most unfinished triangles at a time
  std::uint64_t PeakRimBytes = 0;    ///< of their vertices, in memory and in a file
  std::uint64_t RimSpilledBytes = 0; ///< written to that file
  std::uint64_t PeakBorderBytes = 0; ///< most that pieces kept of their borders at a time
};

} // namespace tipp

#endif
