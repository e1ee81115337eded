// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunSetup_h
#define tippRunSetup_h

#include "OutOfCore/InputPasses.h"
#include "OutOfCore/InputSurvey.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "OutOfCore/PieceSegments.h"
#include "Partitioned/PartitionedMesh.h"
#include "Points/PointTable.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// All that a process needs to work on pieces once the points are spilled, besides the folders.
class VTKTIPPFILTERS_EXPORT RunSetup
{
public:
  /// Columns of the input; the mesh's arrays.
  void describeColumns(const std::vector<std::string>& columns, const OutOfCoreOptions& options);
  /// After the plan.
  void describeMesh();

  void save(SaveArchive& archive);
  /// `points`: the file they are spilled to. Throws IOError if it is not that one.
  void load(LoadArchive& archive, const std::string& points);

  /// Starts the taker, if there is one.
  void beginTaking() const;

  PieceWork work() const
  {
    return { *this->Plan, *this->Spilled, this->Survey.Factor, this->Rows, this->Mesh,
      this->Results, this->Consumer, this->MaximumEdge, this->Duplicates, this->Constraints.get(),
      findRankColumn(this->Columns) };
  }

  /// Throws IOError if a piece does not fit into the memory limit, in bytes; `path` is the mesh's.
  /// Pieces are of equal size except where very many points coincide.
  void requireMemory(const std::string& path, std::uint64_t limit) const;

  /// After the plan. `points`: the file that the points are spilled to. Throws IOError.
  void setConstraints(const std::string& points, SegmentSource& segments, int threads);

  /// Bytes that the taker needs on disk.
  std::uint64_t takenBytes() const;

  InputSurvey Survey;
  PointRowLayout Rows;
  PartitionedMesh Mesh;
  std::string Results; ///< how the paths of pieces' results begin
  TriangleConsumer* Consumer = nullptr;
  double MaximumEdge = 0;
  DuplicateRule Duplicates = DuplicateRule::First;
  std::int64_t Marks = -1; ///< the array ConstraintEdges among the mesh's; -1: there is none
  std::vector<std::string> Columns; ///< of the input, beside x and y
  std::unique_ptr<PiecePlan> Plan;
  std::unique_ptr<SpilledPoints> Spilled;
  std::unique_ptr<PieceSegments> Constraints; ///< null: there are none

private:
  template <typename Archive>
  void exchangeInput(Archive& archive);
  Bounds boundsOf(const Box2& box) const;
  Box2 inputBounds() const;
};

/// Returns a text that is equal for runs that make the same mesh from the same input.
std::string identityOf(const PointStream& input, const OutOfCoreOptions& options);

} // namespace tipp

#endif
