// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRemapSurface_h
#define tippRemapSurface_h

#include "Overlap/OverlapSums.h"
#include "Parallel/ParallelFor.h"
#include "Sampling/SurfacePart.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

class Communicator;

/// Means of an array over cells.
struct SurfaceMeans
{
  std::string Name;
  int Components = 1;
  std::vector<double> Values;
};

/// Computes exact means of the arrays of surfaces over the part of each cell of another surface
/// that they cover, in the plane of x and y: of cell data, and of point data, which are linear in
/// each triangle. The sum of mean, area and covered share over all cells is the integral over the
/// surfaces where they are covered, up to rounding. The result does not depend on the number of
/// threads and ranks.
class VTKTIPPFILTERS_EXPORT SurfaceRemapper
{
public:
  /// `names`: of the arrays to average; empty: all. `threads` is at least 1. Throws
  /// std::runtime_error if the target has no cells with an area.
  SurfaceRemapper(SurfacePart target, std::vector<std::string> names, int threads);

  /// Adds a surface, or a part of one. Of arrays of cells and of points with the same name, the
  /// cells' is averaged. All parts must have the arrays of the first. Returns false if `report`
  /// stopped the work. Throws std::runtime_error for a name that the source lacks, or arrays that
  /// differ between parts.
  bool add(const SurfacePart& source, const Report& report);

  /// Shares the target's triangles among ranks: add() works on this rank's share only. To be called
  /// before add(), with the same target on all ranks.
  void share(const Communicator& ranks);

  /// After share() and the last add(): collects the sums of all ranks on the first rank, where
  /// finish() may then be called. All ranks must have added the same surfaces. Collective.
  void gather(Communicator& ranks);

  /// Returns the means over the target's cells, `null` in cells that are not covered, and the array
  /// coveredShareName.
  std::vector<SurfaceMeans> finish(double null);

  /// The number of cells of the result with a covered share above 1, because cells of the source
  /// overlap, each of which counts. After finish().
  std::int64_t coveredTwice() const { return this->CoveredTwice; }
  /// The number of cells of the result that are covered in part at least. After finish().
  std::int64_t covered() const { return this->Covered; }

private:
  void findArrays(const SurfacePart& source);
  std::vector<double> sharesOfCells();

  SurfacePart Target;
  std::vector<std::string> Names;
  int Threads;
  std::int64_t First = 0; ///< this rank's triangles of the target: [First, Last)
  std::int64_t Last = 0;
  std::vector<SurfaceArray> Arrays;
  std::unique_ptr<OverlapSums> Sums; ///< of this rank's triangles; of all; then of the cells
  std::int64_t CoveredTwice = 0;
  std::int64_t Covered = 0;
};

} // namespace tipp

#endif
