// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreRun_h
#define tippOutOfCoreRun_h

#include "Files/OutputFile.h"
#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/OutOfCoreMessages.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "OutOfCore/RunOnRanks.h"
#include "OutOfCore/RunRecord.h"
#include "OutOfCore/ScratchFiles.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFile.h"
#include "Points/ReadPoints.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// The base of runs out of core in the plane and in space.
/// `SetupType` has the data that all ranks need to work on pieces.
template <typename SetupType, typename RunOptions, typename RunStatistics>
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
    , Setup(options)
  {
    this->Statistics.Threads = this->Threads;
    this->Setup.Results = this->Scratch.results();
  }

  /// Does the work and returns the statistics, also if the user stops the run. `spillPoints`
  /// surveys and spills the points; it is not called if an earlier run has done so. `makeMesh` does
  /// the rest, except for moving the mesh to its path, unless that is done, too.
  template <typename SpillPoints, typename MakeMesh>
  RunStatistics perform(const SpillPoints& spillPoints, const MakeMesh& makeMesh)
  {
    try
    {
      this->requireSharedFolders();
      if (!this->resume())
      {
        this->Record.keep(false);
        this->Scratch.clear();
        this->Setup.describeColumns(this->Input.columns(), this->Options);
        spillPoints();
        this->recordSpilled();
      }
      if (!this->Record.isWhole())
      {
        makeMesh();
      }
      this->Setup.Spilled.reset();
      this->putInPlace();
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

  /// Reads all points, and sets Setup.Survey.
  void survey(const InputMemory& memory)
  {
    this->Setup.Survey =
      this->passes(memory, [this](std::int64_t) { this->require(this->proceed(0)); }).survey();
  }

  /// Spills all points by the plan, which takes up to the fraction `end` of the run.
  void spill(const InputMemory& memory, double end)
  {
    decltype(this->Setup.Survey.Sample)().swap(this->Setup.Survey.Sample); // {} keeps the memory
    this->Setup.describeMesh();
    this->describePlan();
    this->endPhase("survey");
    const double all = double(this->Setup.Survey.Points);
    this->Setup.Spilled =
      this
        ->passes(memory,
          [&](std::int64_t done) { this->require(this->proceed(end * double(done) / all)); })
        .spill(this->Setup.Survey, *this->Setup.Plan, this->Scratch.points());
    this->Statistics.SpilledBytes = this->Setup.Spilled->bytes();
  }

  /// Triangulates on all ranks the pieces that are not done: the part [from, from + length] of the
  /// run.
  void makePieces(double from, double length)
  {
    const auto memory = this->Setup.memory(this->Options);
    const auto work = this->Setup.work();
    const std::vector<char> isDone =
      verifyResults(work, this->Threads, this->reportPart(from, 0), this->Options.Warn);
    if (this->Ranks)
    {
      this->shareSetup(isDone);
    }
    Communicator alone(nullptr);
    const std::function<bool(double)> progress = [&](double done)
    { return this->proceed(from + length * done); };
    triangulatePieces(
      work, memory, this->Threads, progress, this->Ranks ? *this->Ranks : alone, isDone);
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

  PointStream& Input;
  const std::string Path;
  const RunOptions& Options;
  Communicator* const Ranks;
  const int Threads;
  PendingFolder Pending;
  ScratchFolder Scratch;
  RunRecord Record;
  SetupType Setup;
  RunStatistics Statistics;
  std::vector<FinishedPiece> Finished;

private:
  /// Throws IOError on each rank that does not see the folders of the run.
  void requireSharedFolders()
  {
    if (this->Ranks)
    {
      requireSharedFolder(*this->Ranks, this->Pending.workPath());
      requireSharedFolder(*this->Ranks, this->Scratch.folder());
    }
  }

  /// Returns false if there is nothing to resume.
  bool resume()
  {
    this->Statistics.Resumed = this->Record.resume(
      this->Options.Resume, this->Threads,
      [this](LoadArchive& archive)
      {
        this->Setup.load(archive, this->Scratch.points());
        this->describePlan();
        this->Statistics.SpilledBytes = this->Setup.Spilled->bytes();
      },
      [this](LoadArchive& archive) { archive(this->Statistics); });
    if (this->Statistics.Resumed)
    {
      this->endPhase("resume");
    }
    return this->Statistics.Resumed;
  }

  /// Records that the points are spilled. From now on the run can be resumed.
  void recordSpilled()
  {
    this->Record.save(
      RunRecord::Stage::Begun, [this](SaveArchive& archive) { this->Setup.save(archive); });
    this->endPhase("spill");
  }

  /// Sets the statistics that are known once there is a plan.
  void describePlan()
  {
    const auto& survey = this->Setup.Survey;
    this->Statistics.Points = survey.Points;
    this->Statistics.Rejected = survey.Rejected;
    this->Statistics.LeftOut = survey.LeftOut;
    this->Statistics.ThinnedOut = survey.ThinnedOut;
    this->Statistics.Pieces = this->Setup.Plan->pieces();
    if constexpr (SetupType::PlanType::Dimensions == 2)
    {
      this->Statistics.WithoutElevation = survey.WithoutElevation;
      this->Statistics.Partitions = this->Setup.Plan->Partitions.size();
    }
  }

  void putInPlace()
  {
    this->proceed(1); // too late to stop the run
    this->Record.putInPlace();
    this->endPhase("publish");
  }

  auto passes(const InputMemory& memory, const std::function<void(std::int64_t)>& progress) const
  {
    return InputPassesOf<typename SetupType::PlanType>(this->Input, this->Ranks,
      { memory.BlockPoints, memory.SamplePoints, this->Threads, progress });
  }

  /// Sends the other ranks, which wait in help(), the data that they need to work on pieces.
  void shareSetup(const std::vector<char>& isDone)
  {
    for (int to = 1; to < this->Ranks->size(); ++to)
    {
      SaveArchive archive;
      archive(this->Scratch.points(), this->Setup.Mesh.Path, this->Setup.Results, isDone);
      this->Setup.save(archive);
      this->Ranks->post(to, SetUpMessage, archive.take());
      this->Ranks->flush(); // send one copy at a time, to save memory
    }
  }

  Stopwatch Watch;
};

} // namespace tipp

#endif
