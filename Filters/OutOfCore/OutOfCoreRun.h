// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreRun_h
#define tippOutOfCoreRun_h

#include "Files/OutputFile.h"
#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/PieceConstraints.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "OutOfCore/ScratchFiles.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFile.h"
#include "Points/ReadPoints.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// The record of a run out of core, a file in its work folder: how far the run is, and the data
/// that another process needs to resume it. A record is written after the files that it refers to
/// are on disk.
class RunRecord
{
public:
  using Save = std::function<void(SaveArchive&)>;
  using Load = std::function<void(LoadArchive&)>;

  /// `path`: of the mesh. `identity`: a text that is equal for runs that make the same mesh from
  /// the same input. Both folders must outlive this object.
  RunRecord(const std::string& path, const std::string& identity, PendingFolder& pending,
    ScratchFolder& scratch)
    : Path(path)
    , Identity(identity)
    , Pending(pending)
    , Scratch(scratch)
  {
  }

  /// Reads the record of an earlier process, if there is one. Calls `begun` with the data
  /// saved at Stage::Begun, or `whole` with the data saved at a later stage. Verifies the mesh if
  /// it is complete. Returns false if there is nothing to resume. Throws IOError if the record is
  /// damaged or belongs to another run, or if the mesh is incomplete and `resumes` is false; the
  /// work folder is kept in these cases.
  bool resume(bool resumes, int threads, const Load& begun, const Load& whole);

  enum class Stage : std::uint8_t
  {
    Begun,  ///< the points are spilled
    Whole,  ///< the mesh is complete; a resumed run only has to move it from the work folder
    Counted ///< all triangles or tetrahedra are counted, for a run that makes no mesh
  };
  /// Records that the run has reached a stage. From now on the work folder is kept. `fingerprint`:
  /// of a complete mesh. Throws IOError.
  void save(Stage stage, const Save& save, std::uint64_t fingerprint = 0);

  /// Returns whether the mesh is complete, or all is counted.
  bool isWhole() const { return this->Reached != Stage::Begun; }
  /// Moves a complete mesh to its path, unless it is already there. The rest of the work folder is
  /// no longer kept.
  void putInPlace();

  /// Sets whether the work folder is kept when this process ends.
  void keep(bool kept) { this->Scratch.keep(kept); }
  bool isKept() const { return this->Scratch.isKept(); }

private:
  bool hasMeshToPublish() const { return this->Reached == Stage::Whole && !this->IsInPlace; }
  void requireOurs(bool isOurs, bool resumes) const;
  void verifyWhole(int threads) const;

  const std::string Path;
  const std::string Identity;
  PendingFolder& Pending;
  ScratchFolder& Scratch;
  Stage Reached = Stage::Begun;
  std::uint64_t Fingerprint = 0; ///< of the complete mesh, if there is one
  bool IsInPlace = false;        ///< the mesh is already at Path
};

/// The base of runs out of core in the plane and in space.
template <typename RunOptions, typename RunStatistics>
class OutOfCoreRun
{
protected:
  /// Thrown if the user has stopped the run.
  struct Aborted
  {
  };

  /// `identity`: see RunRecord. `ranks`: null: this process works alone.
  OutOfCoreRun(PointStream& points, const std::string& path, const RunOptions& options,
    const std::string& identity, Communicator* ranks = nullptr)
    : Input(points)
    , Path(path)
    , Options(options)
    , Ranks(ranks)
    , Threads(threadCount(options.Threads))
    , Pending(PendingFolder::lasting(path, &replaceableMesh))
    , Scratch(this->Pending, options.Scratch)
    , Record(path, identity, this->Pending, this->Scratch)
  {
    this->Statistics.Threads = this->Threads;
  }

  /// Does the work and returns the statistics, also if the user stops the run.
  template <typename Work>
  RunStatistics perform(const Work& work)
  {
    try
    {
      work();
    }
    catch (const Aborted&)
    {
      this->Statistics.Aborted = true;
    }
    catch (const RankFailure& failure)
    {
      if (!failure.Aborted)
      {
        throw;
      }
      this->Statistics.Aborted = true;
    }
    this->Statistics.Kept = this->Record.isKept();
    return std::move(this->Statistics);
  }

  /// Reports the finished fraction. Returns false if the user has stopped the run.
  bool proceed(double fraction) const
  {
    return !this->Options.Progress || this->Options.Progress(fraction);
  }

  /// Throws Aborted if the user has stopped the run.
  void require(bool isContinued) const
  {
    if (!isContinued)
    {
      throw Aborted();
    }
  }

  /// Reports the finished fraction. Throws Aborted if the user has stopped the run, and RankFailure
  /// if a rank has failed.
  void report(double fraction) const
  {
    if (this->Ranks)
    {
      Message message; // no message comes
      this->Ranks->poll(message);
    }
    this->require(this->proceed(fraction));
  }

  /// Returns a function that reports the part [from, from + length] of the run.
  Report reportPart(double from, double length) const
  {
    return [this, from, length](double done)
    {
      this->report(from + length * done);
      return true;
    };
  }

  void endPhase(const char* name)
  {
    this->Statistics.Phases.push_back({ name, this->Watch.restart() });
  }

  /// Calls `loadPlan` if the points of an earlier run are spilled. Returns false if there is
  /// nothing to resume.
  bool resume(const RunRecord::Load& loadPlan)
  {
    this->Statistics.Resumed = this->Record.resume(this->Options.Resume, this->Threads, loadPlan,
      [this](LoadArchive& archive) { archive(this->Statistics); });
    if (this->Statistics.Resumed)
    {
      this->endPhase("resume");
    }
    return this->Statistics.Resumed;
  }

  /// Writes the ids of all cells and, if requested, those of their neighbours. `memory`: in bytes.
  void numberAndLink(PartitionedMesh& mesh, std::uint64_t memory)
  {
    numberCells(mesh, this->Finished, this->reportPart(0.9, 0.02));
    if (this->Options.Neighbors)
    {
      linkCells(mesh, this->Finished, memory, this->Threads, this->reportPart(0.92, 0.05));
      this->endPhase("link");
    }
  }

  /// Syncs the files of the pieces, writes the mesh's index, and records that the mesh is complete.
  void publish(PartitionedMesh& mesh)
  {
    const std::size_t pieces = this->Finished.size();
    for (std::size_t number = 0; number < pieces; ++number)
    {
      syncToDisk(mesh.piecePath(number));
      this->report(0.98 + 0.02 * double(number) / double(pieces));
    }
    const PublishedMesh published = publishPieces(mesh, this->Finished);
    this->Statistics.MeshBytes = published.Bytes;
    this->Record.save(
      RunRecord::Stage::Whole, [this](SaveArchive& archive) { archive(this->Statistics); },
      published.Fingerprint);
  }

  void putInPlace()
  {
    this->proceed(1); // too late to stop the run
    this->Record.putInPlace();
    this->endPhase("publish");
  }

  PointStream& Input;
  const std::string Path;
  const RunOptions& Options;
  Communicator* const Ranks;
  const int Threads;
  PendingFolder Pending;
  ScratchFolder Scratch;
  RunRecord Record;
  RunStatistics Statistics;
  std::vector<FinishedPiece> Finished;

private:
  Stopwatch Watch;
};

/// Sets the layout of the points' rows, and the arrays of a mesh of triangles or tetrahedra.
/// `elevation`: index of the column with the third coordinate; the number of columns if there is
/// none. Throws IOError if two arrays would have one name.
void describeColumns(const std::vector<std::string>& columns, std::size_t elevation,
  const OutOfCoreRunOptions& options, PointRowLayout& rows, PartitionedMesh& mesh);

///@{
/// Returns a box whose coordinates were multiplied by `factor` as the bounds of a mesh.
Bounds boundsOf(const Box2& box, double factor);
Bounds boundsOf(const Box3& box, double factor);
///@}

/// Sets the domain, the number of points and the pieces' boxes of a mesh.
template <typename Plan, typename Survey>
void describePieces(const Plan& plan, const Survey& survey, PartitionedMesh& mesh)
{
  mesh.Domain = boundsOf(survey.Bounds, survey.Factor);
  mesh.Points = survey.Points;
  mesh.Tiling = "delaunay:" + std::to_string(plan.pieces());
  mesh.Pieces.resize(std::size_t(plan.pieces()));
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    mesh.Pieces[plan.number(piece)].Box = boundsOf(plan.box(piece), survey.Factor);
  }
}

/// All data that a process needs to work on pieces once the points are spilled, except the folders.
class VTKTIPPFILTERS_EXPORT RunSetup
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
  /// See describePieces(). Requires the plan.
  void describeMesh() { describePieces(*this->Plan, this->Survey, this->Mesh); }

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
  /// file of spilled points. `memory`: in bytes, of which a part is used. Throws IOError.
  void setConstraints(
    const std::string& points, SegmentSource& segments, std::uint64_t memory, int threads);

  /// Returns the bytes that the consumer needs on disk.
  std::uint64_t takenBytes() const;

  InputSurvey Survey;
  /// Of the finite points that are no points of constraints; not multiplied by the factor.
  Box2 InputBounds{};
  PointRowLayout Rows;
  PartitionedMesh Mesh;
  std::string Results; ///< prefix of the paths of results
  TriangleConsumer* const Consumer;
  const double MaximumEdge;
  const DuplicateRule Duplicates;
  std::int64_t Marks = -1;          ///< index of the mesh's array ConstraintEdges; -1: none
  std::vector<std::string> Columns; ///< of the input, without x and y
  std::unique_ptr<PiecePlan> Plan;
  std::unique_ptr<SpilledPoints> Spilled;
  std::unique_ptr<PieceSegments> Constraints; ///< null: no constraints

private:
  template <typename Archive>
  void exchangeInput(Archive& archive);
};

/// Returns a text that is equal for runs that make the same mesh from the same input with the same
/// options.
std::string identityOf(const PointStream& input, const OutOfCoreOptions& options);

} // namespace tipp

#endif
