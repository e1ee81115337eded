// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceFigures_h
#define tippPieceFigures_h

#include <cstdint>

namespace tipp
{

/// What was done for a piece, or for all of them.
struct PieceFigures
{
  std::int64_t Duplicates = 0;
  std::int64_t DisagreeingPlaces = 0; ///< of several points with different elevations
  std::int64_t WorkerVertices = 0;    ///< that workers triangulated
  std::uint64_t BoundaryBytes = 0;    ///< of vertices that were sent to partitions of other pieces

  void add(const PieceFigures& other)
  {
    this->Duplicates += other.Duplicates;
    this->DisagreeingPlaces += other.DisagreeingPlaces;
    this->WorkerVertices += other.WorkerVertices;
    this->BoundaryBytes += other.BoundaryBytes;
  }
};

} // namespace tipp

#endif
