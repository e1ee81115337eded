// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSegmentCrossings_h
#define tippSegmentCrossings_h

#include "Query/ResidentMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace tipp
{

/// Where a segment crosses an edge of triangles or a face of tetrahedra.
struct Crossing
{
  double Share; ///< of the segment
  /// The global ids, ascending, of the points of the face, edge or point that it crosses; the last
  /// one is repeated.
  std::array<std::int64_t, 3> Ids;
  Point3 At;                  ///< of triangles with z = 0
  std::vector<double> Values; ///< of the arrays of points, component by component

  bool operator<(const Crossing& other) const
  {
    return std::tie(this->Share, this->Ids) < std::tie(other.Share, other.Ids);
  }
  bool operator==(const Crossing& other) const { return this->Ids == other.Ids; }
};

template <typename Archive>
void serialize(Archive& archive, Crossing& crossing)
{
  archive(crossing.Share, crossing.Ids, crossing.At, crossing.Values);
}

/// The crossings of each segment of a polyline with the cells of the pieces [first, end), in its
/// order and each once, decided exactly; those at the ends of a segment may be left out. The same
/// for any pieces and threads. Throws IOError and WorkAborted.
std::vector<std::vector<Crossing>> crossingsIn(const ResidentMesh& mesh,
  const std::vector<Point3>& polyline, const std::vector<std::string>& arrays, std::size_t first,
  std::size_t end);

/// Puts crossings of one segment in order, each once.
void orderCrossings(std::vector<Crossing>& crossings);

} // namespace tipp

#endif
