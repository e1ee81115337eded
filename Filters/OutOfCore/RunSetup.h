// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunSetup_h
#define tippRunSetup_h

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "OutOfCore/DescribeMesh.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "OutOfCore/SpilledPoints.h"
#include "OutOfCore/SpilledSegments.h"
#include "OutOfCore/TriangleConsumer.h"
#include "Partitioned/PartitionedMesh.h"
#include "Points/ReadPoints.h"
#include "Triangulation/InputSurvey.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// What RunSetup has in the plane and in space; `Type` is the type of the plan.
template <typename Type>
class RunSetupOf
{
public:
  using PlanType = Type;

  /// See describePieces(). Requires the plan.
  void describeMesh() { describePieces(*this->Plan, this->Survey, this->Mesh); }

  InputSurveyOf<Type::Dimensions> Survey;
  PointRowLayout Rows;
  PartitionedMesh Mesh;
  std::string Results; ///< prefix of the paths of results
  std::unique_ptr<Type> Plan;
  std::unique_ptr<SpilledPoints> Spilled;

protected:
  /// Opens `points`, the file of spilled points. Requires the plan.
  void loadPoints(LoadArchive& archive, const std::string& points)
  {
    this->Spilled =
      std::make_unique<SpilledPoints>(points, this->Rows.Words, this->Plan->pieces(), archive);
    this->describeMesh();
  }
};

/// All data that a process needs to work on pieces once the points are spilled, except the folders.
class VTKTIPPFILTERS_EXPORT RunSetup : public RunSetupOf<PiecePlan>
{
public:
  explicit RunSetup(const OutOfCoreOptions& options = {})
    : Consumer(options.Consumer)
    , MaximumEdge(options.MaximumEdge)
    , Duplicates(options.Duplicates)
  {
  }

  /// Sets the columns of the input and the arrays of the mesh. Sets Rows, Mesh and Columns.
  void describeColumns(const std::vector<std::string>& columns, const OutOfCoreOptions& options);
  /// Saves the setup for another process.
  void save(SaveArchive& archive);
  /// Restores a saved setup. `points`: the file of spilled points. Throws IOError if it does not
  /// belong to this setup.
  void load(LoadArchive& archive, const std::string& points);

  /// Calls TriangleConsumer::begin(), if there is a consumer.
  void beginTaking() const;

  MemoryPlan memory(const OutOfCoreOptions& options) const
  {
    return { options, std::size_t(this->Rows.Words), this->Constraints != nullptr };
  }

  PieceWork work() const
  {
    return { { *this->Plan, *this->Spilled, this->Rows, this->Mesh, this->Results,
               this->Survey.Factor },
      this->Consumer, this->MaximumEdge, this->Duplicates, this->Constraints.get(),
      findRankColumn(this->Columns) };
  }

  /// Throws IOError if a piece does not fit into the memory limit, which is in bytes. Pieces are of
  /// similar size unless very many points coincide. `path`: of the mesh, for the message.
  void requireMemory(const std::string& path, std::uint64_t limit) const;

  /// Writes the constraint segments beside the spilled points. Requires the plan. `points`: the
  /// file of spilled points. Throws IOError.
  void setConstraints(const std::string& points, ConstrainedStream& segments, int threads);

  /// Returns the bytes that the consumer needs on disk.
  std::uint64_t takenBytes() const;

  /// Of the finite points that are no points of constraints; not multiplied by the factor.
  Box2 InputBounds{};
  TriangleConsumer* const Consumer;
  const double MaximumEdge;
  const DuplicateRule Duplicates;
  std::int64_t Marks = -1;          ///< index of the mesh's array ConstraintEdges; -1: none
  std::vector<std::string> Columns; ///< of the input, without x and y
  std::unique_ptr<SpilledSegments> Constraints; ///< null: no constraints

private:
  template <typename Archive>
  void exchangeInput(Archive& archive);
};

} // namespace tipp

#endif
