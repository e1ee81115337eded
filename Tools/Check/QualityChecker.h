// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQualityChecker_h
#define tippQualityChecker_h

#include "Check/DelaunayChecker.h"
#include "Check/ExactTests.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Why a refined mesh has an angle below the bound.
enum class ThinReason
{
  InputAngle,   ///< forced by two segments of the input that meet at less than 60 degrees
  ShortestEdge, ///< a further point would make an edge shorter than the floor on edges
  Rounding,     ///< a further point would coincide with another one, or invert a triangle
  KeptSegments, ///< the user allowed no points on the border or on segments
  MostPoints    ///< the user allowed no more points
};
constexpr std::size_t ThinReasons = 5;

/// A triangle that the refinement has listed, because an angle of it is below the bound.
struct ListedTriangle
{
  std::int64_t Triangle; ///< its index
  double Angle;          ///< its smallest angle in degrees
  ThinReason Reason;
};

/// A refined mesh, what it was made from, and what it must fulfil.
struct CheckedMesh
{
  std::vector<double> XY;              ///< x and y of each point
  std::vector<std::int64_t> Triangles; ///< three indices of points each

  /// x and y of the input's points. If there are none, the mesh's border is not checked. Points
  /// that are not finite are ignored, here and in Holes.
  std::vector<double> InputXY;
  std::vector<FixedEdge> Segments; ///< of the input: two indices of InputXY's points each
  std::vector<double> Holes;       ///< x and y of points that no triangle may hold

  /// The bound on angles in degrees: digits, with or without a decimal point, 0 to 60.
  std::string MinAngle = "0";
  /// Returns the largest area of a triangle with this centroid; infinity: none. A limit that is NaN
  /// is met by no triangle. Empty: there is no limit.
  std::function<double(check::Position)> MaxArea;
  /// The triangles below the bound as the refinement has listed them. Without a list, only those
  /// may be below it of which an input angle is proved to be the reason.
  std::optional<std::vector<ListedTriangle>> Listed;
  /// Indices of the triangles that the refinement has listed as above the limit on areas. These and
  /// those of Listed may be.
  std::vector<std::int64_t> ListedLarge;
};

/// The result of checkQuality().
struct QualityReport
{
  static constexpr std::size_t Bins = 12;
  static constexpr int BinDegrees = 5;

  /// A kind of fault: how many there are, and which is the first.
  struct Fault
  {
    void add(std::int64_t index)
    {
      this->First = this->Count == 0 ? index : this->First;
      ++this->Count;
    }

    std::int64_t Count = 0;
    std::int64_t First = -1;
  };

  /// Returns a line for each kind of fault.
  std::vector<std::string> faults() const;
  /// Returns whether the check proves that the mesh is right.
  bool isCorrect() const { return this->faults().empty(); }

  CheckReport Mesh;     ///< of the constrained Delaunay triangulation
  std::string MinAngle; ///< the bound

  /// Triangles by their smallest angle, in degrees: 0 to 5, 5 to 10, and so on.
  std::array<std::int64_t, Bins> Histogram{};
  double LeastAngle = 0; ///< in degrees; of the triangle LeastAngleAt
  std::int64_t LeastAngleAt = -1;
  double LargestArea = 0;
  double Grading = 0;     ///< the largest ratio of the areas of two triangles with a common edge
  std::int64_t Below = 0; ///< triangles with an angle below the bound
  /// Those that are excused: by ThinReason. Only input angles are proved; the others are as listed.
  std::array<std::int64_t, ThinReasons> Excused{};
  std::int64_t ExcusedLarge = 0; ///< listed triangles that are above the limit on areas

  Fault LostSegments;   ///< segments of the input that are no chains of edges
  Fault LostPoints;     ///< points of the input that are in the mesh, but no vertices
  Fault FilledHoles;    ///< points of holes that are in a triangle
  Fault OpenBorder;     ///< triangles with a border edge on no segment and not on the input's hull
  Fault Thin;           ///< triangles below the bound that are not excused
  double ThinAngle = 0; ///< of the first one
  Fault TooLarge;       ///< triangles above the area limit
  Fault BadEntries;     ///< entries of a list whose triangle does not exist or is listed twice
  Fault NotBelow;       ///< listed triangles with no angle below the bound
  Fault WrongAngles;    ///< listed triangles whose angle differs by more than 1e-6 degrees
  Fault WrongReasons;   ///< listed triangles that no input angle explains, as they claim
};

/// Checks in exact arithmetic whether a refined mesh is what it claims to be. It shares no code
/// with the refinement.
///
/// - It is a constrained Delaunay mesh: the triangles are counter-clockwise, meet edge to edge, and
///   are locally Delaunay except across segments.
/// - Each segment is a chain of edges, wherever it is inside of the mesh. Its split points and
///   crossings were rounded (check::SplitChains::reach()).
/// - The border consists of segments and of edges of the input's convex hull. Whether the right
///   parts of the plane were removed is checked at the points of holes only.
/// - The input's points in the mesh are vertices, except for points outside of a segment at the
///   border where the rounding of its split points has led the border beyond them.
/// - No angle is below the bound and no area above the limit, except for excused triangles.
///
/// Figures such as LeastAngle and the angles of listed triangles are computed in doubles, whose
/// errors are far below 1e-6 degrees; no verdict but that on listed angles depends on them. Throws
/// std::invalid_argument if MinAngle is no such angle. Takes up about 100 bytes of memory a
/// triangle, with the mesh.
QualityReport checkQuality(CheckedMesh mesh);

} // namespace tipp

#endif
