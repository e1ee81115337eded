// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrainedPoints_h
#define tippConstrainedPoints_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/KeepInside.h"
#include "Constraints/SplitStored.h"
#include "Constraints/StoredConstraints.h"
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
/// pass, on disk. In memory are constraints that cross others and those near them; with holes, all
/// segments.
class VTKTIPPFILTERS_EXPORT ConstrainedPoints
  : public PointStream
  , public SegmentSource
{
public:
  /// `name`: of the constraints' file, for messages. Lines: of a text file, instead of
  /// constraints.Lines; or null. Throws IOError, in the first pass, for all that triangulateTable()
  /// refuses.
  ConstrainedPoints(std::unique_ptr<PointStream> points, TableConstraints constraints,
    std::string name, int threads, std::unique_ptr<SegmentRows> lines = nullptr);
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

  /// Writes the constraints to disk; call it before the first pass.
  void begin(const std::string& files, std::uint64_t memory) override;
  /// The constraints, split where they cross, and edges around holes.
  std::int64_t count() const override;
  void forEach(const VisitSegment& visit) override;
  void end() override;

  /// After the first pass: the points after the input's.
  PointBlock added() const;

  /// Copies the figures there after the first pass; `figures` must outlive this.
  void setReport(ConstraintFigures& figures) { this->Report = &figures; }

private:
  void resolve();
  void addPoints();
  void countSegments();
  void addHoles();
  bool nextAdded(PointBlock& block, std::size_t most);
  void readAdded(std::int64_t first, std::size_t count, PointBlock& block) const;

  const std::unique_ptr<PointStream> Input;
  const std::string Name;
  const int Threads;
  const CrossingRule Crossings;
  const std::vector<Point2> Seeds; ///< in holes
  TableConstraints Given;          ///< until begin()
  std::unique_ptr<SegmentRows> Lines;
  const std::string Own; ///< identifies the constraints
  ConstraintFigures Counts;
  ConstraintFigures* Report = nullptr;
  std::vector<std::vector<double>> Surface; ///< see setSurface(); perhaps none
  DiskWork Work{};
  std::unique_ptr<StoredConstraints> Stored; ///< from begin() to end()
  SplitConstraints Split;
  std::vector<PositionPair> HoleEdges;
  HullOfPoints Hull; ///< if there are holes
  bool IsResolved = false;
  std::int64_t InputPoints = 0;   ///< of this pass so far
  bool IsInputRead = false;       ///< in this pass
  std::unique_ptr<RowFile> Added; ///< the points after the input's: x, y and columns
  std::int64_t NextAdded = 0;
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

  /// The same as one of its own; there must be files.
  std::unique_ptr<ConstrainedPoints> joined(std::unique_ptr<PointStream> points) const;

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
