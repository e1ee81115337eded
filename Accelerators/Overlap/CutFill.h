// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCutFill_h
#define tippCutFill_h

#include "Overlap/OverlapSums.h"
#include "Overlap/RunningSum.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tipp
{

/// The volumes between two surfaces, where both are defined, and areas in the plane.
struct CutFill
{
  double Cut = 0;        ///< the volume below the first surface and above the second one
  double Fill = 0;       ///< the volume above the first surface and below the second one
  double Area = 0;       ///< the area that both surfaces cover
  double OnlyFirst = 0;  ///< the area that only the first surface covers
  double OnlySecond = 0; ///< the area that only the second surface covers
  /// How many triangles of the first and of the second surface the other one covers more than once,
  /// because its triangles overlap. Each of them counts, in volumes and areas.
  std::int64_t CoveredTwice[2] = { 0, 0 };

  double net() const { return this->Fill - this->Cut; }
};

/// Computes the volumes between two surfaces of triangles, whose heights are linear in each
/// triangle, from the exact common parts of their triangles. In each part the difference of the
/// heights is linear, and the part is cut where it is 0, so only rounding makes an error. Triangles
/// without area, hidden ones and those with a corner that is not finite in the plane are left out;
/// the caller hides those with a height that is not finite.
class VTKTIPPACCELERATORS_EXPORT CutFillSums
{
public:
  /// The first surface, whose arrays must outlive the object. Heights are the coordinates along the
  /// third axis. Without `bounds` the whole plane is compared.
  CutFillSums(const SimplexMesh& first, const std::optional<Box2>& bounds, int threads);

  /// Adds the second surface, or a part of it that has no area in common with the others. Returns
  /// false if `report` stopped the work; the sums are then incomplete. Throws std::length_error if
  /// a mesh is too large.
  bool add(const SimplexMesh& second, const Report& report);

  /// The sums so far, which do not depend on the number of threads. An area that only one surface
  /// covers is 0 if rounding alone can make it. Throws std::runtime_error if a sum is too large
  /// for a double.
  CutFill result() const;

private:
  SimplexMesh First;
  std::optional<Box2> Bounds;
  int Threads;
  std::vector<double> Areas; ///< of the first surface's triangles, within the bounds
  OverlapSums Sums;          ///< by triangle of the first surface: area, cut and fill
  RunningSum SecondArea;
  std::int64_t SecondCoveredTwice = 0;
};

} // namespace tipp

#endif
