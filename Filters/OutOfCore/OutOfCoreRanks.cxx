// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/OutOfCoreTriangulation.h"

#include "Files/FileSystem.h"
#include "Files/IOError.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore/RunSetup.h"
#include "OutOfCore/ScratchFiles.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"

#include <filesystem>
#include <fstream>
#include <new>
#include <random>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

std::string firstLine(const std::string& path)
{
  std::string line;
  std::getline(std::ifstream(path), line);
  return line;
}

/// Reports progress on a rank other than the first while there are no pieces to triangulate.
void report(const Communicator& ranks, const OutOfCoreOptions& options, double fraction)
{
  if (options.Progress && !options.Progress(fraction))
  {
    throw RankFailure(ranks.rank(), true, "The run was stopped.");
  }
}

Message waitForOrder(Communicator& ranks, const OutOfCoreOptions& options, double fraction)
{
  constexpr double moment = 0.1;
  Stopwatch sinceReport;
  Message message;
  while (!ranks.poll(message))
  {
    if (sinceReport.seconds() > moment)
    {
      sinceReport.restart();
      report(ranks, options, fraction);
    }
    ranks.pause();
  }
  return message;
}

/// Helps with the input until the setup arrives. Returns false if the run ends without pieces to
/// triangulate.
bool receiveSetup(Communicator& ranks, const OpenPoints& open, const OutOfCoreOptions& options,
  RunSetup& prepared, std::vector<char>& isDone)
{
  const auto progress = [&](std::int64_t)
  {
    Message none; // no message comes; poll() throws if a rank has failed
    ranks.poll(none);
    report(ranks, options, 0);
  };
  InputHelper input(ranks, open, { 0, 0, threadCount(options.Threads), progress });
  Message message = waitForOrder(ranks, options, 0);
  while (input.take(message))
  {
    message = waitForOrder(ranks, options, 0);
  }
  if (message.Kind == EndMessage)
  {
    return false;
  }
  LoadArchive archive(message.Content);
  std::string points;
  archive(points, prepared.Mesh.Path, prepared.Results, isDone);
  prepared.load(archive, points);
  return true;
}

void help(Communicator& ranks, const OpenPoints& open, const OutOfCoreOptions& options)
{
  requireSharedFolder(ranks, "");
  requireSharedFolder(ranks, "");
  RunSetup prepared;
  prepared.Consumer = options.Consumer;
  prepared.MaximumEdge = options.MaximumEdge;
  prepared.Duplicates = options.Duplicates;
  std::vector<char> isDone;
  if (!receiveSetup(ranks, open, options, prepared, isDone))
  {
    return;
  }
  prepared.beginTaking();
  const MemoryPlan memory(options, prepared.Rows.Words, prepared.Constraints != nullptr);
  PieceRun(prepared.work(), memory, threadCount(options.Threads), options.Progress, ranks)
    .run(isDone);
  while (waitForOrder(ranks, options, 1).Kind != EndMessage)
  {
    // A result of another rank, which this rank does not need.
  }
}

} // namespace

void requireSharedFolder(Communicator& ranks, const std::string& folder)
{
  const bool isFirst = ranks.rank() == 0;
  const RemovedFile mark(isFirst ? folder + "/.ranks" : "");
  std::string expected;
  if (isFirst)
  {
    std::random_device random;
    expected = std::to_string(random()) + " " + std::to_string(random());
    std::ofstream(mark.Path) << expected << "\n";
    if (firstLine(mark.Path) != expected)
    {
      throw IOError(mark.Path, "cannot be written.");
    }
  }
  const std::string path = ranks.broadcast(mark.Path);
  expected = ranks.broadcast(expected);
  if (firstLine(path) != expected)
  {
    throw IOError(std::filesystem::path(path).parent_path().string(),
      "does not exist on this rank, but all ranks use it; name folders that all ranks share.");
  }
  ranks.barrier(); // all ranks have read the file, so it can be removed
}

void shareSetup(Communicator& ranks, RunSetup& prepared, const std::string& points,
  const std::vector<char>& isDone)
{
  SaveArchive archive;
  archive(points, prepared.Mesh.Path, prepared.Results, isDone);
  prepared.save(archive);
  const Bytes bytes = archive.take();
  for (int to = 1; to < ranks.size(); ++to)
  {
    Bytes copy(bytes.size());
    std::copy(bytes.begin(), bytes.end(), copy.begin());
    ranks.post(to, SetUpMessage, std::move(copy));
    ranks.flush(); // send one copy at a time, to save memory
  }
}

OutOfCoreStatistics triangulateOutOfCoreOnRanks(Communicator& ranks, const OpenPoints& open,
  const std::string& path, const OutOfCoreOptions& options)
{
  OutOfCoreStatistics statistics;
  const auto work = [&]
  {
    if (ranks.rank() > 0)
    {
      help(ranks, open, options);
      return;
    }
    const std::unique_ptr<PointStream> points = open();
    statistics = triangulateOutOfCore(*points, path, options, &ranks);
    if (statistics.Aborted)
    {
      throw RankFailure(0, true, "The run was stopped.");
    }
    for (int to = 1; to < ranks.size(); ++to)
    {
      ranks.post(to, EndMessage, Bytes());
    }
  };
  const auto workInMemory = [&]
  {
    try
    {
      work();
    }
    catch (const std::bad_alloc&)
    {
      throw std::runtime_error("There is not enough memory; lower the memory limit.");
    }
  };
  try
  {
    ranks.together(workInMemory);
  }
  catch (const RankFailure& failure)
  {
    statistics.Aborted = failure.Aborted;
    if (!failure.Aborted)
    {
      throw;
    }
  }
  return statistics;
}

} // namespace tipp
