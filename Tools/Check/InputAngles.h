// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputAngles_h
#define tippInputAngles_h

#include "Check/ExactTests.h"
#include "Check/MeshEdges.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{
namespace check
{

/// The angles below 60 degrees between segments of the input. They force small angles of triangles:
/// where two segments meet at such an angle, an edge that joins them cannot be lengthened by more
/// points.
class InputAngles
{
public:
  /// The mesh must outlive this object.
  explicit InputAngles(const MeshEdges& mesh)
    : Mesh(mesh)
  {
  }

  /// Adds a segment from `a` to `b`. `chain`: the vertices on it, in order; MeshEdges::None: an end
  /// that is no vertex.
  void add(Position a, Position b, const std::vector<std::int64_t>& chain);

  /// Prepares explains(); call it after all segments.
  void finish();

  /// Returns whether an input angle explains that the triangle has a small angle: its shortest edge
  /// joins inner points of two segments that meet, at a vertex of the mesh, at an angle that is
  /// above 0 and below 60 degrees towards these points.
  bool explain(std::int64_t a, std::int64_t b, std::int64_t c) const;

private:
  struct Segment
  {
    Position A;
    Position B;
  };

  /// A vertex on a segment.
  struct Passing
  {
    std::int64_t Vertex;
    std::size_t Segment;
    std::size_t Place; ///< in the chain
  };

  /// Meetings of a segment with others: these passings of it, sorted by vertex.
  using Meetings = std::vector<Passing>;

  bool joins(std::int64_t p, std::int64_t q) const;
  bool meetAtSmallAngle(const Passing& p, const Passing& q) const;
  std::vector<Passing> passingsOf(std::int64_t vertex) const;

  const MeshEdges& Mesh;
  std::vector<Segment> Segments;
  std::vector<Passing> Passings;    ///< sorted by vertex
  std::vector<Meetings> MeetingsOf; ///< by segment
};

} // namespace check
} // namespace tipp

#endif
