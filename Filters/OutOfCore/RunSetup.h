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

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Sets the layout of the points' rows, and the arrays of a mesh of triangles or tetrahedra.
/// `elevation`: index of the column with the third coordinate; the number of columns if there is
/// none.
void describeColumns(const std::vector<std::string>& columns, std::size_t elevation,
  const OutOfCoreRunOptions& options, PointRowLayout& rows, PartitionedMesh& mesh);

/// Sets the number of points and the pieces' boxes of a mesh. boxOf(piece) returns a piece's box.
template <typename Plan, typename BoxOf>
void describePieces(
  const Plan& plan, std::int64_t points, const BoxOf& boxOf, PartitionedMesh& mesh)
{
  mesh.Points = points;
  mesh.Tiling = "delaunay:" + std::to_string(plan.pieces());
  mesh.Pieces.resize(std::size_t(plan.pieces()));
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    mesh.Pieces[plan.number(piece)].Box = boxOf(piece);
  }
}

/// All data that a process needs to work on pieces once the points are spilled, except the folders.
class VTKTIPPFILTERS_EXPORT RunSetup
{
public:
  /// Sets the columns of the input and the arrays of the mesh. Sets Rows, Mesh and Columns.
  void describeColumns(const std::vector<std::string>& columns, const OutOfCoreOptions& options);
  /// Sets the domain, the number of points and the pieces' boxes of Mesh. Requires the plan.
  void describeMesh();

  /// Saves the setup for another process.
  void save(SaveArchive& archive);
  /// Restores a saved setup. `points`: the file of spilled points. Throws IOError if it does not
  /// belong to this setup.
  void load(LoadArchive& archive, const std::string& points);

  /// Calls TriangleConsumer::begin(), if there is a consumer.
  void beginTaking() const;

  PieceWork work() const
  {
    return { { *this->Plan, *this->Spilled, this->Rows, this->Mesh, this->Results },
      this->Survey.Factor, this->Consumer, this->MaximumEdge, this->Duplicates,
      this->Constraints.get(), findRankColumn(this->Columns) };
  }

  /// Throws IOError if a piece does not fit into the memory limit, which is in bytes. Pieces are of
  /// similar size unless very many points coincide. `path`: of the mesh, for the message.
  void requireMemory(const std::string& path, std::uint64_t limit) const;

  /// Writes the constraint segments beside the spilled points. Requires the plan. `points`: the
  /// file of spilled points. Throws IOError.
  void setConstraints(const std::string& points, SegmentSource& segments, int threads);

  /// Returns the bytes that the consumer needs on disk.
  std::uint64_t takenBytes() const;

  InputSurvey Survey;
  PointRowLayout Rows;
  PartitionedMesh Mesh;
  std::string Results; ///< prefix of the paths of results
  TriangleConsumer* Consumer = nullptr;
  double MaximumEdge = 0;
  DuplicateRule Duplicates = DuplicateRule::First;
  std::int64_t Marks = -1;          ///< index of the mesh's array ConstraintEdges; -1: none
  std::vector<std::string> Columns; ///< of the input, without x and y
  std::unique_ptr<PiecePlan> Plan;
  std::unique_ptr<SpilledPoints> Spilled;
  std::unique_ptr<PieceSegments> Constraints; ///< null: no constraints

private:
  template <typename Archive>
  void exchangeInput(Archive& archive);
  Bounds boundsOf(const Box2& box) const;
  Box2 inputBounds() const;
};

/// Returns a text that is equal for runs that make the same mesh from the same input with the same
/// options.
std::string identityOf(const PointStream& input, const OutOfCoreOptions& options);

} // namespace tipp

#endif
