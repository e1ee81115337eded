// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankSource_h
#define tippRankSource_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/ResolveCrossings.h"
#include "Ranks/Communicator.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <vector>

class vtkAbstractTransform;
class vtkPointSet;
class vtkPolyData;

namespace tipp
{

/// The sources of all ranks, as constraints between the points of all ranks.
struct RankSource
{
  /// This rank's input. On the last rank, the source's new points and the crossings are appended.
  vtkSmartPointer<vtkPointSet> Input;
  std::vector<Point2> Positions; ///< projected positions of Input's points; empty if unchanged
  std::unique_ptr<ConstraintSegments> Segments; ///< the same on all ranks
  std::vector<std::int64_t> Order; ///< per segment: its index in the order of the constraints
  std::vector<std::int64_t> Cells; ///< source cell by this index, see RankSourceOptions::WantsCells
  ConstraintFigures Figures;       ///< the same on all ranks
};

struct RankSourceOptions
{
  /// Whether the source's points are merged with the input's points by their coordinates. Otherwise
  /// its point ids refer to the input's points: global ids, or if these are missing, indices
  /// counted over the ranks.
  bool MergesPoints = false;
  CrossingRule Crossings = CrossingRule::Split;
  /// Whether to record the source cell of each segment. Cells are counted over all distinct
  /// sources, in the order of ranks.
  bool WantsCells = false;
  vtkAbstractTransform* ToPlane = nullptr;
  int Threads = 0;
};

/// Gathers the sources of all ranks. Ranks may have different sources or none (null); a source that
/// several ranks have counts once. Collective. Throws std::invalid_argument for an invalid source,
/// perhaps only on the ranks that have it.
RankSource shareSource(
  Communicator& ranks, vtkPointSet* input, vtkPolyData* source, const RankSourceOptions& options);

} // namespace tipp

#endif
