// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrainedPoints_h
#define tippConstrainedPoints_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/TableConstraints.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Points/PointStream.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// Differs for other constraints.
std::string identityOf(const TableConstraints& constraints);

/// The points of a stream and, after them, those of constraints that are not among them, and their
/// crossings: the points that triangulateTable() triangulates, in the same order and with the same
/// values; those of TableConstraints::Surface must be set. Which they are is found out in the first
/// pass. The constraints stay in memory.
class VTKTIPPFILTERS_EXPORT ConstrainedPoints : public PointStream
{
public:
  /// `name`: of the constraints' file, for messages. Throws IOError, in the first pass, for all
  /// that triangulateTable() refuses.
  ConstrainedPoints(std::unique_ptr<PointStream> points, TableConstraints constraints,
    std::string name, int threads);
  ~ConstrainedPoints() override;

  bool next(PointBlock& block, std::size_t most) override;
  void rewind() override;
  std::int64_t divisible() const override { return -1; }
  void limitTo(std::int64_t, std::int64_t) override {}
  std::vector<std::string> columns() const override { return this->Input->columns(); }
  std::int64_t leftOut() const override { return this->Input->leftOut(); }
  std::int64_t thinnedOut() const override { return this->Input->thinnedOut(); }
  std::string crs() const override { return this->Input->crs(); }
  std::string identity() const override;

  /// Before the first pass: what points that the input does not have get where no height is given,
  /// as TableConstraints::Surface tells. For each column the values at the points of both tables.
  void setSurface(std::vector<std::vector<double>> values) { this->Surface = std::move(values); }

  /// After the first pass: the constraints, split where they cross, and edges around holes. Gives
  /// them away.
  std::vector<ConstraintSegment> takeSegments();

  /// After the first pass: the points after the input's.
  const PointBlock& added() const { return this->Added; }

  /// Copies the figures there after the first pass; `figures` must outlive this.
  void setReport(ConstraintFigures& figures) { this->Report = &figures; }

private:
  struct Matching;
  void addVertices();
  ResolvedConstraints split(std::vector<Point2>& positions);
  void resolve();
  void addHoles(const std::vector<Point2>& positions);
  bool nextAdded(PointBlock& block, std::size_t most);

  const std::unique_ptr<PointStream> Input;
  const std::string Name;
  const int Threads;
  const std::string Own; ///< identifies the constraints
  ConstraintFigures Counts;
  ConstraintFigures* Report = nullptr;
  std::unique_ptr<Matching> First;          ///< in the first pass
  std::vector<std::vector<double>> Surface; ///< see setSurface(); perhaps none
  std::vector<ConstraintSegment> Segments;
  std::int64_t InputPoints = 0; ///< of this pass so far
  bool IsInputRead = false;     ///< in this pass
  PointBlock Added;             ///< the points after the input's
  std::size_t NextAdded = 0;
};

/// The constraints of files, for a triangulation out of core: to be joined with its points.
class VTKTIPPFILTERS_EXPORT ConstrainedInput
{
public:
  ConstrainedInput(ConstraintFiles files, int threads)
    : Files(std::move(files))
    , Threads(threads)
  {
  }

  /// The points, with those of the constraints if there are files. Throws IOError.
  std::unique_ptr<PointStream> join(std::unique_ptr<PointStream> points);

  /// Sets OutOfCoreOptions::Constraints of a run that opens its points by join(). Throws IOError
  /// for holes, or marks of constraints, without constraints.
  void describe(OutOfCoreOptions& options);

  /// After the first pass over the points; all 0 if a run was resumed.
  const ConstraintFigures& figures() const { return this->Counts; }

private:
  const ConstraintFiles Files;
  const int Threads;
  ConstrainedPoints* Joined = nullptr; ///< the last one
  ConstraintFigures Counts;
};

} // namespace tipp

#endif
