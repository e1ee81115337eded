// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAddOverlaps_h
#define tippAddOverlaps_h

#include "Overlap/OverlapSums.h"
#include "Parallel/ParallelFor.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// A mesh whose values are averaged, and its values. The memory belongs to the caller.
struct OverlapSource
{
  SimplexMesh Mesh;                      ///< triangles, at most 2^31 - 1
  const std::int64_t* Parents = nullptr; ///< the cell of each triangle; null: the same index
  std::vector<OverlapField> Fields;      ///< with as many components as the sums have
};

/// Adds the source's area and integrals in each triangle of `targets`, which has as many as `sums`
/// has targets. Where triangles meet is decided exactly, and areas have the error of a few
/// roundings of the square of the triangles' diameter. The sums do not depend on the number of
/// threads. Returns false if `report` stopped the work; the sums are then incomplete. Throws
/// std::length_error if a mesh is too large.
VTKTIPPACCELERATORS_EXPORT bool addOverlaps(const SimplexMesh& targets, const OverlapSource& source,
  OverlapSums& sums, int threads, const Report& report);

/// Does the same for the pixels of a lattice along the mesh's two axes, in the order of its
/// samples. A pixel has a sample as its centre and reaches half way to the next ones. The lattice
/// must have one layer.
VTKTIPPACCELERATORS_EXPORT bool addPixels(const Lattice& lattice, const OverlapSource& source,
  OverlapSums& sums, int threads, const Report& report);

/// The share of each pixel that is covered, at most 1 unless cells overlap. A share that rounding
/// of coordinates alone can make is 0.
VTKTIPPACCELERATORS_EXPORT std::vector<double> sharesOfPixels(
  const Lattice& lattice, const int (&axes)[2], const OverlapSums& sums, int threads);

/// The area of each triangle; 0 for those that addOverlaps() leaves out.
VTKTIPPACCELERATORS_EXPORT std::vector<double> areasOfTriangles(
  const SimplexMesh& targets, int threads);

/// The share of each triangle that is covered, by triangle, for sums of addOverlaps(). 0 for
/// triangles without area.
VTKTIPPACCELERATORS_EXPORT std::vector<double> sharesOfTriangles(
  const SimplexMesh& targets, const OverlapSums& sums, int threads);

} // namespace tipp

#endif
