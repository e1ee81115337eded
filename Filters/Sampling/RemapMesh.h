// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRemapMesh_h
#define tippRemapMesh_h

#include "Overlap/OverlapSums.h"
#include "Parallel/ParallelFor.h"
#include "Sampling/SimplexParts.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <vector>

class vtkPointSet;

namespace tipp
{

class Communicator;

/// Computes exact means of the arrays of surfaces over the part of each cell of another surface
/// that they cover, in the plane of x and y: of cell data, and of point data, which are linear in
/// each triangle. The sum of mean, area and covered share over all cells is the integral over the
/// surfaces where they are covered, up to rounding. The result does not depend on the number of
/// threads and ranks.
class VTKTIPPFILTERS_EXPORT MeshRemapper
{
public:
  /// `target` must have passed checkDataSet(), and is shared. `names`: of the arrays to average;
  /// empty: all arrays of numbers. `threads` is at least 1. Throws std::runtime_error if the target
  /// has cells with a volume or no cells with an area.
  MeshRemapper(vtkPointSet* target, std::vector<std::string> names, int threads);
  ~MeshRemapper();
  MeshRemapper(const MeshRemapper&) = delete;
  MeshRemapper& operator=(const MeshRemapper&) = delete;

  /// Adds a surface, or a part of one, that has passed checkDataSet(). Of arrays of cells and of
  /// points with the same name, the cells' is averaged. All parts must have the arrays of the
  /// first. Returns false if `report` stopped the work. Throws std::runtime_error for cells with a
  /// volume, a name that the source lacks, or arrays that differ between parts.
  bool add(vtkPointSet* source, const Report& report);

  /// Shares the target's triangles among ranks: add() works on this rank's share only. To be called
  /// before add(), with the same target on all ranks.
  void share(const Communicator& ranks);

  /// After share() and the last add(): collects the sums of all ranks on the first rank, where
  /// finish() may then be called. All ranks must have added the same surfaces. Collective.
  void gather(Communicator& ranks);

  /// Returns the cells of the target with the means as cell arrays of doubles, `null` in cells
  /// that are not covered, and the array coveredShareName. The target's own arrays are left out.
  vtkSmartPointer<vtkPointSet> finish(double null);

  /// The number of cells of the result with a covered share above 1, because cells of the source
  /// overlap, each of which counts. After finish().
  std::int64_t coveredTwice() const { return this->CoveredTwice; }
  /// The number of cells of the result that are covered in part at least. After finish().
  std::int64_t covered() const { return this->Covered; }

private:
  struct Array
  {
    std::string Name;
    int Components;
    bool OfCells;
  };

  void findArrays(vtkPointSet* source);
  std::vector<double> sharesOfCells();

  vtkSmartPointer<vtkPointSet> Target;
  std::vector<std::string> Names;
  int Threads;
  SimplexParts Parts;     ///< of the target
  std::int64_t First = 0; ///< this rank's triangles of the target: [First, Last)
  std::int64_t Last = 0;
  std::vector<Array> Arrays;
  std::unique_ptr<OverlapSums> Sums; ///< of this rank's triangles; of all; then of the cells
  std::int64_t CoveredTwice = 0;
  std::int64_t Covered = 0;
};

} // namespace tipp

#endif
