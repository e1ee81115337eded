// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrainedStream_h
#define tippConstrainedStream_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/Insertion/KeepInside.h"
#include "Constraints/OnDisk/SplitStored.h"
#include "Constraints/OnDisk/StoredConstraints.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/TableConstraints.h"
#include "Points/ReadPoints.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// A hash of the constraints, to recognize them in a resumed run.
std::string identityOf(const TableConstraints& constraints);

/// The points of a stream, followed by the constraints' points that are not among them, and by
/// crossings. These are the points of triangulateTable(), in the same order and with the same
/// values; TableConstraints::Surface must be set. The first pass finds the additional points, on
/// disk. In memory are only the constraints that cross others and those near them; with holes, all
/// segments.
class VTKTIPPFILTERS_EXPORT ConstrainedStream : public PointStream
{
public:
  /// `name` is that of the constraints' file, for messages. `lines` are those of a text file, and
  /// replace constraints.Lines; null uses the latter. The first pass throws IOError for everything
  /// that triangulateTable() refuses.
  ConstrainedStream(std::unique_ptr<PointStream> points, TableConstraints constraints,
    std::string name, int threads, std::unique_ptr<SegmentRows> lines = nullptr);
  ~ConstrainedStream() override;

  bool next(PointBlock& block, std::size_t most) override;
  void rewind() override;
  std::int64_t divisible() const override { return -1; }
  void limitTo(std::int64_t, std::int64_t) override {}
  std::vector<std::string> columns() const override { return this->Input->columns(); }
  std::int64_t leftOut() const override { return this->Input->leftOut(); }
  std::int64_t thinnedOut() const override { return this->Input->thinnedOut(); }
  ReferenceSystem referenceSystem() const override { return this->Input->referenceSystem(); }
  std::string identity() const override;

  /// Call before the first pass. For each column, the values at the points of both tables. A new
  /// point gets them if it has no given height, see TableConstraints::Surface.
  void setSurface(std::vector<std::vector<double>> values) { this->Surface = std::move(values); }

  /// Writes the constraints to disk. Call before the first pass. `files` is the beginning of the
  /// paths of temporary files. `memory` is the run's memory limit in bytes.
  void begin(const std::string& files, std::uint64_t memory);

  /// @name After the first pass
  ///@{
  /// The number of segments: parts of constraints split at crossings, and edges around holes.
  std::int64_t count() const;
  /// The statistics of the constraints.
  const ConstraintFigures& figures() const { return this->Counts; }
  /// The bounds of the finite points of the input, without those added for the segments.
  Box2 inputBounds() const { return this->InputBounds; }
  /// Visits all segments, in the same order each time. No segment crosses another.
  void forEach(const VisitSegment& visit) const;
  /// The same without the parts of lines that lie on other segments. These parts are edges anyway,
  /// and many overlapping segments would need much memory, because each of them is split at all
  /// points on it.
  void forEachUncovered(const VisitSegment& visit) const;
  /// The additional points.
  PointBlock added() const;
  /// Frees the memory that is only needed for the segments.
  void end();
  ///@}

private:
  void forEachBlock(std::size_t most, const std::function<void(const PointBlock&)>& visit) const;
  void resolve(std::size_t blockPoints);
  void addPoints();
  void countSegments();
  void addHoles();
  std::vector<std::pair<std::int64_t, Point2>> findCovered() const;
  bool nextAdded(PointBlock& block, std::size_t most);
  void readAdded(std::int64_t first, std::size_t count, PointBlock& block) const;

  const std::unique_ptr<PointStream> Input;
  const std::string Name;
  const int Threads;
  const CrossingRule Crossings;
  const std::vector<Point2> Seeds; ///< points in holes
  TableConstraints Given;          ///< emptied by begin()
  std::unique_ptr<SegmentRows> Lines;
  const std::string Own; ///< hash of the constraints
  ConstraintFigures Counts;
  std::vector<std::vector<double>> Surface; ///< see setSurface(); empty if not set
  DiskWork Work{};
  std::unique_ptr<StoredConstraints> Stored; ///< exists from begin() to end()
  SplitConstraints Split;
  std::vector<PositionPair> HoleEdges;
  HullOfPoints Hull; ///< used if there are holes
  bool IsResolved = false;
  Box2 InputBounds = Box2::empty();
  std::int64_t InputPoints = 0;   ///< read in this pass so far
  bool IsInputRead = false;       ///< whether this pass has read all input points
  std::unique_ptr<RowFile> Added; ///< the additional points: x, y and columns
  std::int64_t NextAdded = 0;
};

/// Returns the points joined with the constraints of files, of which there must be at least one.
/// Throws IOError.
VTKTIPPFILTERS_EXPORT std::unique_ptr<ConstrainedStream> joinConstraints(
  std::unique_ptr<PointStream> points, const ConstraintFiles& files, int threads);

/// The same for files that need not be given: then the points alone are returned. Throws IOError if
/// holes or marks of constraints are requested without files.
VTKTIPPFILTERS_EXPORT std::unique_ptr<PointStream> joinConstraints(
  std::unique_ptr<PointStream> points, const ConstraintFiles& files, bool areMarked, int threads);

} // namespace tipp

#endif
