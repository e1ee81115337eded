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

/// A point where a segment crosses an edge of triangles, or a face of tetrahedra.
struct Crossing
{
  double Share; ///< fraction of the segment's length
  /// Ascending global ids of the points of the crossed face, edge or point. If there are fewer than
  /// three, the last is repeated.
  std::array<std::int64_t, 3> Ids;
  Point3 At;                  ///< z is 0 for triangles
  std::vector<double> Values; ///< all components of each point array

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

/// For each segment of a polyline, its crossings with the cells of the pieces [first, end): in the
/// segment's direction, each once, and decided exactly. Crossings at the ends of a segment may be
/// left out. Results do not depend on pieces and threads. Throws IOError and WorkAborted.
std::vector<std::vector<Crossing>> crossingsIn(const ResidentMesh& mesh,
  const std::vector<Point3>& polyline, const std::vector<std::string>& arrays, std::size_t first,
  std::size_t end);

} // namespace tipp

#endif
