// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCompareSurfaces_h
#define tippCompareSurfaces_h

#include "Overlap/CutFill.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Sampling/SurfacePart.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Computes the volumes between two surfaces whose heights are the z of their points, linear in
/// each triangle. Cells with a corner that is not finite are left out. The result does not depend
/// on the number of threads.
class VTKTIPPFILTERS_EXPORT SurfaceComparison
{
public:
  /// `names`: what messages call the two surfaces. `threads` is at least 1. Throws
  /// std::runtime_error if the first surface has no cells with an area, or if `bounds` are not
  /// sensible for it.
  SurfaceComparison(SurfacePart first, std::array<std::string, 2> names,
    const std::optional<Box2>& bounds, int threads);

  /// Adds the second surface, or a part of it. Returns false if `report` stopped the work.
  bool add(const SurfacePart& second, const Report& report);

  /// Returns the sums. Throws std::runtime_error if the surfaces have no area in common.
  CutFill result() const;

  /// Sentences about cells that are left out and about cells that overlap.
  std::vector<std::string> warnings(const CutFill& result) const;

private:
  void addLeftOut(std::vector<std::string>& sentences) const;

  SurfacePart First;
  std::array<std::string, 2> Names;
  std::optional<Box2> Bounds;
  int Threads;
  CutFillSums Sums;
  Box3 Extents[2] = { Box3::empty(), Box3::empty() };
  std::int64_t NotFinite[2] = { 0, 0 };
};

} // namespace tipp

#endif
