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

/// The sources of all ranks as constraints between the points of all ranks.
struct RankSource
{
  /// This rank's input; on the last rank with the source's new points and the crossings after it.
  vtkSmartPointer<vtkPointSet> Input;
  std::vector<Point2> Positions; ///< of Input's points in the plane; empty: not changed
  std::unique_ptr<ConstraintSegments> Segments; ///< the same on all ranks
  std::vector<std::int64_t> Order; ///< of each segment: its index in the constraints' order
  std::vector<std::int64_t> Cells; ///< by that index: see RankSourceOptions::WantsCells
  ConstraintFigures Figures;       ///< the same on all ranks
};

struct RankSourceOptions
{
  /// Whether the source's points are merged with the input's by their coordinates; else its ids are
  /// those of the input's points: their global ids, or else counted from the first rank on.
  bool MergesPoints = false;
  CrossingRule Crossings = CrossingRule::Split;
  /// Whether to record which cell each segment is part of. Cells are counted over all distinct
  /// sources, in the order of ranks.
  bool WantsCells = false;
  vtkAbstractTransform* ToPlane = nullptr;
  int Threads = 0;
};

/// Ranks may have different sources, or none (null); what several have alike counts once.
/// Collective; throws std::invalid_argument, on some ranks or all.
RankSource shareSource(
  Communicator& ranks, vtkPointSet* input, vtkPolyData* source, const RankSourceOptions& options);

} // namespace tipp

#endif
